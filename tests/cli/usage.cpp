// The command line itself: help, versions, and what is refused before anything is read.
#include "cli/sahl_program.h"

#include <regex>
#include <sstream>

namespace sahl::testing {
namespace {

/// Exit code 2, one sentence, and where to find more.
void expectUsageError(const Arguments& arguments, const std::string& sentence)
{
    RunResult result = sahl(arguments);
    expectRefused(result, 2, "sahl: " + sentence + "\ntry: sahl ");
    EXPECT_HAS(result.err, "--help\n");
}

TEST(Usage, noArguments_showAShortUsageOnStderr)
{
    RunResult result = sahl({});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err,
              "usage: sahl render|tonemap|compare|merge|verify|bvh|devices|bench [options]\ntry: sahl --help\n");
}

TEST(Usage, helpAndVersion_goToStdout)
{
    for (const Arguments& arguments :
         {Arguments{"--help"}, {"-h"}, {"render", "--help"}, {"tonemap", "-h"}, {"compare", "-h"}, {"merge", "-h"},
          {"verify", "-h"}, {"devices", "-h"}, {"bench", "-h"}}) {
        RunResult result = sahl(arguments);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_HAS(result.out, "Usage: sahl ");
        EXPECT_HAS(result.out, "Examples:\n  sahl ");
        EXPECT_EQ(result.err, "");
    }
    RunResult version = sahl({"--version"});
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_TRUE(std::regex_match(version.out, std::regex("sahl \\d+\\.\\d+\\.\\d+\n")));
    EXPECT_EQ(version.err, "");
}

TEST(Usage, helpAndVersionThatCannotBeWritten_areErrors)
{
    for (const char* argument : {"--help", "--version"}) {
        for (Stream stream : {Stream::full, Stream::closed}) {
            RunOptions options;
            options.standardOutput = stream;
            expectRefused(sahl({argument}, options), 4, "stdout: cannot write: ");
        }
    }
}

TEST(Usage, everyOptionWithAValue_showsItsDefault)
{
    for (const char* command : {"render", "compare", "verify"}) {
        std::istringstream help(sahl({command, "--help"}).out);
        std::string entry;
        int checked = 0;
        auto check = [&] {
            static const std::regex withValue("^  (-\\w,)?--[-,\\w]+ [A-Z]");
            if (!std::regex_search(entry, withValue)) return;
            EXPECT_HAS(entry, "(default: ");
            checked++;
        };
        for (std::string line; std::getline(help, line);) {
            EXPECT_LE(line.size(), 100u) << line;
            bool continues = line.starts_with("      ");
            if (!continues) {
                check();
                entry.clear();
            }
            entry += line;
        }
        EXPECT_GT(checked, command == std::string("compare") ? 6 : 15);
    }
}

TEST(Usage, unknownOption_suggestsTheNearest)
{
    expectUsageError({"render", "x.json", "--sspp", "3"},
                     "unknown option --sspp; did you mean --spp?");
    expectUsageError({"render", "--sspp", "3", "x.json"},
                     "unknown option --sspp; did you mean --spp?");
    expectUsageError({"render", "x.json", "--widht=3"},
                     "unknown option --widht; did you mean --width?");
    expectUsageError({"render", "x.json", "-spp", "3"}, "unknown option -spp; did you mean --spp?");
    expectUsageError({"render", "x.json", "--quantum-leap"}, "unknown option --quantum-leap");
    expectUsageError({"--spp", "3", "render", "x.json"},
                     "--spp belongs after the command: sahl render --spp ...");
}

TEST(Usage, unknownCommand_suggestsTheNearest)
{
    expectUsageError({"rendr", "x.json"}, "unknown command 'rendr'; did you mean render?");
    expectUsageError({"sing"}, "unknown command 'sing'; choose render, tonemap, compare, merge, verify, bvh, devices or bench");
    expectUsageError({"--"}, "a command is missing; choose render, tonemap, compare, merge, verify, bvh, devices or bench");
}

TEST(Usage, missingAndExtraWords_areNamed)
{
    expectUsageError({"render"}, "'sahl render' needs a scene: a .json, .gltf, .glb, .obj or .ply file");
    expectUsageError({"tonemap"}, "'sahl tonemap' needs a picture: an .exr, .hdr or .pfm file");
    expectUsageError({"render", "x.json", "--spp"}, "--spp needs a value: N");
    expectUsageError({"render", "x.json", "-o"}, "--output needs a value: FILE");
    expectUsageError({"render", "x.json", "--quiet=3"}, "--quiet takes no value");
    expectUsageError({"render", "x.json", "y.json"}, "unexpected 'y.json' after 'sahl render'");
    expectUsageError({"render", "x.json", "--", "y"}, "unexpected 'y' after 'sahl render'");
}

TEST(Usage, numbersOutOfRange_nameTheRange)
{
    for (const char* number : {"0", "-5", "1000000000", "4294967297", "18446744073709551617"}) {
        expectUsageError({"render", "x.json", "--spp", number},
                         std::string("--spp ") + number +
                             " is out of range; give a number from 1 to 16777216");
    }
    for (const char* number : {"abc", "1e9", "1.5", "", " 3", "3 ", "0x10", "--width"}) {
        expectUsageError({"render", "x.json", "--spp", number},
                         std::string("--spp '") + number +
                             "' is not a whole number; give one from 1 to 16777216");
    }
    for (const char* option : {"--width", "--height"}) {
        for (const char* number : {"0", "32769", "65537"}) {
            expectUsageError({"render", "x.json", option, number},
                             std::string(option) + " " + number +
                                 " is out of range; give a number from 1 to 32768");
        }
    }
    for (const char* number : {"nan", "inf", "bright"}) {
        expectUsageError({"render", "x.json", "--exposure", number},
                         std::string("--exposure '") + number +
                             "' is not a number; give one from -100 to 100");
    }
    expectUsageError({"render", "x.json", "--exposure", "1e999"},
                     "--exposure 1e999 is out of range; give a number from -100 to 100");
    expectUsageError({"render", "x.json", "--seed", "4294967296"},
                     "--seed 4294967296 is out of range; give a number from 0 to 4294967295");
    expectUsageError({"render", "x.json", "--group", "8"}, "--group '8' is no shape; give WxH");
    expectUsageError({"render", "x.json", "--group", "8x0"},
                     "--group 0 is out of range; give a number from 1 to 1024");
}

TEST(Usage, wordsThatAreNoChoice_nameTheChoices)
{
    expectUsageError({"render", "x.json", "--tone-map", "foo"},
                     "--tone-map 'foo' is not known; choose percentile, naive, exposure or filmic");
    expectUsageError({"render", "x.json", "--tone-map", "filmik"},
                     "--tone-map 'filmik' is not known; did you mean filmic?");
    expectUsageError({"render", "x.json", "--progress", "", "-q"},
                     "--progress '' is not known; choose auto, bar, plain or none");
}

class Repeated : public SceneFolderTest {};

TEST_F(Repeated, optionGivenTwice_takesTheLast)
{
    RunResult result = render({"--spp", "5", "--spp", "3", "--tone-map", "naive", "--tone-map",
                               "exposure", "-q", "-q", "--stats", "a.json", "--stats", "b.json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(files(), (std::vector<std::string>{"b.json", "ball.exr", "ball.png"}));
    auto statistics = nlohmann::json::parse(textOf(folder / "b.json"));
    EXPECT_EQ(statistics["counters"]["cameraRays"], 16 * 12 * 3);
}

TEST_F(Repeated, outputsGivenTwice_areBothWritten)
{
    RunResult result = render({"-o", "a.exr", "-o", "b.pfm"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "a.exr\nb.pfm\n");
    EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "b.pfm"}));
}

TEST_F(Repeated, allowedFolders_leaveTheSceneAlone)
{
    RunResult result =
        sahl({"render", "--device", "cpu", "--allow-path", ".", "--allow-path", "/", "ball.json"},
             here());
    EXPECT_EQ(result.exitCode, 0) << result.err;
}

}  // namespace
}  // namespace sahl::testing
