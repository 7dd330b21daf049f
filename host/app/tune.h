// sahl devices --tune: which variant of the kernels is the fastest here.
#pragma once

namespace sahl {

/// Measures all variants on every Vulkan device that can be used, prints a table for each and keeps
/// the fastest for later starts. Returns the exit code. Throws noDevice without a device,
/// cannotWrite where nothing can be kept.
int tuneDevices();

}  // namespace sahl
