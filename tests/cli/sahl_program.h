// What the tests of the built program share: running it, and small scenes for it.
#pragma once

#include "cli/programs.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace sahl::testing {

namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;
using Stream = RunOptions::Stream;

/// Drivers keep memory until the end of the process; a sanitizer would call that a leak.
inline RunOptions withoutLeakCheck(RunOptions options)
{
    std::string given;
    if (const char* ours = std::getenv("ASAN_OPTIONS")) given = std::string(ours) + ":";
    options.environment.emplace("ASAN_OPTIONS", given + "detect_leaks=0");
    return options;
}

inline RunResult sahl(const Arguments& arguments, const RunOptions& options = {})
{
    bool onCpu = std::find(arguments.begin(), arguments.end(), "cpu") != arguments.end();
    return runProgram(SAHL_PROGRAM, arguments, onCpu ? options : withoutLeakCheck(options));
}

inline std::string textOf(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void writeText(const fs::path& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
}

/// A clay ball in the studio: a few hundred triangles, `width` x `height` pixels, 4 samples.
inline std::string ballScene(int width = 16, int height = 12)
{
    nlohmann::json scene = {
        {"camera", {{"eye", {0, 1, 5}}, {"lookAt", {0, 0, 0}}, {"fovDeg", 35}}},
        {"film", {{"width", width}, {"height", height}}},
        {"integrator", {{"samplesPerPixel", 4}, {"maxBounces", 4}}},
        {"materials", {{"clay", {{"type", "lambert"}, {"baseColor", {0.7, 0.4, 0.2}}}}}},
        {"shapes", {{{"type", "sphereMesh"}, {"level", 2}, {"material", "clay"}}}},
        {"environment", {{"builtin", "studio"}}}};
    return scene.dump();
}

/// A folder to run in, with the scene ball.json in it.
class SceneFolderTest : public ::testing::Test {
protected:
    SceneFolderTest() { writeText(folder / "ball.json", ballScene()); }

    RunOptions here() const
    {
        RunOptions options;
        options.folder = folder;
        return options;
    }

    /// `sahl render ball.json --device cpu` and more, in the folder.
    RunResult render(const Arguments& more, const RunOptions& options) const
    {
        Arguments arguments = {"render", "ball.json", "--device", "cpu"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return sahl(arguments, options);
    }
    RunResult render(const Arguments& more = {}) const { return render(more, here()); }

    /// Names in the folder, sorted, without ball.json.
    std::vector<std::string> files() const
    {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) {
            std::string name = entry.path().filename().string();
            if (name != "ball.json") names.push_back(name);
        }
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    TemporaryFolder temporary_;

protected:
    fs::path folder = temporary_.path;
};

inline bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Shows the whole text when `part` is not in it.
#define EXPECT_HAS(text, part) EXPECT_PRED2(::sahl::testing::has, (text), (part))

/// Refused with this exit code and these words, nothing on stdout, without delay.
inline void expectRefused(const RunResult& result, int exitCode, const std::string& words)
{
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_HAS(result.err, words);
    EXPECT_TRUE(result.err.starts_with("sahl: ")) << result.err;
    EXPECT_LT(result.seconds, 5);
}

}  // namespace sahl::testing
