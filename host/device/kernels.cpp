#include "device/kernels.h"

#include "device/kept_kernels.h"
#include "kernels/spirv.h"
#include "vulkan/fold_constants.h"

#include <map>
#include <mutex>

namespace sahl {

std::span<const uint32_t> foldedKernel(const std::string& name,
                                       const std::vector<uint32_t>& constants)
{
    static std::mutex mutex;
    static std::map<std::pair<std::string, std::vector<uint32_t>>, std::vector<uint32_t>> made;
    {
        std::lock_guard lock(mutex);
        auto found = made.find({name, constants});
        if (found != made.end()) return found->second;
    }
    const std::span<const uint32_t> spirv = kernelSpirv(name);
    const uint64_t key = kernelKey(spirv, constants);
    std::optional<std::vector<uint32_t>> folded = keptKernel(key);
    if (!folded) {
        folded = foldedConstants(spirv, constants);
        keepKernel(key, *folded);
    }
    std::lock_guard lock(mutex);
    return made.emplace(std::pair(name, constants), std::move(*folded)).first->second;
}

}  // namespace sahl
