// The build's checks of the text and of SPIR-V: each trap is set here, and must snap.

#include "lint.h"
#include "spirv_step.h"

#include <gtest/gtest.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

namespace sahl::shader_step {
namespace {

bool complains(const std::string& line) { return !lintText("x.glsl", line + "\n").empty(); }

TEST(Lint, refusesArithmeticBetweenLiterals)
{
    EXPECT_TRUE(complains("float x = 1.0f / 3.0f;"));
    EXPECT_TRUE(complains("float x = y + 2.0f * 3.0f;"));
    EXPECT_TRUE(complains("return 0.5f * -2.0f;"));
    EXPECT_TRUE(complains("f(1.0f - 0.25f);"));
    EXPECT_FALSE(complains("float x = y * 2.0f + 1.0f;"));
    EXPECT_FALSE(complains("float x = 1.0f + y;"));
}

TEST(Lint, refusesConstantsThatAreNoLiteral)
{
    EXPECT_TRUE(complains("CONST float INV = 1.0f / PI;"));
    EXPECT_TRUE(complains("CONST float TWO = PI;"));
    EXPECT_FALSE(complains("CONST float PI = 3.14159265f;"));
    EXPECT_FALSE(complains("CONST float SMALL = -3.0e-38f;"));
}

TEST(Lint, refusesFloatLiteralsWithoutSuffix)
{
    EXPECT_TRUE(complains("float x = y * 2.0;"));
    EXPECT_TRUE(complains("float x = 1e-3 + .5;"));
    EXPECT_FALSE(complains("uint x = y * 2u;"));
    EXPECT_FALSE(complains("float x = y * 2.0f;"));
}

TEST(Lint, refusesBuiltInsThatDiffer)
{
    for (const char* name : {"dot", "normalize", "mix", "min", "abs", "sin", "pow", "fma", "round", "isnan"}) {
        EXPECT_TRUE(complains("float x = " + std::string(name) + "(a, b);")) << name;
    }
    EXPECT_FALSE(complains("float x = min2(dot3(a, b), sqrt(c)) + floor(d);"));
}

TEST(Lint, refusesWhatTheCompilersReadDifferently)
{
    EXPECT_TRUE(complains("int x = a % b;"));
    EXPECT_TRUE(complains("vec3 x = v.xyz;"));
    EXPECT_TRUE(complains("void f(inout float x) {"));
    EXPECT_TRUE(complains("float f(float a[3]) {"));
    EXPECT_TRUE(complains("precise float x = a;"));
    EXPECT_TRUE(complains("    twist(a, a);"));
    EXPECT_FALSE(complains("    twist(a, b);"));
    EXPECT_FALSE(complains("void f(INOUT(float) x) {"));
    EXPECT_FALSE(complains("float y = v.y;"));
}

TEST(Lint, namesFileAndLine)
{
    auto findings = lintText("shaders/a.glsl", "float x = y;\nfloat z = 1.0 * y;\n");
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].rfind("shaders/a.glsl:2: ", 0), 0u) << findings[0];
}

TEST(Lint, readsOverComments) { EXPECT_FALSE(complains("x = y;  // 1.0 / 3.0, dot(a, b)")); }

/// A module with `float` and `vec3` types and one instruction.
std::vector<uint32_t> moduleWith(std::vector<uint32_t> instruction)
{
    auto op = [](spv::Op code, size_t words) { return static_cast<uint32_t>(words << 16 | code); };
    std::vector<uint32_t> module = {spv::MagicNumber, 0x10300, 0, 100, 0};
    auto add = [&](std::vector<uint32_t> words) { module.insert(module.end(), words.begin(), words.end()); };
    add({op(spv::OpTypeFloat, 3), 1, 32});
    add({op(spv::OpTypeVector, 4), 2, 1, 3});
    add({op(spv::OpTypeInt, 4), 3, 32, 0});
    instruction[0] = op(static_cast<spv::Op>(instruction[0]), instruction.size());
    add(instruction);
    return module;
}

TEST(Whitelist, letsCorrectlyRoundedArithmeticPass)
{
    for (uint32_t op : {spv::OpFAdd, spv::OpFSub, spv::OpFMul, spv::OpFDiv, spv::OpVectorTimesScalar}) {
        EXPECT_TRUE(refusedInstructions(moduleWith({op, 1, 50, 10, 11})).empty()) << op;
    }
    EXPECT_TRUE(refusedInstructions(moduleWith({spv::OpExtInst, 1, 50, 9, GLSLstd450Sqrt, 10})).empty());
    EXPECT_TRUE(refusedInstructions(moduleWith({spv::OpExtInst, 1, 50, 9, GLSLstd450Fma, 10, 11, 12})).empty());
    EXPECT_TRUE(refusedInstructions(moduleWith({spv::OpIMul, 3, 50, 10, 11})).empty());
}

TEST(Whitelist, refusesWhatDevicesRoundDifferently)
{
    for (uint32_t op : {spv::OpDot, spv::OpMatrixTimesVector, spv::OpVectorTimesMatrix, spv::OpMatrixTimesMatrix,
                        spv::OpFMod, spv::OpFRem, spv::OpOuterProduct, spv::OpDPdx}) {
        EXPECT_FALSE(refusedInstructions(moduleWith({op, 1, 50, 10, 11})).empty()) << op;
    }
    for (uint32_t function : {GLSLstd450Normalize, GLSLstd450Length, GLSLstd450FMix, GLSLstd450Sin,
                              GLSLstd450Pow, GLSLstd450InverseSqrt, GLSLstd450FMin, GLSLstd450FAbs}) {
        EXPECT_FALSE(refusedInstructions(moduleWith({spv::OpExtInst, 2, 50, 9, function, 10})).empty()) << function;
    }
    EXPECT_FALSE(refusedInstructions(moduleWith({spv::OpTypeFloat, 60, 64})).empty());
    EXPECT_FALSE(refusedInstructions(moduleWith({spv::OpIsNan, 4, 50, 10})).empty());
}

TEST(Whitelist, refusesWhatIsNoModule)
{
    EXPECT_THROW(refusedInstructions({}), std::runtime_error);
    EXPECT_THROW(refusedInstructions({1, 2, 3, 4, 5, 6}), std::runtime_error);
    auto module = moduleWith({spv::OpFAdd, 1, 50, 10, 11});
    module.pop_back();
    EXPECT_THROW(refusedInstructions(module), std::runtime_error);
}

TEST(NoContraction, decoratesEveryFloatOperationAndNothingElse)
{
    auto before = moduleWith({spv::OpFMul, 2, 50, 10, 11});
    auto after = decoratedNoContraction(before);
    ASSERT_EQ(after.size(), before.size() + 3);
    EXPECT_EQ(after[5], uint32_t(3 << 16 | spv::OpDecorate));
    EXPECT_EQ(after[6], 50u);
    EXPECT_EQ(after[7], uint32_t(spv::DecorationNoContraction));
    auto integer = moduleWith({spv::OpIMul, 3, 50, 10, 11});
    EXPECT_EQ(decoratedNoContraction(integer), integer);
}

}  // namespace
}  // namespace sahl::shader_step
