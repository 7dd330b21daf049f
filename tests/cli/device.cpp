// The program on a Vulkan device: the same pictures and counters as on the CPU, and a verification
// that finds what differs.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <algorithm>
#include <regex>

namespace sahl::testing {
namespace {

using Json = nlohmann::json;

class DeviceProgram : public SceneFolderTest {
protected:
    /// The first device, which must be there and usable; its entry in `sahl devices --json`.
    void SetUp() override
    {
        RunResult list = sahl({"devices", "--json"});
        ASSERT_EQ(list.exitCode, 0) << list.err;
        devices_ = Json::parse(list.out);
        ASSERT_FALSE(devices_["vulkan"].empty()) << devices_["noVulkan"];
        ASSERT_TRUE(first()["usable"].get<bool>()) << first()["unusable"];
    }
    const Json& first() const { return devices_["vulkan"][0]; }
    const Json& cpu() const { return devices_["cpu"]; }
    size_t deviceCount() const { return devices_["vulkan"].size(); }
    std::string name(const Json& device) const { return device["name"]; }
    std::string driver(const Json& device) const { return device["driver"]; }

private:
    Json devices_;
};

TEST_F(DeviceProgram, devices_areListedForPeopleAndPrograms)
{
    std::string text = sahl({"devices"}).out;
    EXPECT_TRUE(text.starts_with("0    " + name(first()) + "\n")) << text;
    EXPECT_HAS(text, driver(first()));
    EXPECT_HAS(text, "UUID " + first()["uuid"].get<std::string>());
    EXPECT_HAS(text, "\ncpu  " + name(cpu()) + "\n");
    EXPECT_TRUE(std::regex_match(first()["uuid"].get<std::string>(),
                                 std::regex("[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")));
    EXPECT_GE(first()["maxStorageBufferBytes"].get<uint64_t>(), 1u << 27);
    EXPECT_GE(cpu()["threads"].get<int>(), 1);
}

TEST_F(DeviceProgram, indexUuidAndName_chooseTheSameDevice)
{
    for (std::string selection : {std::string("0"), first()["uuid"].get<std::string>(),
                                  name(first()), first()["kind"].get<std::string>()}) {
        RunResult result = sahl({"render", "ball.json", "--device", selection}, here());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_HAS(result.err, "device: " + name(first()) + " (" + driver(first()) + ")\n");
    }
}

TEST_F(DeviceProgram, variantThatWasTuned_runsUnlessAnotherIsNamed)
{
    fs::create_directories(folder / "sahl");
    writeText(folder / "sahl" / "variants.tsv", name(first()) + "\t" + driver(first()) + "\tstorage-16x8-by1\n");
    auto variantOf = [&](Arguments more) {
        Arguments arguments = {"render", "ball.json", "--device", "0", "--stats", "s.json", "-o", "a.pfm"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        RunOptions options = here();
        options.environment["XDG_CACHE_HOME"] = folder.string();
        EXPECT_EQ(sahl(arguments, options).exitCode, 0);
        const Json device = Json::parse(textOf(folder / "s.json"))["device"];
        EXPECT_EQ(device["texelBuffers"], device["variant"].get<std::string>().starts_with("texel"));
        return device["variant"].get<std::string>();
    };
    EXPECT_EQ(variantOf({}), "storage-16x8-by1");
    EXPECT_EQ(variantOf({"--variant", "texel-8x8-by8"}), "texel-8x8-by8");
    EXPECT_EQ(sahl({"render", "ball.json", "--variant", "texel"}, here()).exitCode, 2);
}

TEST_F(DeviceProgram, windowOfThePicture_equalsTheCpus)
{
    auto windowOn = [&](const char* device) {
        const Arguments arguments = {"render", "ball.json", "--device", device, "--spp",
                                     "10",     "--crop",    "5,3,7,6",  "-o",   "a.pfm"};
        EXPECT_EQ(sahl(arguments, here()).exitCode, 0);
        return textOf(folder / "a.pfm");
    };
    EXPECT_EQ(windowOn("0"), windowOn("cpu"));
}

TEST_F(DeviceProgram, pictureAndCounters_equalTheCpus)
{
    auto renderOn = [&](const std::string& device) {
        return sahl({"render", "ball.json", "--device", device, "--spp", "10", "-o",
                     device + ".pfm", "--stats", device + ".json"},
                    here());
    };
    ASSERT_EQ(renderOn("0").exitCode, 0);
    ASSERT_EQ(renderOn("cpu").exitCode, 0);
    EXPECT_EQ(textOf(folder / "0.pfm"), textOf(folder / "cpu.pfm"));
    Json ours = Json::parse(textOf(folder / "0.json"));
    Json theirs = Json::parse(textOf(folder / "cpu.json"));
    EXPECT_EQ(ours["counters"], theirs["counters"]);
    EXPECT_EQ(ours["tree"], theirs["tree"]);
    EXPECT_EQ(ours["scene"], theirs["scene"]);
    EXPECT_EQ(ours["device"]["name"], name(first()));
    EXPECT_GT(ours["device"]["dispatches"], 0);
    for (const auto& [group, values] : ours.items()) {
        if (!values.is_object()) continue;
        for (const auto& [key, value] : values.items()) {
            EXPECT_TRUE(theirs[group].contains(key)) << group << "." << key;
        }
    }
}

TEST_F(DeviceProgram, settingsForTesting_changeNoBit)
{
    ASSERT_EQ(sahl({"render", "ball.json", "--device", "0", "-o", "a.pfm"}, here()).exitCode, 0);
    const Arguments settings[] = {{"--tile", "5", "--group", "16x2", "--buffers", "storage"},
                                  {"--buffers", "texel", "--steps", "7"}};
    for (const Arguments& setting : settings) {
        Arguments arguments = {"render", "ball.json", "--device", "0", "-o", "b.pfm"};
        arguments.insert(arguments.end(), setting.begin(), setting.end());
        RunResult result = sahl(arguments, here());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(textOf(folder / "b.pfm"), textOf(folder / "a.pfm")) << setting[0];
    }
}

TEST_F(DeviceProgram, verify_findsTheDeviceEqualAndNamesBothSides)
{
    RunResult result =
        sahl({"verify", "ball.json", "--device", "0", "--difference", "d.exr"}, here());
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
    EXPECT_HAS(result.out, "EQUAL      0 differing bits\n");
    EXPECT_HAS(result.out, "device     " + name(first()) + " (" + driver(first()) + ")\n");
    EXPECT_HAS(result.out, "reference  " + name(cpu()) + " (" + driver(cpu()) + ")\n");
    EXPECT_EQ(files(), std::vector<std::string>{}) << "no difference, no picture of one";
}

TEST_F(DeviceProgram, verifyWithoutAScene_usesTheBuiltInOne)
{
    RunResult result =
        sahl({"verify", "--device", "0", "--width", "24", "--height", "16", "--spp", "2"});
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
    EXPECT_HAS(result.out, "scene      built-in scene, 24x16, 2 spp");
    EXPECT_HAS(result.out, "EQUAL ");
}

TEST_F(DeviceProgram, verifyQuietly_saysNothingWhenEqual)
{
    RunResult result = sahl({"verify", "ball.json", "--device", "0", "-q"}, here());
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out, "");
}

TEST_F(DeviceProgram, verifyAsJson_isForPrograms)
{
    RunResult result = sahl({"verify", "ball.json", "--device", "0", "--json"}, here());
    EXPECT_EQ(result.exitCode, 0) << result.err;
    Json json = Json::parse(result.out);
    EXPECT_EQ(json["version"], 1);
    EXPECT_EQ(json["equal"], true);
    EXPECT_EQ(json["differingPixels"], 0);
    EXPECT_EQ(json["differingFilmBits"], 0);
    EXPECT_EQ(json["device"]["name"], name(first()));
    EXPECT_EQ(json["device"]["driver"], driver(first()));
    EXPECT_EQ(json["reference"]["name"], name(cpu()));
    EXPECT_EQ(json["counters"]["cameraRays"], 16 * 12 * 4);
    EXPECT_FALSE(json.contains("first"));
}

TEST_F(DeviceProgram, verifyOfAllDevices_isATableOfEveryDeviceAndTheCpu)
{
    RunResult result = sahl({"verify", "ball.json", "--all-devices"}, here());
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
    EXPECT_TRUE(result.out.starts_with("scene  ball.json, 16x12, 4 spp, 4 bounces\n"))
        << result.out;
    EXPECT_TRUE(std::regex_search(result.out, std::regex("\n    0  .*  EQUAL, 0 differing bits\n")))
        << result.out;
    EXPECT_HAS(result.out, name(first()));
    EXPECT_HAS(result.out, driver(first()));
    EXPECT_TRUE(std::regex_search(result.out, std::regex("\n  cpu  .*  the reference\n")))
        << result.out;
}

TEST_F(DeviceProgram, verifyOfAllDevicesAsJson_hasAnEntryForEveryDevice)
{
    RunResult result = sahl({"verify", "ball.json", "--all-devices", "--json"}, here());
    EXPECT_EQ(result.exitCode, 0) << result.err;
    Json json = Json::parse(result.out);
    EXPECT_EQ(json["equal"], true);
    EXPECT_EQ(json["reference"]["name"], name(cpu()));
    ASSERT_EQ(json["devices"].size(), deviceCount());
    EXPECT_EQ(json["devices"][0]["uuid"], first()["uuid"]);
    EXPECT_EQ(json["devices"][0]["equal"], true);
    EXPECT_EQ(json["devices"][0]["counters"]["cameraRays"], 16 * 12 * 4);
}

TEST_F(DeviceProgram, verifyOfAllDevicesWithOptionsForOne_isAnErrorOfUsage)
{
    expectRefused(sahl({"verify", "--all-devices", "--device", "0"}), 2, "--device names one");
    expectRefused(sahl({"verify", "--all-devices", "--difference", "d.exr"}), 2, "--difference");
}

TEST_F(DeviceProgram, verifyOfAllVariants_isATableOfThem)
{
    RunResult result = sahl({"verify", "ball.json", "--device", "0", "--all-variants", "--buffers", "storage"}, here());
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
    EXPECT_TRUE(result.out.starts_with("scene  ball.json, 16x12, 4 spp, 4 bounces\n" + name(first()) + "  "))
        << result.out;
    EXPECT_HAS(result.out, "\n  texel-wave-registers             EQUAL, 0 differing bits, as storage-wave-registers\n");
    EXPECT_HAS(result.out, "\n  storage-8x8-by8-steps            EQUAL, 0 differing bits\n");
}

TEST_F(DeviceProgram, verifyOfAllVariantsAsJson_hasAnEntryForEachThatDevicesLists)
{
    RunResult result = sahl({"verify", "ball.json", "--device", "0", "--all-variants", "--json"}, here());
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["equal"], true);
    EXPECT_EQ(json["device"]["name"], name(first()));
    EXPECT_EQ(json["reference"]["name"], name(cpu()));
    std::string variants;
    for (const Json& row : json["variants"]) {
        EXPECT_EQ(row["equal"], true) << row;
        EXPECT_EQ(row["counters"]["cameraRays"], 16 * 12 * 4) << row;
        variants += row["variant"].get<std::string>() + "\n";
    }
    EXPECT_EQ(variants, sahl({"devices", "--variants"}, here()).out);
}

TEST_F(DeviceProgram, verifyOfAllVariantsWithOptionsForOne_isAnErrorOfUsage)
{
    expectRefused(sahl({"verify", "--all-variants", "--all-devices"}), 2, "--all-variants is for one device");
    expectRefused(sahl({"verify", "--all-variants", "--variant", "texel-wave"}), 2, "--variant names one");
    expectRefused(sahl({"verify", "--all-variants", "--difference", "d.exr"}), 2, "--difference is for one variant");
    expectRefused(sahl({"verify", "ball.json", "--all-variants", "--device", "cpu", "-q"}, here()), 2, "Vulkan devices");
}

/// A program whose reference has one bit of its text flipped: so it must find a difference.
class FlippedProgram : public DeviceProgram {
protected:
    RunResult verify(const Arguments& more) const
    {
        Arguments arguments = {"verify", "ball.json", "--device", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram(SAHL_FLIPPED_PROGRAM, arguments, withoutLeakCheck(here()));
    }
};

TEST_F(FlippedProgram, verify_namesTheFirstPixelSampleAndBounceWithBothValues)
{
    RunResult result = verify({"--difference", "where.exr"});
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    std::smatch words;
    EXPECT_TRUE(std::regex_search(
        result.out, words,
        std::regex("DIFFERENT  ([1-9]\\d*) pixels, ([1-9]\\d*) bits of the film")));
    EXPECT_TRUE(std::regex_search(
        result.out, std::regex("first at pixel \\(\\d+, \\d+\\), sample \\d+, bounce \\d+: \\w+")));
    for (const char* side : {"  device   ", "  reference"}) {
        EXPECT_HAS(result.out, side + std::string("  radiance ("));
    }
    EXPECT_HAS(result.out, "difference picture: where.exr\n");
    Image difference = readImage(folder / "where.exr");
    EXPECT_EQ(difference.width, 16u);
    EXPECT_GT(*std::max_element(difference.rgb.begin(), difference.rgb.end()), 0);
    EXPECT_GE(*std::min_element(difference.rgb.begin(), difference.rgb.end()), 0);
}

TEST_F(FlippedProgram, verifyAsJson_tellsTheSame)
{
    RunResult result = verify({"--json", "--difference", "where.pfm"});
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    Json json = Json::parse(result.out);
    EXPECT_EQ(json["equal"], false);
    EXPECT_GT(json["differingPixels"], 0);
    EXPECT_GT(json["differingFilmBits"], 0);
    const Json& first = json["first"];
    EXPECT_LT(first["x"], 16);
    EXPECT_LT(first["y"], 12);
    EXPECT_LT(first["sample"], 4);
    EXPECT_NE(first["device"], first["reference"]);

    // The picture is black up to that pixel.
    Image difference = readImage(folder / "where.pfm");
    size_t pixel = first["y"].get<size_t>() * 16 + first["x"].get<size_t>();
    EXPECT_EQ(std::count(difference.rgb.begin(), difference.rgb.begin() + 3 * pixel, 0.0f),
              3 * pixel);
}

TEST_F(FlippedProgram, verifyUnderAdaptiveSampling_findsTheDifference)
{
    RunResult result = verify({"--adaptive", "report", "--max-spp", "20"});
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    EXPECT_HAS(result.out, "DIFFERENT ");
    EXPECT_HAS(result.out, "first at pixel (");
}

TEST_F(FlippedProgram, verifyOfAllDevices_namesTheFirstDifferenceAndWhatItMeansForThePicture)
{
    RunResult result = runProgram(SAHL_FLIPPED_PROGRAM, {"verify", "ball.json", "--all-devices"},
                                  withoutLeakCheck(here()));
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    EXPECT_TRUE(std::regex_search(
        result.out,
        std::regex(
            "    0  .*  DIFFERENT, \\d+ pixels, \\d+ bits; first at pixel \\(\\d+, \\d+\\)")))
        << result.out;
    // A bit of a random number is flipped: other noise, the same picture.
    EXPECT_TRUE(std::regex_search(
        result.out,
        std::regex(
            "\n +no difference from an independent render beyond noise; a bias of [0-9.]+ % ")))
        << result.out;
}

TEST_F(FlippedProgram, verifyOfAllVariants_namesTheFirstDifferenceOfEach)
{
    RunResult result = verify({"--all-variants"});
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    EXPECT_HAS(result.out, "\n  texel-8x8-by1                    DIFFERENT, ");
    EXPECT_EQ(result.out.find("EQUAL"), std::string::npos) << result.out;
}

/// Every variant seems wrong where the reference has other random numbers.
TEST_F(FlippedProgram, tuning_keepsNothingThatIsWrong)
{
    RunOptions options = withoutLeakCheck(here());
    options.environment["XDG_CACHE_HOME"] = folder.string();
    options.timeLimit = 800;  // all kernels are made and measured
    RunResult result = runProgram(SAHL_FLIPPED_PROGRAM, {"devices", "--tune"}, options);
    EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
    EXPECT_HAS(result.out, "DIFFERENT from the CPU, ");
    EXPECT_EQ(result.out.find("kept in"), std::string::npos) << result.out;
    EXPECT_HAS(result.err, "variants that differ from the CPU were not kept");
    EXPECT_FALSE(fs::exists(folder / "sahl" / "variants.tsv"));
}

TEST_F(FlippedProgram, verifyQuietly_stillTellsTheDifference)
{
    RunResult result = verify({"-q"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_HAS(result.out, "DIFFERENT ");
    EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace sahl::testing
