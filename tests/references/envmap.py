"""Probes of Mitsuba as files that Sahl reads the same."""

import array

import pictures

ROWS_PER_TEXEL = 16


def resampled(tool, source, target):
    """Writes the lat-long picture `source` with more rows, so that bilinear lookup in it gives what Mitsuba 3
    gives: there the first and the last row lie on the poles, here half a row from them. Columns agree. Between
    rows the values are linear in both, so that only next to a row's old place something is left of the
    difference, and less the more rows there are."""
    picture, _ = pictures.read(tool, source)
    width, height = picture.width, picture.height
    rows = ROWS_PER_TEXEL * (height - 1)
    values = array.array("f")
    for row in range(rows):
        place = (row + 0.5) / rows * (height - 1)
        top = min(int(place), height - 2)
        weight = place - top
        upper = picture.rgb[3 * width * top:3 * width * (top + 1)]
        lower = picture.rgb[3 * width * (top + 1):3 * width * (top + 2)]
        values.extend(a + weight * (b - a) for a, b in zip(upper, lower))
    pictures.write_pfm(target, pictures.Picture(width, rows, values))
