// Variants of the kernels by name, and what tuning keeps for later starts.
#include "device/driver_habits.h"
#include "device/variants.h"
#include "support/temporary_folder.h"
#include "util/error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

namespace sahl::testing {
namespace {

/// The user's cache is a folder of the test's own.
class TunedVariants : public ::testing::Test {
protected:
    void SetUp() override { ::setenv("XDG_CACHE_HOME", folder_.path.c_str(), 1); }
    void TearDown() override { ::unsetenv("XDG_CACHE_HOME"); }

private:
    TemporaryFolder folder_;
};

TEST(Variants, haveNamesThatLeadBackToThem)
{
    std::set<std::string> names;
    for (const Variant& variant : allVariants()) {
        EXPECT_EQ(variantNamed(nameOf(variant)), variant);
        names.insert(nameOf(variant));
    }
    EXPECT_EQ(names.size(), allVariants().size());
    EXPECT_TRUE(names.contains("texel-8x8-by8"));
    EXPECT_TRUE(names.contains("texel-8x8-by8-registers"));
    EXPECT_TRUE(names.contains("texel-8x8-by8-registers-steps"));
    EXPECT_TRUE(names.contains("storage-wave-steps"));
}

TEST(Variants, areStandardByDriver)
{
    EXPECT_TRUE(standardVariant("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)").stackInRegisters);
    EXPECT_FALSE(standardVariant("SwiftShader driver Subzero").stackInRegisters);
    EXPECT_FALSE(standardVariant("").stackInRegisters);
    EXPECT_TRUE(standardVariant("NVIDIA 580.159.04").stepByStep);
    EXPECT_TRUE(standardVariant("llvmpipe Mesa 25.0.7-2 (LLVM 19.1.7)").stepByStep);
    for (const char* driver : {"llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", "SwiftShader driver Subzero", ""})
        EXPECT_FALSE(standardVariant(driver).stepByStep) << driver;
}

TEST(DriverHabits, loopsAreTakenToBeCutByAllWhoAreNotKnownBetter)
{
    EXPECT_FALSE(mayCutLoops("NVIDIA 580.159.04"));
    for (const char* driver : {"llvmpipe Mesa 25.0.7 (LLVM 19.1.7)", "SwiftShader driver Subzero", "radv Mesa 25.0.7", ""})
        EXPECT_TRUE(mayCutLoops(driver)) << driver;
}

TEST(DriverHabits, kernelsAreCompiledForUniformsByLavapipeBefore25)
{
    EXPECT_TRUE(compilesForUniforms("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"));
    EXPECT_FALSE(compilesForUniforms("llvmpipe Mesa 25.0.7 (LLVM 19.1.7)"));
    EXPECT_FALSE(compilesForUniforms("NVIDIA 580.159.04"));
}

TEST(Variants, ofOtherNamesAreRefusedWithAList)
{
    try {
        variantNamed("texel-7x7");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::usage);
        EXPECT_NE(std::string(error.what()).find("storage-16x8-by1"), std::string::npos)
            << error.what();
    }
}

TEST_F(TunedVariants, areKeptForTheDeviceAndTheVersionOfItsDriver)
{
    const Variant a = variantNamed("storage-8x8-by1"), b = variantNamed("texel-16x8-by8");
    EXPECT_EQ(tunedVariant("one", "driver 1"), std::nullopt);
    keepTunedVariant("one", "driver 1", a);
    keepTunedVariant("two", "driver 1", a);
    keepTunedVariant("one", "driver 1", b);
    EXPECT_EQ(tunedVariant("one", "driver 1"), b);
    EXPECT_EQ(tunedVariant("two", "driver 1"), a);
    EXPECT_EQ(tunedVariant("one", "driver 2"), std::nullopt);
}

TEST_F(TunedVariants, thatNobodyKnowsAnyMoreCountForNothing)
{
    keepTunedVariant("one", "driver", variantNamed("storage-8x8-by1"));
    std::ofstream(tuningFile()) << "one\tdriver\tpackets-of-yore\nrubbish";
    EXPECT_EQ(tunedVariant("one", "driver"), std::nullopt);
    keepTunedVariant("one", "driver", variantNamed("storage-8x8-by1"));
    EXPECT_EQ(tunedVariant("one", "driver"), variantNamed("storage-8x8-by1"));
}

TEST_F(TunedVariants, haveNoFileWithoutACacheOrAHome)
{
    const char* const home = std::getenv("HOME");
    const std::string before = home ? home : "";
    ::unsetenv("XDG_CACHE_HOME");
    ::setenv("HOME", "/somewhere", 1);
    EXPECT_EQ(tuningFile(), "/somewhere/.cache/sahl/variants.tsv");
    ::unsetenv("HOME");
    EXPECT_EQ(tuningFile(), "");
    EXPECT_THROW(keepTunedVariant("one", "driver", allVariants()[0]), Error);
    if (home) ::setenv("HOME", before.c_str(), 1);
}

}  // namespace
}  // namespace sahl::testing
