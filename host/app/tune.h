// sahl devices --tune: which variant of the kernels is the fastest here.
#pragma once

namespace sahl {

/// Measures all variants on every Vulkan device that can be used, compares each one's pictures with the CPU's,
/// prints a table for each device and keeps the fastest right one for later starts. Returns the exit code:
/// checkFailed where any was wrong. Throws noDevice without a device, cannotWrite where nothing can be kept.
int tuneDevices();

}  // namespace sahl
