// Ways to run the kernels on a Vulkan device. All give the same bits; which is the fastest depends
// on the driver.
#pragma once

#include "device/device.h"

namespace sahl {

struct Variant {
    bool texelBuffers =
        true;  ///< the scene is read through them wherever it fits, else storage buffers
    uint32_t groupWidth = 8, groupHeight = 8;
    uint32_t samplesAtOnce = 0;     ///< that a dispatch may take a pixel further
    bool stackInRegisters = false;  ///< wherever a wide tree is no higher than there are registers
    bool stepByStep = false;  ///< walks go on by one node and one primitive at a time
    enum class Paths {
        whole,        ///< one kernel takes a path to its end
        waves,        ///< kernels take all paths a ray further in turns; queues are filled by ballots
        sharedWaves,  ///< the same, by shared memory
    } paths = Paths::whole;
    bool operator==(const Variant&) const = default;
};

/// "texel-8x8-by8-registers": how the scene is read, shape of a workgroup, samples at once, and
/// where the stack is if not in an array. "texel-wave", "texel-wave-shared": paths in waves.
std::string nameOf(const Variant& variant);

/// All that `sahl devices --tune` tries and `--variant` takes.
std::vector<Variant> allVariants();

/// Throws usage with the list of names.
Variant variantNamed(const std::string& name);

/// What runs where nothing was tuned: by a small table of drivers.
///   driver  its name and version, as in DeviceInfo
Variant standardVariant(const std::string& driver);

/// The variant that `sahl devices --tune` found for the device and driver, or nothing: where it was
/// not tuned, or by other names than today's. Never throws.
std::optional<Variant> tunedVariant(const std::string& device, const std::string& driver);

/// Keeps it for later starts, in tuningFile(). Throws cannotWrite.
void keepTunedVariant(const std::string& device, const std::string& driver, const Variant& variant);

/// variants.tsv in the folder `sahl` of the user's cache: $XDG_CACHE_HOME, else ~/.cache. Empty
/// where neither is known.
std::string tuningFile();

}  // namespace sahl
