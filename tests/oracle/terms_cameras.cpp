// Scenes for cameras and shapes.
#include "oracle/terms.h"
#include "oracle/terms_parts.h"

namespace sahl::testing {
namespace {

/// A lamp on about half of the picture: its share is what the camera's opening decides.
Scene lampBeforeBlack()
{
    Scene scene = scene32(0);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = {3, 4, 5};
    addRectangle(scene, {-1, -0.7, 0}, {1.7, 0.2, 0}, {0, 1.5, 0});
    return scene;
}

Scene pinhole()
{
    Scene scene = lampBeforeBlack();
    lookFrom(scene, {1, 0.5, 4}, {0, 0, 0}, 30);
    return scene;
}

Scene orthographic()
{
    Scene scene = lampBeforeBlack();
    lookParallel(scene, {1, 0.5, 4}, {0, 0, 0}, 1.2);
    return scene;
}

void widenCamera(Scene& scene, float by)
{
    scene.camera.right *= 1 + by;
    scene.camera.down *= 1 + by;
}

/// A disk hides a lamp from the centre of the lens; a pinhole would see nothing but black. So all
/// light comes through the rim of the lens.
Scene lensRadius()
{
    Scene scene = scene32(0);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = {3, 4, 5};
    addRectangle(scene, {-0.5, -0.5, -6}, {1, 0, 0}, {0, 1, 0});
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0));
    appendShape(scene, makeDisk({0, 0, 2}, {0, 0, 1}, 0.4, 32), {}, 1, "screen");
    lookFrom(scene, {0, 0, 4}, {0, 0, 0}, 5);
    setLens(scene, 0.6f, 10);
    return scene;
}

void scaleLensRadius(Scene& scene, float by)
{
    scene.camera.lensRight *= 1 + by;
    scene.camera.lensDown *= 1 + by;
}

/// The picture shows only the even middle of a lamp's blur disk, whose brightness falls with the
/// square of the disk's size: the blur takes away 70 % of the light that the lamp in focus would
/// give.
Scene lensFocus()
{
    Scene scene = scene32(0);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = {3, 4, 5};
    addSphere(scene, {0, 0, 0}, 0.22f);
    lookFrom(scene, {0, 0, 4}, {0, 0, 0}, 3.6);
    setLens(scene, 0.8f, 8);
    return scene;
}

void scaleFocusDistance(Scene& scene, float by)
{
    scene.camera.focusDistance *= 1 + by;
}

/// A level rectangle whose normals at the corners lean towards +X by the given angle.
Scene leaning(uint type, double degrees)
{
    Scene scene = scene32(2);
    addMaterialOf(scene, type, {0.9f, 0.8f, 0.7f});
    Mesh mesh = makeRectangle({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    const double angle = degrees * std::numbers::pi / 180;
    mesh.normals.emplace_back(std::sin(angle), std::cos(angle), 0);
    mesh.normals.emplace_back(std::sin(0.8 * angle), std::cos(0.8 * angle), 0.1);
    for (MeshTriangle& triangle : mesh.triangles) triangle.normal = {0, 1, 0};
    appendShape(scene, mesh, {}, 0, "leaning");
    lookFrom(scene, {-3, 3, 0}, {0, 0, 0}, 40);
    return scene;
}

void leanMore(Scene& scene, float by)
{
    for (TriangleCorners& normals : scene.triangleCorners) {
        for (vec3* n : {&normals.n0, &normals.n1, &normals.n2}) {
            const double angle = std::atan2(double{n->x}, double{n->y}) * (1 + double{by});
            const double size = std::hypot(double{n->x}, double{n->y});
            *n = vec3(size * std::sin(angle), size * std::cos(angle), n->z);
        }
    }
}

/// The light grazes the geometric surface, at a cosine of 0.09; with the normals that lean towards
/// it the cosine is about 0.6, so they carry five sixths of the light.
Scene interpolatedLambert()
{
    Scene scene = leaning(MATERIAL_LAMBERT, 35);
    addLight(scene, LIGHT_DIRECTIONAL, {3, 4, 5}).direction =
        vec3(glm::normalize(glm::dvec3(-1, -0.09, 0)));
    return scene;
}

/// A flat mirror would show the sky at 45 degrees, where it is black; the leaning normals show what
/// is nearer to the horizon, where it gets brighter.
Scene interpolatedMirror()
{
    Scene scene = leaning(MATERIAL_MIRROR, 15);
    scene.probe = addProbe(scene, 1, 16, PROBE_LATLONG, FILTER_BILINEAR);
    for (uint32_t row = 4; row < 16; row++) {
        scene.probeTexels[row] = vec4(vec3(static_cast<float>(row) - 3), 0);
    }
    scene.background = blackProbe();
    return scene;
}

/// A ball before black: the share of the picture that it fills gives the light.
Scene sphere()
{
    Scene scene = scene32(2);
    addMaterialOf(scene, MATERIAL_LAMBERT, {0.8f, 0.7f, 0.6f});
    addSphere(scene, {0.2f, -0.1f, 0.5f}, 0.8f);
    setSky(scene);
    lookFrom(scene, {0, 0, 4}, {0, 0, 0}, 40);
    return scene;
}

void scaleRadius(Scene& scene, float by)
{
    scene.primitives[0].p1.x *= 1 + by;
}

}  // namespace

std::vector<Term> cameraTerms()
{
    return {
        {"pinhole", pinhole, widenCamera, "field of view"},
        {"orthographic", orthographic, widenCamera, "size of the view"},
        {"lensRadius", lensRadius, scaleLensRadius, "radius of the lens"},
        {"lensFocus", lensFocus, scaleFocusDistance, "focus distance"},
        {"interpolatedLambert", interpolatedLambert, leanMore, "lean of the normals"},
        {"interpolatedMirror", interpolatedMirror, leanMore, "lean of the normals"},
        {"sphere", sphere, scaleRadius, "radius"},
    };
}

}  // namespace sahl::testing
