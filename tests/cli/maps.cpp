// `sahl render --map` and --histogram: pictures beside the picture.
#include "cli/sahl_program.h"
#include "image/image.h"
#include "support/png_files.h"

#include <numeric>

namespace sahl::testing {
namespace {

using Names = std::vector<std::string>;

class Maps : public SceneFolderTest {
protected:
    /// Refused before rendering, with exit code 2.
    void expectUsageError(const Arguments& more, const std::string& sentence) const
    {
        expectRefused(render(more), 2, "sahl: " + sentence);
        EXPECT_EQ(files(), Names{});
    }
};

TEST_F(Maps, everyQuantity_becomesAPicture)
{
    Arguments arguments = {"-o", "a.exr"};
    std::string answer = "a.exr\n";
    for (std::string name : {"nodes", "primitives", "samples", "error", "normals",
                             "geometric-normals", "depth", "albedo"}) {
        arguments.insert(arguments.end(), {"--map", name + "=" + name + ".png"});
        answer += name + ".png\n";
    }
    RunResult result = render(arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, answer);
    for (const char* flat : {"normals.png", "geometric-normals.png", "albedo.png"}) {
        const Image8 map = readPng(folder / flat);
        EXPECT_EQ(map.width, 16u) << flat;
        EXPECT_EQ(map.height, 12u) << flat;
        EXPECT_GT(std::accumulate(map.rgb.begin(), map.rgb.end(), 0), 1000) << flat;
    }
    for (const char* scaled : {"nodes.png", "primitives.png", "samples.png", "depth.png"}) {
        EXPECT_GT(readPng(folder / scaled).width, 40u) << scaled;
    }
    EXPECT_HAS(textOf(folder / "nodes.png"), "sahl.map");
}

TEST_F(Maps, colours_areThoseOfTheLayer)
{
    ASSERT_EQ(render({"-o", "a.exr", "--map", "nodes=nodes.png", "--map-colors", "grey",
                      "--map-scale", "off", "--map-range", "0:200", "--max-bounces", "0", "--spp",
                      "1", "--stats", "stats.json"})
                  .exitCode,
              0);
    const Image8 map = readPng(folder / "nodes.png");
    ASSERT_EQ(map.rgb.size(), 3u * 16 * 12);
    // With nearest rounding each level of grey stands for 200/255 visits.
    auto pixels = nlohmann::json::parse(textOf(folder / "stats.json"))["pixels"];
    const auto most = static_cast<double>(*std::max_element(map.rgb.begin(), map.rgb.end()));
    EXPECT_NEAR(most / 255 * 200, pixels["nodeVisitsMax"].get<double>(), 0.4);
    double sum = 0;
    for (size_t i = 0; i < map.rgb.size(); i += 3) sum += map.rgb[i];
    EXPECT_NEAR(sum / (16 * 12) / 255 * 200, pixels["nodeVisitsMean"].get<double>(), 0.4);
}

/// A lamp that scattered rays alone find, and seldom, above a floor.
std::string seldomFoundLamp()
{
    nlohmann::json scene = {
        {"camera", {{"eye", {0, 2, 3}}, {"lookAt", {0, 0, 0}}, {"fovDeg", 40}}},
        {"film", {{"width", 24}, {"height", 16}}},
        {"integrator", {{"samplesPerPixel", 32}, {"maxBounces", 1}, {"lightSampling", "bsdf"}}},
        {"materials",
         {{"grey", {{"type", "lambert"}}},
          {"lamp", {{"type", "lambert"}, {"emission", {225, 225, 225}}}}}},
        {"shapes",
         {{{"type", "rectangle"},
           {"corner", {-5, 0, 5}},
           {"edgeU", {10, 0, 0}},
           {"edgeV", {0, 0, -10}},
           {"material", "grey"}},
          {{"type", "sphere"}, {"center", {0, 4, 0}}, {"radius", 0.2}, {"material", "lamp"}}}},
        {"environment", {{"radiance", {0.1, 0.1, 0.1}}}}};
    return scene.dump();
}

TEST_F(Maps, ofFirefliesShowThoseThatTheStatisticsCount)
{
    writeText(folder / "ball.json", seldomFoundLamp());
    const RunResult result =
        render({"-o", "a.exr", "--map", "fireflies=f.png", "--map-colors", "grey", "--map-scale",
                "off", "--map-range", "0:2", "--stats", "stats.json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto told = nlohmann::json::parse(textOf(folder / "stats.json"))["fireflies"];
    const Image8 map = readPng(folder / "f.png");
    ASSERT_EQ(map.rgb.size(), 3u * 24 * 16);

    // A firefly is at least twice as bright as what is around it, so it is white; all else is black
    size_t white = 0;
    for (size_t i = 0; i < map.rgb.size(); i += 3) {
        EXPECT_TRUE(map.rgb[i] == 0 || map.rgb[i] == 255) << i / 3;
        white += map.rgb[i] == 255;
    }
    EXPECT_GT(white, 16u);
    EXPECT_LT(white, 24u * 16 / 2);
    EXPECT_EQ(told["pixels"], white);
    EXPECT_GT(told["excess"], 0.2);
    EXPECT_LT(told["excess"], 1.0);
    ASSERT_EQ(told["worst"].size(), 16u);
    double before = 1e30;
    for (const auto& worst : told["worst"]) {
        const size_t pixel = worst["y"].get<size_t>() * 24 + worst["x"].get<size_t>();
        EXPECT_EQ(map.rgb.at(3 * pixel), 255) << worst;
        const double excess = worst["luminance"].get<double>() - worst["around"].get<double>();
        EXPECT_LE(excess, before) << worst;
        before = excess;
        EXPECT_GE(worst["luminance"], 2 * worst["around"].get<double>()) << worst;
        EXPECT_GE(worst["share"], 0.25) << worst;
        EXPECT_LE(worst["share"], 1.0) << worst;
    }
}

TEST_F(Maps, changeNoByteOfThePicture)
{
    ASSERT_EQ(render({"-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--map", "normals=n.png", "--map", "depth=d.png",
                      "--histogram", "h.png"})
                  .exitCode,
              0);
    EXPECT_EQ(textOf(folder / "a.exr"), textOf(folder / "b.exr")) << "no layers without --aovs";
    EXPECT_GT(readPng(folder / "h.png").height, 400u);
}

TEST_F(Maps, badRequests_areRefusedBeforeRendering)
{
    expectUsageError({"--map", "nodes"}, "--map 'nodes' names no file; give QUANTITY=FILE.png");
    expectUsageError({"--map", "normal=n.png"},
                     "--map 'normal' is not known; did you mean normals?");
    expectUsageError({"--map", "nodes=n.exr"}, "--map 'n.exr': the name must end in .png");
    expectUsageError({"--map", "nodes="}, "--map '': the name must end in .png");
    expectUsageError({"-o", "a.png", "--map", "nodes=./a.png"},
                     "./a.png: is written already; name another file for --map");
    expectUsageError({"--map", "nodes=a.png", "--map", "depth=a.png"},
                     "a.png: is written already; name another file for --map");
    expectUsageError({"--histogram", "ball.png"},
                     "ball.png: is written already; name another file for --histogram");
    expectUsageError({"--map-range", "5"}, "--map-range '5' is no range; give LO:HI");
    expectUsageError({"--map-range", "5:5"},
                     "--map-range 5:5 is empty; give LO:HI with LO below HI");
    expectUsageError({"--map-range", "0:nan"},
                     "--map-range 'nan' is not a number; give one from -1e+30 to 1e+30");
    expectUsageError({"--map-range", "0:9", "--map-log"},
                     "--map-range 0:9: with --map-log both ends must be above 0");
    expectUsageError({"--map-colors", "grye"},
                     "--map-colors 'grye' is not known; did you mean grey?");
    expectRefused(render({"--map", "nodes=missing/n.png"}), 4, "missing/n.png: cannot write");
}

TEST_F(Maps, doNotReplaceWhatIsRead)
{
    ASSERT_EQ(render({"-o", "sky.exr"}).exitCode, 0);
    fs::create_symlink("sky.exr", folder / "map.png");
    std::string before = textOf(folder / "sky.exr");
    for (const Arguments& output :
         {Arguments{"--map", "nodes=map.png"}, {"--histogram", "map.png"}}) {
        Arguments arguments = {"--probe", "sky.exr", "-o", "a.exr"};
        arguments.insert(arguments.end(), output.begin(), output.end());
        expectRefused(render(arguments), 2, "map.png: is an input; writing it would destroy it");
        EXPECT_EQ(textOf(folder / "sky.exr"), before);
    }
}

}  // namespace
}  // namespace sahl::testing
