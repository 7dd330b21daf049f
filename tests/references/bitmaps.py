"""Pictures of 8-bit values: PNG and BMP files in, PNG files out."""

import itertools
import math
import struct
import zlib

CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # of PNG's colour types without a palette
SIGNATURE = b"\x89PNG\r\n\x1a\n"


class Bitmap:
    """Rows from the top, `channels` bytes a pixel: grey, grey and alpha, colour, or colour and alpha."""

    def __init__(self, width, height, channels, rows):
        self.width, self.height, self.channels, self.rows = width, height, channels, rows
        self.sums = {}  # of rows' channels: running sums of linear values

    def linear(self, x, y, channel):
        """A colour channel of the texel, decoded; beside the picture it repeats."""
        row = self.rows[y % self.height]
        return DECODED[row[self.channels * (x % self.width) + (channel if self.channels > 2 else 0)]]

    def average(self, u0, u1, v, channel):
        """Of a channel between two places of the row at v, u0 < u1, in [0, 1]; texels are boxes."""
        row = self.rows[min(int(v * self.height), self.height - 1)]
        sums = self.sums.get((row, channel))
        if sums is None:
            texels = row[channel if self.channels > 2 else 0::self.channels]
            sums = self.sums[row, channel] = list(itertools.accumulate((DECODED[t] for t in texels), initial=0.0))

        def below(u):
            x = u * self.width
            i = min(int(x), self.width - 1)
            return sums[i] + (x - i) * (sums[i + 1] - sums[i])
        return (below(u1) - below(u0)) / ((u1 - u0) * self.width)

    def lookup(self, u, v, channel):
        """Bilinear, linear; v from the top."""
        x, y = u * self.width - 0.5, v * self.height - 0.5
        left, top = math.floor(x), math.floor(y)
        fx, fy = x - left, y - top
        return sum(weight * self.linear(left + i, top + j, channel) for i, j, weight in (
            (0, 0, (1 - fx) * (1 - fy)), (1, 0, fx * (1 - fy)), (0, 1, (1 - fx) * fy), (1, 1, fx * fy)))


def decoded(value):
    """From sRGB's curve, both in [0, 1]."""
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def encoded(value):
    """The byte whose decoded value is nearest."""
    value = min(1.0, max(0.0, value))
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


DECODED = [decoded(i / 255) for i in range(256)]


def read(path):
    return {".png": read_png, ".bmp": read_bmp}[path.suffix](path)


def read_png(path):
    data = path.read_bytes()
    at, body = len(SIGNATURE), b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colors, _, _, interlaced = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            body += chunk
        at += length + 12
    if depth != 8 or colors not in CHANNELS or interlaced:
        raise ValueError(f"{path}: not of the kind that is read here")
    channels = CHANNELS[colors]
    packed = zlib.decompress(body)
    stride = width * channels
    rows, above = [], bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        above = unfiltered(packed[start], bytearray(packed[start + 1:start + 1 + stride]), above, channels)
        rows.append(bytes(above))
    return Bitmap(width, height, channels, rows)


def unfiltered(kind, row, above, channels):
    """A row of a PNG file from what it differs from: its neighbours on the left, above, or both."""
    if kind == 2:
        return bytearray((a + b) & 255 for a, b in zip(row, above))
    if kind:
        for i, value in enumerate(row):
            left = row[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            guess = left if kind == 1 else (left + above[i]) // 2 if kind == 3 else paeth(left, above[i], corner)
            row[i] = (value + guess) & 255
    return row


def paeth(left, above, corner):
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))


def read_bmp(path):
    """24 bits a pixel, without compression."""
    data = path.read_bytes()
    offset, = struct.unpack_from("<I", data, 10)
    width, height, _, bits, packed = struct.unpack_from("<iiHHI", data, 18)
    if bits != 24 or packed != 0:
        raise ValueError(f"{path}: not of the kind that is read here")
    stride = (3 * width + 3) // 4 * 4
    rows = []
    for y in range(abs(height)):
        start = offset + stride * (height - 1 - y if height > 0 else y)
        row = bytearray(data[start:start + 3 * width])
        row[0::3], row[2::3] = row[2::3], row[0::3]
        rows.append(bytes(row))
    return Bitmap(width, abs(height), 3, rows)


def write_png(path, bitmap):
    colors = {channels: colors for colors, channels in CHANNELS.items()}[bitmap.channels]
    body = b"".join(b"\0" + row for row in bitmap.rows)
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", bitmap.width, bitmap.height, 8, colors, 0, 0, 0)),
              (b"IDAT", zlib.compress(body)), (b"IEND", b""))
    path.write_bytes(SIGNATURE + b"".join(
        struct.pack(">I", len(chunk)) + kind + chunk + struct.pack(">I", zlib.crc32(kind + chunk))
        for kind, chunk in chunks))


def constant(width, height, color):
    return Bitmap(width, height, len(color), [bytes(color) * width] * height)
