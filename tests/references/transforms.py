"""Affine transforms as 4 x 4 matrices, lists of rows for column vectors; angles in degrees."""

import math


def identity():
    return [[float(i == j) for j in range(4)] for i in range(4)]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def translation(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def scaling(x, y, z):
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def rotation(axis, angle):
    """Counter-clockwise when the axis points to the viewer."""
    x, y, z = unit(axis)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    d = 1 - c
    return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0],
            [y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0],
            [0, 0, 0, 1]]


def look_at(origin, target, up):
    """Takes +Z to the target, +Y near to up, and the origin to `origin`."""
    forward = unit(minus(target, origin))
    left = unit(cross(up, forward))
    above = cross(forward, left)
    return [[left[i], above[i], forward[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]]


def inverse(m):
    """By Gauss and Jordan."""
    rows = [list(m[i]) + identity()[i] for i in range(4)]
    for i in range(4):
        pivot = max(range(i, 4), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for k in range(4):
            if k != i:
                rows[k] = [a - rows[k][i] * b for a, b in zip(rows[k], rows[i])]
    return [row[4:] for row in rows]


def point(m, p):
    return [sum(m[i][k] * p[k] for k in range(3)) + m[i][3] for i in range(3)]


def vector(m, v):
    return [sum(m[i][k] * v[k] for k in range(3)) for i in range(3)]


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def scaled(a, factor):
    return [x * factor for x in a]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(a):
    return math.sqrt(sum(x * x for x in a))


def unit(a):
    return scaled(a, 1 / length(a))


def flat(m):
    """Row by row, as a scene file has it."""
    return [value for row in m for value in row]
