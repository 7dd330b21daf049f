// The scenes of the report's benchmark, and two more: cameras, lights and placements as numbers.
#pragma once

#include "scene/scene.h"
#include "util/files.h"

#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// A line of the report's figure 11. Nodes are boxes of the tree, with children or without; leaves
/// are its triangles.
struct ReportRow {
    uint64_t nodes, leaves, rayTraversals, triangleIntersections;
    double buildSeconds, renderSeconds;
};

/// A mesh under one point light, on a floor of one triangle where `floor` is not 0.
struct BenchScene {
    const char* name;
    std::vector<std::string> meshes;  ///< names under a folder of assets, the best first
    glm::dvec3 eye, lookAt;
    double fovDeg;  ///< vertical
    vec3 light;
    float wattage;           ///< radiant intensity of the light [W/sr]
    float floor;             ///< distance of the floor's corners from the middle [m]
    bool instanced = false;  ///< 20 instances of the mesh rather than one
    std::optional<ReportRow> report;
};

/// In the order of the report's table.
const std::vector<BenchScene>& benchScenes();

/// The first of the scene's meshes that one of `folders` has; BUILT_IN for the teapot, where none
/// has one; empty for the others.
fs::path findMesh(const BenchScene& scene, const std::vector<fs::path>& folders);

constexpr const char* BUILT_IN = "built-in";

/// The scene as the report's pictures were made: the phong integrator without shadows, one sample
/// through every pixel's centre, size x size pixels.
Scene makeBenchScene(const BenchScene& scene, const fs::path& mesh, uint32_t size);

}  // namespace sahl
