// What a scene has that kernels without it leave out.
#pragma once

#include "device/device.h"

#include <algorithm>

namespace sahl {

struct SceneFeatures {
    bool instances = false;
    bool textures = false;
    bool cutouts = false;  ///< materials with holes
    bool glossy = false;   ///< materials from MATERIAL_ROUGH_CONDUCTOR on: kernels of their own
    bool operator==(const SceneFeatures&) const = default;
};

inline SceneFeatures featuresOf(const DeviceScene& scene)
{
    const bool textures = !scene.textures.empty();
    auto hasHoles = [](const Material& material) { return material.alphaCutoff > 0; };
    auto isGlossy = [](const Material& material) { return material.type >= MATERIAL_ROUGH_CONDUCTOR; };
    return {!scene.instances.empty(), textures,
            textures && std::any_of(scene.materials.begin(), scene.materials.end(), hasHoles),
            std::any_of(scene.materials.begin(), scene.materials.end(), isGlossy)};
}

}  // namespace sahl
