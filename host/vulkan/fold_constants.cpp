#include "vulkan/fold_constants.h"

#include "util/error.h"

#include <spirv-tools/libspirv.h>
#include <spirv-tools/optimizer.hpp>

#include <fmt/format.h>

namespace sahl {

namespace {

using ValuesById = std::unordered_map<uint32_t, std::vector<uint32_t>>;

/// None of the passes folds arithmetic that is decorated NoContraction.
void registerPasses(spvtools::Optimizer& optimizer, const ValuesById& values)
{
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
}

}  // namespace

std::string foldingPasses()
{
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    registerPasses(optimizer, {});
    std::string text = spvSoftwareVersionDetailsString();
    for (const char* pass : optimizer.GetPassNames()) text += fmt::format(" {}", pass);
    return text;
}

std::vector<uint32_t> foldedConstants(std::span<const uint32_t> spirv,
                                      std::span<const uint32_t> values)
{
    ValuesById byId;
    for (uint32_t id = 0; id < values.size(); id++) byId[id] = {values[id]};

    std::string finding;
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.SetMessageConsumer(
        [&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
            if (level <= SPV_MSG_ERROR) finding = text;
        });
    registerPasses(optimizer, byId);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);  // the build has validated it
    std::vector<uint32_t> folded;
    if (!optimizer.Run(spirv.data(), spirv.size(), &folded, options))
        throw Error(ErrorKind::deviceLost,
                    fmt::format("fold constants into a shader: {}", finding));
    return folded;
}

}  // namespace sahl
