// Is this a scene that a device can render? The one place where the arrays of a loaded scene are
// looked at before anything trusts them.
#pragma once

#include "bvh/bvh.h"
#include "device/device.h"

#include <span>
#include <string>

namespace sahl {

/// Checks in one pass over every array that the tree is whole (every node and every primitive is
/// reached once, in the order in which the builder lays them out, no deeper than MAX_STACK_SIZE,
/// every box exactly that of what is below it), that all indices lie in range, that numbers are
/// finite and that types are known. Throws badInput naming `file`, the array and the element.
///   scene         without its frame
///   objectStarts  numbers of the first primitive of each object, ascending
///   returns       inner nodes, leaves, depth and largest leaf; the rest as by default
BvhStatistics checkArrays(const std::string& file, const DeviceScene& scene, uint rootRef,
                          std::span<const uint32_t> objectStarts);

/// Checks what goes into the frame: the camera's numbers, and that the probe's texels are there.
void checkFrame(const std::string& file, const Frame& frame, uint64_t texelCount);

}  // namespace sahl
