// Kernels whose constants are folded in before a driver sees them: the arithmetic that is left is
// still that which the build has checked and decorated.

#include "device/kernels.h"
#include "kernels/spirv.h"
#include "shared/bindings.h"
#include "shared/features.h"
#include "shared/scene_types.h"
#include "spirv_step.h"

#include <gtest/gtest.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include <cstdlib>

namespace sahl {
namespace {

using Words = std::vector<uint32_t>;

std::vector<uint32_t> constantsFor(uint32_t features)
{
    std::vector<uint32_t> constants(SPEC_COUNT);
    constants[SPEC_GROUP_WIDTH] = 8;
    constants[SPEC_GROUP_HEIGHT] = 8;
    constants[SPEC_STACK_SIZE] = MAX_STACK_SIZE;
    constants[SPEC_FEATURES] = features;
    return constants;
}

constexpr uint32_t PLAIN = FEATURE_PATHS | FEATURE_INDEPENDENT | FEATURE_LATLONG;
constexpr uint32_t FEATURE_SETS[] = {FEATURES_ALL, PLAIN,
                                     PLAIN | FEATURE_GLOSSY | FEATURE_PROBE_LIGHT};

Words folded(const std::string& kernel, uint32_t features)
{
    std::span<const uint32_t> words = foldedKernel(kernel, constantsFor(features));
    return {words.begin(), words.end()};
}

/// Counts the instructions for which `counts` says so.
template <class Predicate>
size_t count(const Words& module, Predicate counts)
{
    size_t n = 0;
    for (size_t at = 5; at < module.size(); at += module[at] >> spv::WordCountShift)
        n += counts(static_cast<spv::Op>(module[at] & spv::OpCodeMask), &module[at]) ? 1 : 0;
    return n;
}

/// Kernels are folded here and now: none that was kept is taken.
class FoldedKernels : public ::testing::Test {
protected:
    void SetUp() override { ::setenv("XDG_CACHE_HOME", "/dev/null", 1); }
    void TearDown() override { ::unsetenv("XDG_CACHE_HOME"); }
};

const char* const KERNELS[] = {
    "trace_rays_texel",    "trace_rays_image",    "trace_rays_storage",   //
    "path_texel",          "path_image",          "path_storage",         //
    "first_hits_texel",    "first_hits_image",    "first_hits_storage",   //
    "adaptive_path_texel", "adaptive_path_image", "adaptive_path_storage",
};

TEST_F(FoldedKernels, holdNoFloatInstructionThatDiffersBetweenDevices)
{
    for (const char* kernel : KERNELS)
        for (uint32_t features : FEATURE_SETS)
            EXPECT_TRUE(shader_step::refusedInstructions(folded(kernel, features)).empty())
                << kernel << features;
}

bool isFusedMultiplyAdd(spv::Op op, const uint32_t* words)
{
    return op == spv::OpExtInst && words[4] == GLSLstd450Fma;
}

TEST_F(FoldedKernels, fuseMultiplyAddOnlyWhereTheyAreToldThatTheDeviceRoundsItOnce)
{
    for (uint32_t math : {MATH_NATIVE, MATH_INTEGERS, MATH_FUSED}) {
        std::vector<uint32_t> constants = constantsFor(FEATURES_ALL);
        constants[SPEC_MATH] = math;
        for (const char* kernel : KERNELS) {
            const std::span<const uint32_t> words = foldedKernel(kernel, constants);
            const size_t fused = count({words.begin(), words.end()}, isFusedMultiplyAdd);
            EXPECT_EQ(fused > 0, math == MATH_FUSED) << kernel << ", " << math;
        }
    }
}

TEST_F(FoldedKernels, keepAllFloatArithmeticDecorated)
{
    for (const char* kernel : KERNELS) {
        for (uint32_t features : FEATURE_SETS) {
            Words module = folded(kernel, features);
            size_t decorated = count(module, [](spv::Op op, const uint32_t* words) {
                return op == spv::OpDecorate && words[2] == spv::DecorationNoContraction;
            });
            constexpr size_t DECORATION_WORDS = 3;
            size_t arithmetic =
                (shader_step::decoratedNoContraction(module).size() - module.size()) /
                DECORATION_WORDS;
            EXPECT_GT(decorated, 50u);
            EXPECT_EQ(decorated, arithmetic) << kernel << features;
        }
    }
}

TEST_F(FoldedKernels, haveNoConstantLeftToChoose)
{
    for (const char* kernel : KERNELS) {
        Words module = folded(kernel, FEATURES_ALL);
        EXPECT_EQ(count(module,
                        [](spv::Op op, const uint32_t*) {
                            return op >= spv::OpSpecConstantTrue && op <= spv::OpSpecConstantOp;
                        }),
                  0u);
    }
}

TEST_F(FoldedKernels, leaveOutWhatASceneHasNoUseFor)
{
    size_t all = folded("path_texel", FEATURES_ALL).size();
    size_t plain = folded("path_texel", PLAIN).size();
    EXPECT_LT(plain, all / 2);
    for (uint32_t feature = 1; feature <= FEATURE_MANY_TEXELS; feature *= 2)
        EXPECT_LT(folded("path_texel", FEATURES_ALL & ~feature).size(), all)
            << "feature " << feature;
}

TEST_F(FoldedKernels, areInlinedButWhereFunctionsReturnEarly_andAskNobodyToRefrain)
{
    for (const char* kernel : KERNELS) {
        const Words module = folded(kernel, FEATURES_ALL);
        const std::span<const uint32_t> whole = kernelSpirv(kernel);
        const auto isFunction = [](spv::Op op, const uint32_t*) { return op == spv::OpFunction; };
        EXPECT_LT(count(module, isFunction), count({whole.begin(), whole.end()}, isFunction) / 3) << kernel;
        EXPECT_EQ(count(module, [](spv::Op op, const uint32_t* words) {
                      return op == spv::OpFunction && words[3] != spv::FunctionControlMaskNone;
                  }), 0u) << kernel;
    }
}

TEST_F(FoldedKernels, areMadeOnce)
{
    EXPECT_EQ(foldedKernel("path_texel", constantsFor(0)).data(),
              foldedKernel("path_texel", constantsFor(0)).data());
    EXPECT_NE(foldedKernel("path_texel", constantsFor(0)).data(),
              foldedKernel("path_texel", constantsFor(FEATURE_SPHERES)).data());
}

}  // namespace
}  // namespace sahl
