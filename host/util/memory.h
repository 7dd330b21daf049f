// How much memory there is, so that what cannot fit is refused before it is begun; and giving back what
// has been freed.
#pragma once

#include <cstdint>
#include <string>

namespace sahl {

/// Bytes that this process can still get: what the machine has available, the limits of its control
/// groups, the limit of its address space; the least of those that can be found out.
uint64_t availableMemory();

/// Throws deviceLost, with both numbers, when `bytes` are more than that. `what` needs them
/// ("a picture of 640 x 480 pixels"), and `help` is what the user can do.
void requireMemory(uint64_t bytes, const std::string& what, const std::string& help);

/// From now on a large block goes back to the system when it is freed, and is not kept for later: the
/// arrays of a scene, of which most are needed at one stage only. Called once, at the start.
void returnLargeBlocks();

/// Gives back what has been freed of small blocks: after work that leaves many, such as a driver's
/// compiler. Takes milliseconds.
void returnFreedMemory();

}  // namespace sahl
