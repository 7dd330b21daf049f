// What light sampling needs of a scene: every light that it may choose, by its power.
#pragma once

#include "device/device.h"

#include <vector>

namespace sahl {

/// The lights of a scene, and by what light sampling chooses among them. Also the probe, whose texels
/// are chosen by a table of their own.
struct LightTable {
    std::vector<Light> lights;  ///< of the scene file, then the shapes that shine, in an order that
                                ///< does not depend on the tree, then clusters
    std::vector<AliasEntry>
        entries;  ///< of the lights after the single ones, if any of them shines, then of the
                  ///< probe's texels
    std::vector<uint64_t>
        texelMasses;          ///< of the probe, see writeTexelWeights(); empty: it is not sampled
    uint singleCount = 0;     ///< lights that are chosen one by one: the first ones
    uint choiceCount = 0;     ///< lights that entries are for: the next ones
    uint clusterCount = 0;    ///< these, gathered
    float lightPerPower = 0;  ///< of shapes: chance to be chosen per luminance and area [sr W^-1];
                              ///< 0: none of them is sampled
    float probeMean = 0;  ///< luminance that shadow rays are for, over all directions; 0: the probe
                          ///< is not sampled
    vec3 probeSlope{0};   ///< the same as far as it is linear in the direction: mean + slope . d
};

/// More shapes that shine are not sampled: paths may still run into them.
constexpr uint64_t MAX_SHAPE_LIGHTS = 1u << 20;

/// Makes the table of a scene with its tree.
///   scene  its lights are those of the scene file; frame.rootRef, probe and lightSampling are set
/// A warning says so when there are more than MAX_SHAPE_LIGHTS.
LightTable makeLightTable(const DeviceScene& scene);

}  // namespace sahl
