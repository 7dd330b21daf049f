"""Pictures as flat arrays of floats, and their files by way of sahl_reference_pictures."""

import array
import subprocess

LUMINANCE = (0.2126, 0.7152, 0.0722)  # Rec. 709, as sahl compare weighs it


class Picture:
    """Linear RGB, top row first; with the variance of every pixel's mean luminance and its sample count
    where they are known."""

    def __init__(self, width, height, rgb, variance=None, samples=None):
        self.width, self.height, self.rgb = width, height, rgb
        self.variance, self.samples = variance, samples

    def pixel(self, x, y):
        at = 3 * (y * self.width + x)
        return tuple(self.rgb[at:at + 3])

    def window(self, x, y, width, height):
        """A part of the picture, with what is known of its noise."""
        def rows(values, channels):
            if values is None:
                return None
            part = array.array("f")
            for row in range(y, y + height):
                at = channels * (row * self.width + x)
                part.extend(values[at:at + channels * width])
            return part
        return Picture(width, height, rows(self.rgb, 3), rows(self.variance, 1), rows(self.samples, 1))

    def __add__(self, other):
        """Of independent pictures, with as many samples as the one that has fewer."""
        def sums(a, b):
            return None if a is None or b is None else array.array("f", (x + y for x, y in zip(a, b)))
        samples = self.samples and other.samples and array.array("f", map(min, self.samples, other.samples))
        return Picture(self.width, self.height, sums(self.rgb, other.rgb), sums(self.variance, other.variance),
                       samples)

    def luminances(self):
        red, green, blue = LUMINANCE
        values = self.rgb
        return [red * values[i] + green * values[i + 1] + blue * values[i + 2] for i in range(0, len(values), 3)]


def read(tool, path, channels=()):
    """The picture and, as a list of arrays, those channels of its EXR file."""
    done = subprocess.run([tool, "read", path, *channels], stdout=subprocess.PIPE, check=True)
    head, _, body = done.stdout.partition(b"\n")
    width, height = (int(word) for word in head.split())
    values = array.array("f", body)
    size = width * height
    planes = [values[(3 + i) * size:(4 + i) * size] for i in range(len(channels))]
    return Picture(width, height, values[:3 * size]), planes


def read_rendered(tool, path):
    """A picture of sahl render with its noise."""
    picture, (picture.variance, picture.samples) = read(tool, path, ("variance.Y", "samples.Y"))
    return picture


def write(tool, path, picture):
    channels = [("variance.Y", picture.variance), ("samples.Y", picture.samples)]
    channels = [(name, values) for name, values in channels if values is not None]
    body = picture.rgb.tobytes() + b"".join(values.tobytes() for _, values in channels)
    subprocess.run([tool, "write", path, str(picture.width), str(picture.height),
                    *(name for name, _ in channels)], input=body, check=True)


def write_pfm(path, picture):
    rows = [picture.rgb[3 * picture.width * y:3 * picture.width * (y + 1)] for y in range(picture.height)]
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (picture.width, picture.height))
        for row in reversed(rows):
            file.write(row.tobytes())
