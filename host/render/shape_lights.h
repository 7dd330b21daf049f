// Which shapes of a scene shine: those that light sampling may choose.
#pragma once

#include "render/light_clusters.h"

#include <optional>
#include <vector>

namespace sahl {

/// A triangle or a sphere that shines, where it stands in the world.
struct ShapeLight {
    uint type = LIGHT_TRIANGLE;   ///< or LIGHT_SPHERE
    uint slot = 0;                ///< in `primitives`
    uint instance = NO_INSTANCE;  ///< that it is in
    double weight = 0;  ///< luminance of its emission times its area in the world [W sr^-1]; of an
                        ///< ellipsoid as pdfSphereSurface() in shape_lights.glsl has it
    FarLight far;       ///< what it is from afar, seen at a mean angle
};

/// All of them, in the order in which the files gave them: the world's, then those of each
/// instance. The order in the tree does not matter. Nothing when there are more than `limit`.
std::optional<std::vector<ShapeLight>> shapeLightsOf(const DeviceScene& scene, size_t limit);

}  // namespace sahl
