#include "app/bench/scenes.h"

#include "scene/probe.h"
#include "util/error.h"

#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr uint32_t STANDARD_TRIANGLES = 70'000;

/// Appends rows x columns cells of two triangles; corner(u, v) with u and v in [0,1].
template <class Corner>
void appendGrid(Mesh& mesh, uint32_t rows, uint32_t columns, const Corner& corner)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t row = 0; row <= rows; row++) {
        for (uint32_t column = 0; column <= columns; column++)
            mesh.positions.emplace_back(corner(double(column) / columns, double(row) / rows));
    }
    for (uint32_t row = 0; row < rows; row++) {
        for (uint32_t column = 0; column < columns; column++) {
            const uint32_t a = first + row * (columns + 1) + column, b = a + columns + 1;
            mesh.triangles.push_back({.position = {a, a + 1, b + 1}});
            mesh.triangles.push_back({.position = {a, b + 1, b}});
        }
    }
}

uint32_t cells(double wanted)
{
    return static_cast<uint32_t>(std::max(3.0, std::round(wanted)));
}

/// Shaft, foot and head are one surface of revolution.
void appendColumn(Mesh& mesh, const glm::dvec3& foot, double height, uint32_t sides)
{
    appendGrid(mesh, 2 * sides, sides, [&](double u, double v) {
        const double ends = std::pow(std::abs(2 * v - 1), 12);
        const double radius = 0.28 + 0.25 * ends + 0.012 * std::cos(16 * 2 * std::numbers::pi * u) * (1 - ends);
        const double angle = 2 * std::numbers::pi * u;
        return foot + glm::dvec3(radius * std::cos(angle), v * height, -radius * std::sin(angle));
    });
}

Scene sceneOf(const Mesh& mesh, const char* name, const CameraDescription& camera, uint32_t size, uint32_t spp)
{
    Scene scene;
    scene.name = name;
    makeCommonWork(scene, size, spp);
    appendShape(scene, mesh, {}, 0, name);
    placeCamera(scene, camera);
    return scene;
}

}  // namespace

Mesh makeWavyTorus(uint32_t triangles)
{
    const uint32_t sides = cells(std::sqrt(triangles / 5.0)), rings = cells(triangles / 2.0 / sides);
    Mesh mesh;
    appendGrid(mesh, rings, sides, [](double u, double v) {
        const double a = 2 * std::numbers::pi * v, b = 2 * std::numbers::pi * u;
        const double radius = 0.4 + 0.05 * std::sin(7 * a) * std::cos(5 * b) + 0.012 * std::sin(31 * a + 17 * b) +
                              0.004 * std::sin(83 * a - 59 * b);
        const double arm = 1 + radius * std::cos(b);
        return glm::dvec3(arm * std::cos(a), radius * std::sin(b), arm * std::sin(a));
    });
    return mesh;
}

Mesh makeCourtyard(uint32_t triangles)
{
    const uint32_t n = cells(std::sqrt(triangles / 216.0));
    Mesh mesh;
    auto flat = [&](glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v) {
        appendGrid(mesh, 2 * n, 2 * n, [&](double s, double t) { return corner + s * u + t * v; });
    };
    const glm::dvec3 x(20, 0, 0), y(0, 9, 0), z(0, 0, 10);
    flat({-10, 0, -5}, z, x);
    flat({-10, 0, -5}, x, y);
    flat({-10, 0, 5}, y, x);
    flat({-10, 0, -5}, y, z);
    flat({10, 0, -5}, z, y);
    for (double side : {-5.0, 3.0}) flat({-10, 4.2, side}, {0, 0, 2}, x);
    for (int i = 0; i < 10; i++) {
        for (double side : {-3.0, 3.0}) {
            for (double storey : {0.0, 4.2}) appendColumn(mesh, {-9 + 2 * i, storey, side}, 4.2, n);
        }
    }
    return mesh;
}

void makeCommonWork(Scene& scene, uint32_t size, uint32_t spp)
{
    scene.materials.clear();
    scene.materialNames.clear();
    const uint32_t grey = addMaterial(scene, "grey", vec3(0.7f));
    for (Primitive& primitive : scene.primitives) primitive.material = grey;
    scene.lights.clear();
    scene.textures.clear();
    setProbe(scene, {1, 1, {1, 1, 1}}, PROBE_LATLONG, FILTER_NEAREST, "white");
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.spp = spp;
    settings.maxBounces = 6;
    settings.lightSampling = LIGHTS_BSDF_ONLY;
    settings.shading |= SHADING_FLAT;
    scene.settings = settings;
    if (scene.cameraDescription) scene.camera = makeCamera(*scene.cameraDescription, size, size);
}

Scene torusScene(uint32_t triangles, uint32_t size, uint32_t spp)
{
    CameraDescription camera;
    camera.eye = {0.8, 2.2, 2.9};
    camera.fovDeg = 45;
    return sceneOf(makeWavyTorus(triangles), "torus", camera, size, spp);
}

Scene courtyardScene(uint32_t triangles, uint32_t size, uint32_t spp)
{
    CameraDescription camera;
    camera.eye = {-8.5, 1.7, 0.6};
    camera.lookAt = {6, 3.2, -1};
    camera.fovDeg = 60;
    return sceneOf(makeCourtyard(triangles), "courtyard", camera, size, spp);
}

std::vector<Scene> commonScenes(const BenchOptions& options)
{
    std::vector<Scene> scenes;
    for (const std::string& path : options.scenes) {
        SceneOptions read = options.common.scene;
        read.allowedPaths.emplace_back("/");
        Scene scene = loadScene(path, read);
        if (!scene.instances.empty())
            throw badInput("{}: has instances, which this benchmark does not measure; "
                           "sahl render --stats counts their rays",
                           path);
        scene.name = fs::path(path).stem().string();
        makeCommonWork(scene, options.size, options.spp);
        scenes.push_back(std::move(scene));
    }
    if (!scenes.empty()) return scenes;
    const uint32_t triangles = options.triangles > 0 ? options.triangles : STANDARD_TRIANGLES;
    scenes.push_back(torusScene(triangles, options.size, options.spp));
    scenes.push_back(courtyardScene(triangles, options.size, options.spp));
    return scenes;
}

}  // namespace sahl
