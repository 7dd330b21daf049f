// The trees of a loaded scene: is each of them whole, and is each primitive told from all others?
#pragma once

#include "bvh/bvh.h"
#include "device/device.h"

#include <string>

namespace sahl {

/// Walks the world's tree and those of the objects, in the order in which they lie in the arrays:
/// what checkArrays() promises of nodes, boxes and depth, that the world's tree has every instance
/// once, and that the primitives' numbers are unique. Primitives and instances must be sound by
/// themselves. Throws badInput naming `file`, the array and the element.
///   returns  as checkArrays() does
BvhStatistics checkTrees(const std::string& file, const DeviceScene& scene, uint rootRef);

}  // namespace sahl
