// What `sahl verify` of one device and of all devices have in common.
#pragma once

#include "app/options.h"
#include "render/verify.h"

#include <nlohmann/json.hpp>

namespace sahl {

struct VerifyOptions {
    CommonOptions common;
    std::string differencePath;
    bool json = false;
    bool allDevices = false;
    bool allVariants = false;
};

/// Compares a device with the reference, with progress on stderr, under the rule of the scene.
VerifyResult verifyWithProgress(Device& device, Device& reference, const PreparedScene& prepared,
                                const VerifyOptions& options);

/// The keys "equal", "differingPixels", "differingFilmBits", "counters" and, after a difference,
/// "first".
nlohmann::ordered_json resultJson(const VerifyResult& result);

/// "built-in scene, 64x64, 4 spp, 8 bounces"
std::string sceneText(const Scene& scene);

/// "EQUAL, 0 differing bits", or how much differs and where first.
std::string verdictText(const VerifyResult& result);

/// "(3, 5), sample 2, bounce 1: hit"
std::string placeText(const Divergence& divergence);

/// `sahl verify --all-devices`: every Vulkan device found, against the CPU. Gives the exit code.
int verifyAllDevices(const VerifyOptions& options, const PreparedScene& prepared);

/// `sahl verify --all-variants`: every variant of the kernels on one device, against the CPU. Gives the exit
/// code. Throws usage where the device is the CPU, which has none.
int verifyAllVariants(const VerifyOptions& options, const PreparedScene& prepared);

}  // namespace sahl
