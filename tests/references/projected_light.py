"""Mitsuba's lights that shine a picture into the scene, of which Sahl has no like, by what they do to a surface."""

import math

import bitmaps
import transforms as tr


class Light:
    """Where it is and its frame, +Z forward and +X to the left; v of the picture goes with +Y."""

    def __init__(self, document, node, picture):
        self.matrix = document.transform(node)
        self.inverse = tr.inverse(self.matrix)
        name = document.word(document.child(node, picture), "filename", "")
        self.bitmap = bitmaps.read(document.file(name))

    def colors(self, u, v):
        return [self.bitmap.lookup(u, v, channel) for channel in range(3)]


class Spot(Light):
    def __init__(self, document, node):
        super().__init__(document, node, "texture")
        self.intensity = document.color(node, "intensity", 1)
        self.outer = document.number(node, "cutoff_angle", 20)
        self.inner = document.number(node, "beam_width", 0.75 * self.outer)
        self.half = math.tan(math.radians(self.outer))  # of the picture, one metre away

    def uv(self, x, y, z):
        """Where in the picture a direction of the light's frame leads."""
        return 0.5 + 0.5 * x / (z * self.half), 0.5 + 0.5 * y / (z * self.half)

    def irradiance(self, point, normal):
        x, y, z = tr.point(self.inverse, point)
        distance = math.sqrt(x * x + y * y + z * z)
        angle = math.degrees(math.acos(max(-1.0, min(1.0, z / distance))))
        if angle >= self.outer:
            return [0, 0, 0]
        share = min(1.0, (self.outer - angle) / (self.outer - self.inner))
        toward = tr.unit(tr.minus(tr.point(self.matrix, [0, 0, 0]), point))
        cosine = max(0.0, sum(a * b for a, b in zip(toward, normal)))
        return [i * c * share * cosine / distance ** 2 for i, c in zip(self.intensity, self.colors(*self.uv(x, y, z)))]


class Projector(Light):
    """Gives white paper one metre away, at right angles to its axis, the radiance of its picture times `scale`.
    The picture fills the angle of a 50 mm lens before 35 mm film, across its diagonal."""

    def __init__(self, document, node):
        super().__init__(document, node, "irradiance")
        self.scale = document.number(node, "scale", 1)
        diagonal = math.hypot(36, 24) / 2 / 50
        self.half = diagonal / math.hypot(1, self.bitmap.height / self.bitmap.width)

    def irradiance(self, point, normal):
        x, y, z = tr.point(self.inverse, point)
        if z <= 0:
            return [0, 0, 0]
        # Its +X is to the left of the picture, and +Y is up.
        u = 0.5 - 0.5 * x / (z * self.half)
        v = 0.5 - 0.5 * y / (z * self.half) * self.bitmap.width / self.bitmap.height
        if not (0 <= u <= 1 and 0 <= v <= 1):
            return [0, 0, 0]
        axis = tr.unit(tr.vector(self.matrix, [0, 0, 1]))
        toward = tr.unit(tr.minus(tr.point(self.matrix, [0, 0, 0]), point))
        along = -sum(a * b for a, b in zip(axis, toward))
        cosine = max(0.0, sum(a * b for a, b in zip(toward, normal)))
        return [math.pi * self.scale * c * cosine / (z * z * along) for c in self.colors(u, v)]


def as_emission(lights, corner, u, v, width, height, target):
    """The light that such lights make white paper send back, as a picture of its emission over the rectangle, and
    the radiance of that picture's white."""
    normal = tr.unit(tr.cross(u, v))
    rows, largest = [], 0.0
    for j in range(height):
        row = []
        for i in range(width):
            point = tr.plus(corner, tr.plus(tr.scaled(u, (i + 0.5) / width), tr.scaled(v, 1 - (j + 0.5) / height)))
            parts = [light.irradiance(point, normal) for light in lights]
            row.append([sum(values) / math.pi for values in zip(*parts)])
            largest = max(largest, *row[-1])
        rows.append(row)
    bitmaps.write_png(target, bitmaps.Bitmap(width, height, 3, [
        bytes(bitmaps.encoded(value / largest) for color in row for value in color) for row in rows]))
    return largest
