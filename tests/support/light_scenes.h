// Small scenes that have light of one kind each, or all of them.
#pragma once

#include "support/small_scenes.h"

#include <functional>
#include <string>

namespace sahl::testing {

struct LightScene {
    std::string name;
    Scene scene;
};

/// A floor, a wall, a ball of glass and one of the report's material.
inline Scene stageOf(uint32_t size)
{
    Scene scene = emptyScene(size, size, 5);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f, 0.6f, 0.5f));
    addLevel(scene, 0, 3);
    addRectangle(scene, {-3, 0, -2}, {6, 0, 0}, {0, 4, 0});
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
    addSphere(scene, {0.8f, 0.5f, 0.2f}, 0.5f);
    Material& report = addMaterialOf(scene, MATERIAL_REPORT, vec3(0.3f, 0.8f, 0.4f), 1.5f);
    report.diffuseWeight = 0.6f;
    report.specularWeight = 0.3f;
    addSphere(scene, {-0.8f, 0.6f, 0}, 0.6f);
    lookFrom(scene, {0, 1.5, 5}, {0, 0.8, 0}, 45);
    return scene;
}

/// A material that shines, for what is added next.
inline void addShining(Scene& scene, vec3 radiance)
{
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.2f)).emission = radiance;
}

/// Moves what was added from primitive `first` on into an object, and places it twice: stretched,
/// sheared and mirrored, and with another material.
inline void placeRest(Scene& scene, size_t first, uint material)
{
    std::vector<Primitive> object(scene.primitives.begin() + std::ptrdiff_t(first),
                                  scene.primitives.end());
    scene.primitives.resize(first);
    for (uint i = 0; i < object.size(); i++) object[i].number = i;
    scene.objects.push_back(object);
    Placement placement;
    placement.linear = {1.2, 0.1, 0, 0.2, -0.5, 0.1, 0, 0.3, 0.8};
    placement.translation = {-1.5, 2.2, 0.5};
    scene.instances.push_back(placement);
    placement.linear = glm::dmat3(0.6);
    placement.translation = {1.8, 1.5, 0.4};
    placement.material = material;
    scene.instances.push_back(placement);
}

inline void addRandomProbe(Scene& scene, uint32_t width, uint32_t height, uint mapping, uint filter)
{
    scene.probe = addProbe(scene, width, height, mapping, filter);
    for (size_t i = 0; i < scene.probeTexels.size(); i++) {
        const float bright = i * 7919 % 23 == 5 ? 12.0f : 0.1f;
        scene.probeTexels[i] = vec4(bright, bright * float(i * 31 % 10) * 0.1f, bright * 0.7f, 0);
    }
}

inline void addPointAndSpot(Scene& scene)
{
    addLight(scene, LIGHT_POINT, vec3(2, 1, 3)).position = {-2, 2.5f, 1};
    Light& spot = addLight(scene, LIGHT_SPOT, vec3(9, 8, 4));
    spot.position = {1.5f, 3, 1.5f};
    spot.direction = glm::normalize(vec3(-0.4f, -1, -0.5f));
    spot.cosInner = 0.95f;
    spot.cosOuter = 0.85f;
    addLight(scene, LIGHT_DIRECTIONAL, vec3(0.3f, 0.2f, 0.1f)).direction =
        glm::normalize(vec3(0.3f, -1, -0.6f));
}

/// One scene for each kind of light, and one that has all.
inline std::vector<LightScene> lightScenes(uint32_t size)
{
    auto with = [&](const std::function<void(Scene&)>& add) {
        Scene scene = stageOf(size);
        add(scene);
        return scene;
    };
    auto triangles = [](Scene& scene) {
        addShining(scene, vec3(6, 5, 3));
        addRectangle(scene, {-1, 2.6, -1}, {1.4, 0, 0}, {0, 0.2, 0.9});
        addShining(scene, vec3(1, 8, 2));
        addRectangle(scene, {2, 0.3, 0.5}, {0, 0.6, 0}, {0.1, 0, 0.4});
    };
    auto spheres = [](Scene& scene) {
        addShining(scene, vec3(9, 7, 4));
        addSphere(scene, {1.2f, 2, 0.5f}, 0.3f);
        addShining(scene, vec3(1, 2, 8));
        addSphere(scene, {-1.6f, 0.3f, 1}, 0.3f);  // on the floor
    };
    auto placed = [](Scene& scene) {
        const size_t first = scene.primitives.size();
        addShining(scene, vec3(5, 4, 3));
        addSphere(scene, {0, 0, 0}, 0.4f);
        addRectangle(scene, {0.5, 0, 0}, {0.5, 0, 0}, {0, 0.2, 0.5});
        addShining(scene, vec3(2, 5, 6));
        placeRest(scene, first, uint(scene.materials.size() - 1));
    };
    auto latLong = [](Scene& scene) {
        addRandomProbe(scene, 12, 6, PROBE_LATLONG, FILTER_BILINEAR);
    };
    auto angular = [](Scene& scene) { addRandomProbe(scene, 9, 9, PROBE_ANGULAR, FILTER_NEAREST); };
    return {{"triangles", with(triangles)},
            {"spheres", with(spheres)},
            {"instances", with(placed)},
            {"lat-long, bilinear", with(latLong)},
            {"angular map, nearest", with(angular)},
            {"all", with([&](Scene& scene) {
                 triangles(scene);
                 spheres(scene);
                 placed(scene);
                 addPointAndSpot(scene);
                 addRandomProbe(scene, 8, 8, PROBE_ANGULAR, FILTER_BILINEAR);
             })}};
}

}  // namespace sahl::testing
