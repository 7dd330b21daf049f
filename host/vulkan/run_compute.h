// One compute shader over a few arrays, run once: for tests of what a driver computes.
#pragma once

#include "vulkan/pipeline.h"

namespace sahl {

/// What may go along with the arrays.
struct ComputeParameters {
    std::string name = "test";
    std::array<uint32_t, 3> groups = {1, 1, 1};  ///< workgroups
    std::span<const std::byte> pushConstants;
    std::vector<uint32_t> specialisation;  ///< constants with ids 0, 1, 2, ...
};

/// Runs `spirv` with arrays[i] as storage buffer at set 0, binding i; every array goes in before
/// and comes back after. Throws as createBuffer, createComputePipeline and runCommands do.
///
///   std::vector<float> a(64), b(64);
///   runCompute(context, spirv, {std::as_writable_bytes(std::span(a)),
///                               std::as_writable_bytes(std::span(b))}, {});
void runCompute(Context& context, std::span<const uint32_t> spirv,
                const std::vector<std::span<std::byte>>& arrays,
                const ComputeParameters& parameters);

}  // namespace sahl
