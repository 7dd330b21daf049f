// Folded kernels that later processes find: the same ones, or none.

#include "device/kept_kernels.h"
#include "device/kernels.h"
#include "shared/bindings.h"
#include "support/temporary_folder.h"
#include "util/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace sahl {
namespace {

class KeptKernels : public ::testing::Test {
protected:
    void SetUp() override { ::setenv("XDG_CACHE_HOME", folder_.path.c_str(), 1); }
    void TearDown() override { ::unsetenv("XDG_CACHE_HOME"); }

    std::vector<fs::path> files() const
    {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder_.path / "sahl" / "kernels"))
            found.push_back(entry.path());
        return found;
    }

    testing::TemporaryFolder folder_;
    const std::vector<uint32_t> words_ = {0x07230203u, 0x00010300u, 5, 7, 0};
};

TEST_F(KeptKernels, areFoundAgainWordForWord)
{
    keepKernel(17, words_);
    EXPECT_EQ(keptKernel(17), words_);
    EXPECT_EQ(keptKernel(18), std::nullopt);
}

TEST_F(KeptKernels, thatWereChangedOrCutShortOrRenamedAreNone)
{
    keepKernel(17, words_);
    const fs::path file = files().at(0);
    const std::vector<uint8_t> whole = readFile(file);
    for (size_t i = 0; i < whole.size(); i++) {
        std::vector<uint8_t> changed = whole;
        changed[i] ^= 4;
        writeFileAtomically(file, changed);
        EXPECT_EQ(keptKernel(17), std::nullopt) << "byte " << i;
        writeFileAtomically(file, std::span(whole).first(i));
        EXPECT_EQ(keptKernel(17), std::nullopt) << i << " bytes left";
    }
    writeFileAtomically(file.parent_path() / "0000000000000012.spv", whole);
    EXPECT_EQ(keptKernel(18), std::nullopt);
    writeFileAtomically(file, whole);
    EXPECT_EQ(keptKernel(17), words_);
}

TEST_F(KeptKernels, haveKeysByWordsAndConstants)
{
    const uint32_t constants[] = {8, 8, 1};
    const uint32_t others[] = {8, 8, 2};
    EXPECT_EQ(kernelKey(words_, constants), kernelKey(words_, constants));
    EXPECT_NE(kernelKey(words_, constants), kernelKey(words_, others));
    EXPECT_NE(kernelKey(words_, constants), kernelKey(std::span(words_).first(4), constants));
}

TEST_F(KeptKernels, areKeptWhenTheyAreMade)
{
    std::vector<uint32_t> constants(SPEC_COUNT);
    constants[SPEC_STACK_SIZE] = 63;  // of no other test, as a process folds but once
    const std::span<const uint32_t> made = foldedKernel("adaptive_decide", constants);
    ASSERT_EQ(files().size(), 1u);
    const auto key = std::stoull(files().at(0).stem().string(), nullptr, 16);
    EXPECT_EQ(keptKernel(key), std::vector(made.begin(), made.end()));
}

TEST_F(KeptKernels, areNotNeeded)
{
    for (const char* nowhere : {"/dev/null", "/proc/none"}) {
        ::setenv("XDG_CACHE_HOME", nowhere, 1);
        EXPECT_NO_THROW(keepKernel(17, words_)) << nowhere;
        EXPECT_EQ(keptKernel(17), std::nullopt) << nowhere;
    }
    ::setenv("XDG_CACHE_HOME", folder_.path.c_str(), 1);
    fs::create_directories(folder_.path / "sahl" / "kernels" / "0000000000000011.spv");
    EXPECT_NO_THROW(keepKernel(17, words_)) << "a folder is in its place";
    EXPECT_EQ(keptKernel(17), std::nullopt);
}

TEST_F(KeptKernels, areSoManyAtMostOfWhichTheOldestGoFirst)
{
    keepKernel(0, words_);
    fs::last_write_time(files().at(0), fs::file_time_type::clock::now() - std::chrono::hours(1));
    for (uint64_t key = 1; key < MAX_KEPT_KERNELS; key++) keepKernel(key, words_);
    EXPECT_EQ(files().size(), MAX_KEPT_KERNELS);
    EXPECT_NE(keptKernel(0), std::nullopt);
    keepKernel(MAX_KEPT_KERNELS, words_);
    EXPECT_EQ(files().size(), MAX_KEPT_KERNELS);
    EXPECT_EQ(keptKernel(0), std::nullopt);
    EXPECT_NE(keptKernel(1), std::nullopt);
}

}  // namespace
}  // namespace sahl
