// What a scene has that kernels without it leave out.
#pragma once

#include "device/device.h"

#include <algorithm>

namespace sahl {

struct SceneFeatures {
    bool instances = false;
    bool textures = false;
    bool cutouts = false;  ///< materials with holes
    bool operator==(const SceneFeatures&) const = default;
};

inline SceneFeatures featuresOf(const DeviceScene& scene)
{
    const bool textures = !scene.textures.empty();
    auto hasHoles = [](const Material& material) { return material.alphaCutoff > 0; };
    return {!scene.instances.empty(), textures,
            textures && std::any_of(scene.materials.begin(), scene.materials.end(), hasHoles)};
}

}  // namespace sahl
