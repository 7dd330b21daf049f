#include "compare/flip_color.h"

#include <cmath>

namespace sahl {

namespace {

struct Matrix3 {
    Color3 row[3];
};

Color3 times(const Matrix3& m, const Color3& v)
{
    auto dot = [&v](const Color3& r) { return r.x * v.x + r.y * v.y + r.z * v.z; };
    return {dot(m.row[0]), dot(m.row[1]), dot(m.row[2])};
}

Color3 cross(const Color3& a, const Color3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Matrix3 inverse(const Matrix3& m)
{
    const auto& [a, b, c] = m.row;
    const Color3 columns[3] = {cross(b, c), cross(c, a), cross(a, b)};
    const double det = a.x * columns[0].x + a.y * columns[0].y + a.z * columns[0].z;
    Matrix3 result;
    result.row[0] = {columns[0].x / det, columns[1].x / det, columns[2].x / det};
    result.row[1] = {columns[0].y / det, columns[1].y / det, columns[2].y / det};
    result.row[2] = {columns[0].z / det, columns[1].z / det, columns[2].z / det};
    return result;
}

/// XYZ of unit luminance with these chromaticities.
Color3 xyzOf(double x, double y)
{
    return {x / y, 1, (1 - x - y) / y};
}

struct Spaces {
    Color3 white;        // XYZ of RGB (1, 1, 1)
    Matrix3 xyzFromRgb;  // Rec. 709 primaries, white D65
    Matrix3 rgbFromXyz;
};

/// Scales the primaries so that equal amounts of all make white.
Spaces makeSpaces()
{
    const Color3 r = xyzOf(0.64, 0.33), g = xyzOf(0.30, 0.60), b = xyzOf(0.15, 0.06);
    Spaces s;
    s.white = xyzOf(0.3127, 0.3290);
    const Matrix3 primaries = {{{r.x, g.x, b.x}, {r.y, g.y, b.y}, {r.z, g.z, b.z}}};
    const Color3 amount = times(inverse(primaries), s.white);
    for (int i = 0; i < 3; i++) {
        const Color3& row = primaries.row[i];
        s.xyzFromRgb.row[i] = {row.x * amount.x, row.y * amount.y, row.z * amount.z};
    }
    s.rgbFromXyz = inverse(s.xyzFromRgb);
    return s;
}

const Spaces& spaces()
{
    static const Spaces made = makeSpaces();
    return made;
}

/// XYZ relative to white.
Color3 relativeXyz(const Color3& rgb)
{
    const Color3 xyz = times(spaces().xyzFromRgb, rgb);
    return {xyz.x / spaces().white.x, xyz.y / spaces().white.y, xyz.z / spaces().white.z};
}

/// CIE 15:2004: the cube root, with a straight line near 0.
double labCurve(double t)
{
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

}  // namespace

Color3 opponentFromLinear(const Color3& rgb)
{
    const Color3 t = relativeXyz(rgb);
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

Color3 linearFromOpponent(const Color3& ycc)
{
    const double y = (ycc.x + 16) / 116;
    const Color3& white = spaces().white;
    return times(spaces().rgbFromXyz,
                 {(y + ycc.y / 500) * white.x, y * white.y, (y - ycc.z / 200) * white.z});
}

Color3 huntLabFromLinear(const Color3& rgb)
{
    const Color3 t = relativeXyz(rgb);
    const double fx = labCurve(t.x), fy = labCurve(t.y), fz = labCurve(t.z);
    const double lightness = 116 * fy - 16;
    return {lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)};
}

double hyabDistance(const Color3& a, const Color3& b)
{
    return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

}  // namespace sahl
