// Folded kernels on disk: folding takes a tenth of a second, which is a good part of a start with
// everything else at hand.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sahl {

/// Most kernels that are kept, of 50 to 420 KB each; the oldest go first.
constexpr size_t MAX_KEPT_KERNELS = 64;

/// What tells folded kernels apart: the SPIR-V before, the constants, and how they
/// are folded.
uint64_t kernelKey(std::span<const uint32_t> spirv, std::span<const uint32_t> constants);

/// The kernel that was kept under that key, in `kernels` of the user's cache (util/cache_folder.h).
/// Nothing where there is none, or not the whole of it.
std::optional<std::vector<uint32_t>> keptKernel(uint64_t key);

/// Keeps a kernel for later processes. Where that cannot be, nothing happens: it is made again each
/// time.
void keepKernel(uint64_t key, std::span<const uint32_t> folded);

}  // namespace sahl
