// Martin Newell's teapot of 1975: 32 bicubic Bezier patches. The control points are those printed
// in F. Crow, "The Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987
// (bottom by the later tradition), written with the teapot's symmetries: 24 of the patches are
// quarter turns of 6 profile curves, and handle and spout are halves that mirror in the plane y =
// 0.
#include "scene/primitives.h"

#include "scene/numbers.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

// Newell's frame: z up, the base on z = 0.
using Patch = std::array<std::array<glm::dvec3, 4>, 4>;  // [v][u]

/// A control point of a profile curve: distance from the axis, height.
struct ProfilePoint {
    double r, z;
};
using Profile = std::array<ProfilePoint, 4>;

// From the inside of the rim down to the base, then the lid from the knob's top, and the bottom.
constexpr Profile RIM = {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}};
constexpr Profile BODY_UPPER = {{{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}}};
constexpr Profile BODY_LOWER = {{{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}}};
constexpr Profile KNOB = {{{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.85}, {0.2, 2.7}}};
constexpr Profile LID = {{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}};
constexpr Profile BOTTOM = {{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0.0}, {0.0, 0.0}}};

/// Newell's quarter circles are cubic curves whose inner control points lie at 0.56 of the radius
/// along the tangent (0.5523 would be nearest to a circle).
constexpr double QUARTER = 0.56;

/// One row of control points across a half of handle or spout: from (x0, 0, z0) out to y = -width
/// and back to (x1, 0, z1).
struct Section {
    double x0, z0, x1, z1, width;
};
using Tube = std::array<Section, 4>;

constexpr Tube HANDLE_UPPER = {{{-1.6, 2.025, -1.5, 2.25, 0.3},
                                {-2.3, 2.025, -2.5, 2.25, 0.3},
                                {-2.7, 2.025, -3.0, 2.25, 0.3},
                                {-2.7, 1.8, -3.0, 1.8, 0.3}}};
constexpr Tube HANDLE_LOWER = {{{-2.7, 1.8, -3.0, 1.8, 0.3},
                                {-2.7, 1.575, -3.0, 1.35, 0.3},
                                {-2.5, 1.125, -2.65, 0.9375, 0.3},
                                {-2.0, 0.9, -1.9, 0.6, 0.3}}};
constexpr Tube SPOUT_LOWER = {{{1.7, 1.425, 1.7, 0.6, 0.66},
                               {2.6, 1.425, 3.1, 0.825, 0.66},
                               {2.3, 2.1, 2.4, 2.025, 0.25},
                               {2.7, 2.4, 3.3, 2.4, 0.25}}};
constexpr Tube SPOUT_UPPER = {{{2.7, 2.4, 3.3, 2.4, 0.25},
                               {2.8, 2.475, 3.525, 2.49375, 0.25},
                               {2.9, 2.475, 3.45, 2.5125, 0.15},
                               {2.8, 2.4, 3.2, 2.4, 0.15}}};

/// The profile swept over the quarter turn from direction a to direction b (unit, in the plane).
Patch sweep(const Profile& profile, const glm::dvec3& a, const glm::dvec3& b)
{
    Patch patch;
    for (size_t v = 0; v < 4; v++) {
        auto [r, z] = profile[v];
        glm::dvec3 up(0, 0, z);
        patch[v] = {up + a * r, up + a * r + b * (QUARTER * r), up + a * (QUARTER * r) + b * r,
                    up + b * r};
    }
    return patch;
}

/// Half of a tube; side = -1 or 1 says where y lies. One half runs the other way round, so that
/// both show their front outside.
Patch halfTube(const Tube& tube, double side)
{
    Patch patch;
    for (size_t v = 0; v < 4; v++) {
        const Section& s = tube[v];
        std::array<glm::dvec3, 4> row = {
            glm::dvec3(s.x0, 0, s.z0), glm::dvec3(s.x0, side * s.width, s.z0),
            glm::dvec3(s.x1, side * s.width, s.z1), glm::dvec3(s.x1, 0, s.z1)};
        if (side < 0) std::reverse(row.begin(), row.end());
        patch[v] = row;
    }
    return patch;
}

std::vector<Patch> teapotPatches()
{
    std::vector<Patch> patches;
    const std::array<glm::dvec3, 4> directions = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                                  glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0)};
    for (const Profile& profile : {RIM, BODY_UPPER, BODY_LOWER, KNOB, LID, BOTTOM}) {
        for (size_t i = 0; i < 4; i++) {
            patches.push_back(sweep(profile, directions[i], directions[(i + 1) % 4]));
        }
    }
    for (const Tube& tube : {HANDLE_UPPER, HANDLE_LOWER, SPOUT_LOWER, SPOUT_UPPER}) {
        patches.push_back(halfTube(tube, -1));
        patches.push_back(halfTube(tube, 1));
    }
    return patches;
}

/// Bernstein polynomials of degree 3 and their derivatives at t.
struct Basis {
    std::array<double, 4> value, slope;
};

Basis basisAt(double t)
{
    double s = 1 - t;
    return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
            {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t}};
}

glm::dvec3 evaluate(const Patch& patch, const std::array<double, 4>& wu,
                    const std::array<double, 4>& wv)
{
    glm::dvec3 sum(0.0);
    for (size_t v = 0; v < 4; v++) {
        glm::dvec3 row(0.0);
        for (size_t u = 0; u < 4; u++) row += patch[v][u] * wu[u];
        sum += row * wv[v];
    }
    return sum;
}

/// Unit normal of the surface. At the poles of knob and bottom, where a whole edge of the patch is
/// one point, the surface is flat across the axis and the normal is the axis.
glm::dvec3 normalAt(const Patch& patch, const Basis& u, const Basis& v)
{
    glm::dvec3 n = glm::cross(evaluate(patch, u.value, v.slope), evaluate(patch, u.slope, v.value));
    double length = std::sqrt(glm::dot(n, n));
    if (length > 1e-9) return n / length;
    return glm::dvec3(0, 0, evaluate(patch, u.value, v.value).z > 1 ? 1 : -1);
}

/// From Newell's frame to y up, spout towards +X.
vec3 upright(const glm::dvec3& p)
{
    return toFloat(glm::dvec3(p.x, p.z, -p.y));
}

/// The triangle unless two of its corners coincide, as one of the two beside a pole does.
void addTriangle(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, bool smooth)
{
    const auto& p = mesh.positions;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
    MeshTriangle triangle;
    triangle.position = {a, b, c};
    if (smooth) triangle.normal = triangle.position;
    mesh.triangles.push_back(triangle);
}

void addPatch(Mesh& mesh, const Patch& patch, uint32_t n, bool smooth)
{
    auto base = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t j = 0; j <= n; j++) {
        Basis v = basisAt(static_cast<double>(j) / n);
        for (uint32_t i = 0; i <= n; i++) {
            Basis u = basisAt(static_cast<double>(i) / n);
            mesh.positions.push_back(upright(evaluate(patch, u.value, v.value)));
            if (smooth) mesh.normals.push_back(upright(normalAt(patch, u, v)));
        }
    }
    for (uint32_t j = 0; j < n; j++) {
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = base + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            addTriangle(mesh, a, c, b, smooth);
            addTriangle(mesh, b, c, d, smooth);
        }
    }
}

}  // namespace

Mesh makeTeapot(uint32_t subdivisions, bool smooth)
{
    Mesh mesh;
    for (const Patch& patch : teapotPatches()) addPatch(mesh, patch, subdivisions, smooth);
    return mesh;
}

}  // namespace sahl
