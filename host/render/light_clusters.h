// Many lights seen as a few, to estimate what a point would receive of them.
#pragma once

#include "device/device.h"

#include <vector>

namespace sahl {

/// A light as seen from afar.
struct FarLight {
    glm::dvec3 centre{0.0};
    double squaredRadius = 0;  ///< mean square of the distances from the centre [m^2]
    double strength = 0;       ///< luminance of the irradiance at a distance of 1 m [W]
};

/// Gathers lights that are near each other, in at most `limit` clusters of type LIGHT_CLUSTER:
/// again and again the cluster of most strength times size is cut in two where its middle is.
///   everywhere  irradiance by lights that are nowhere: part of the first cluster, which there then
///               is in any case [W m^-2]
std::vector<Light> clustersOf(std::vector<FarLight> lights, double everywhere, size_t limit);

}  // namespace sahl
