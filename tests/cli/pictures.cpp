// What `sahl render` leaves: pictures, what they say of themselves, statistics.
#include "cli/sahl_program.h"
#include "image/image.h"
#include "support/source_folder.h"

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <cmath>
#include <numeric>
#include <set>

namespace sahl::testing {
namespace {

using Names = std::vector<std::string>;

const fs::path DEFAULT_SCENE = sourceFolder() / "scenes/default/default.json";

std::string exrText(const fs::path& path, const std::string& name)
{
    Imf::InputFile file(path.c_str());
    auto* attribute = file.header().findTypedAttribute<Imf::StringAttribute>(name.c_str());
    return attribute ? attribute->value() : "(none)";
}

class Pictures : public SceneFolderTest {};

TEST_F(Pictures, defaultScene_givesReadablePicturesInEveryFormat)
{
    RunResult result =
        sahl({"render", DEFAULT_SCENE, "--device", "cpu", "--width", "48", "--height", "27",
              "--spp", "2", "-o", "a.exr", "-o", "a.png", "-o", "a.pfm"},
             here());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "a.exr\na.png\na.pfm\n");
    Image exr = readImage(folder / "a.exr");
    Image pfm = readImage(folder / "a.pfm");
    EXPECT_EQ(exr.width, 48u);
    EXPECT_EQ(exr.height, 27u);
    EXPECT_EQ(exr.rgb, pfm.rgb);
    float sum = std::accumulate(exr.rgb.begin(), exr.rgb.end(), 0.0f);
    EXPECT_TRUE(std::isfinite(sum) && sum > 0);
    std::string png = textOf(folder / "a.png");
    EXPECT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n"));
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x30\0\0\0\x1b", 8)) << "width and height";
}

TEST_F(Pictures, withoutOutputs_areNamedAfterTheScene)
{
    RunResult result = render();
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "ball.exr\nball.png\n");
    EXPECT_EQ(files(), (Names{"ball.exr", "ball.png"}));
}

TEST_F(Pictures, sayHowTheyWereMade)
{
    ASSERT_EQ(render({"--spp", "12", "--seed", "7", "--max-bounces", "3"}).exitCode, 0);
    const std::pair<const char*, const char*> expected[] = {
        {"sahl.scene", "ball.json"}, {"sahl.seed", "7"},
        {"sahl.maxBounces", "3"},    {"sahl.sampleCount", "12"},
        {"sahl.passes", "2"},        {"sahl.interrupted", "no"},
        {"sahl.integrator", "path"}, {"sahl.sampler", "independent"}};
    std::string png = textOf(folder / "ball.png");
    for (const auto& [name, value] : expected) {
        EXPECT_EQ(exrText(folder / "ball.exr", name), value) << name;
        std::string chunk = "iTXt" + std::string(name) + std::string(5, '\0') + value;
        EXPECT_TRUE(has(png, chunk)) << name;
    }
    EXPECT_HAS("sahl " + exrText(folder / "ball.exr", "sahl.version") + "\n",
               sahl({"--version"}).out);
    EXPECT_HAS(exrText(folder / "ball.exr", "sahl.device"), "CPU");
}

TEST_F(Pictures, doNotDependOnThreadsTilesOrTrees)
{
    ASSERT_EQ(render({"-o", "a.pfm"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "b.pfm", "--threads", "3", "--tile", "5"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "c.pfm", "--threads", "1", "--bvh-build", "binned"}).exitCode, 0);
    EXPECT_EQ(textOf(folder / "a.pfm"), textOf(folder / "b.pfm"));
    EXPECT_EQ(textOf(folder / "a.pfm"), textOf(folder / "c.pfm"));
    ASSERT_EQ(render({"-o", "d.pfm", "--seed", "1"}).exitCode, 0);
    EXPECT_NE(textOf(folder / "a.pfm"), textOf(folder / "d.pfm"));
    ASSERT_EQ(render({"-o", "e.pfm", "--bvh-quality", "high", "--stats", "e.json"}).exitCode, 0);
    EXPECT_EQ(textOf(folder / "a.pfm"), textOf(folder / "e.pfm"));
    EXPECT_EQ(nlohmann::json::parse(textOf(folder / "e.json"))["tree"]["build"], "high");
}

TEST_F(Pictures, qualityOfTrees_isChosenByOneOption)
{
    expectRefused(render({"--bvh-quality", "best"}), 2, "--bvh-quality");
    expectRefused(render({"--bvh-quality", "high", "--bvh-build", "sweep"}), 2, "--bvh-quality");
}

TEST_F(Pictures, sameCommand_givesTheSameFile)
{
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png"}).exitCode, 0);
    std::string exr = textOf(folder / "a.exr");
    std::string png = textOf(folder / "a.png");
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png"}).exitCode, 0);
    EXPECT_EQ(textOf(folder / "a.exr"), exr);
    EXPECT_EQ(textOf(folder / "a.png"), png);
}

TEST_F(Pictures, meshWithAProbe_isAScene)
{
    ASSERT_EQ(render({"-o", "sky.exr"}).exitCode, 0);
    writeText(folder / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    RunResult result =
        sahl({"render", "mesh.obj", "--probe", "sky.exr", "--probe-mapping", "latlong", "--width",
              "8", "--height", "8", "--spp", "1", "--device", "cpu"},
             here());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "mesh.exr\nmesh.png\n");
    Image sky = readImage(folder / "sky.exr");
    Image picture = readImage(folder / "mesh.exr");
    EXPECT_NE(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 0);
}

TEST_F(Pictures, warnings_goToStderrAlone)
{
    writeText(folder / "mesh.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    Arguments arguments = {"render", "mesh.obj", "--width", "8",        "--height",
                           "8",      "--spp",    "1",       "--device", "cpu"};
    RunResult result = sahl(arguments, here());
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out, "mesh.exr\nmesh.png\n");
    EXPECT_HAS(result.err, "sahl: warning: ");
    EXPECT_HAS(result.err, "gone.mtl");
    arguments.push_back("--quiet");
    EXPECT_EQ(sahl(arguments, here()).err, "");
}

TEST_F(Pictures, quiet_saysNothing)
{
    for (const char* option : {"-q", "--quiet"}) {
        RunResult result = render({option, "--progress", "bar"});
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(result.err, "");
    }
    RunResult failed = sahl({"render", "missing.json", "-q"}, here());
    EXPECT_EQ(failed.exitCode, 3);
    EXPECT_HAS(failed.err, "missing.json: cannot read");
}

TEST_F(Pictures, verbose_tellsOfTreeAndDevice)
{
    RunResult result = render({"-v"});
    EXPECT_EQ(result.out, "ball.exr\nball.png\n");
    EXPECT_HAS(result.err, "tree: ");
    EXPECT_HAS(result.err, "device work: ");
}

/// "scene.width" and the like for every value that is no object.
void collectKeys(const nlohmann::json& json, const std::string& prefix, std::set<std::string>& keys)
{
    for (const auto& [key, value] : json.items()) {
        if (value.is_object()) {
            collectKeys(value, prefix + key + ".", keys);
        } else {
            keys.insert(prefix + key);
        }
    }
}

/// The keys that docs/stats.md explains: lines "| `key` | ...", without those of what lists hold.
std::set<std::string> documentedKeys()
{
    std::set<std::string> keys;
    std::ifstream file(sourceFolder() / "docs/stats.md");
    for (std::string line; std::getline(file, line);) {
        if (line == "## Of the tree alone") break;  // what sahl bvh adds
        if (!line.starts_with("| `")) continue;
        const std::string key = line.substr(3, line.find('`', 3) - 3);
        if (key.find("[]") == std::string::npos) keys.insert(key);
    }
    return keys;
}

TEST_F(Pictures, statistics_haveTheDocumentedKeysAndNoOthers)
{
    ASSERT_EQ(render({"--stats", "stats.json", "--adaptive", "report", "--max-spp", "20"}).exitCode,
              0);
    auto statistics = nlohmann::json::parse(textOf(folder / "stats.json"));
    std::set<std::string> keys;
    collectKeys(statistics, "", keys);
    EXPECT_EQ(keys, documentedKeys());
}

TEST_F(Pictures, statistics_addUp)
{
    ASSERT_EQ(render({"--stats", "stats.json"}).exitCode, 0);
    auto statistics = nlohmann::json::parse(textOf(folder / "stats.json"));
    const auto& counters = statistics["counters"];
    EXPECT_EQ(statistics["version"], 1);
    EXPECT_EQ(statistics["scene"]["width"], 16);
    EXPECT_EQ(statistics["scene"]["primitives"], 20 * 4 * 4);
    EXPECT_EQ(statistics["tree"]["leaves"], statistics["tree"]["innerNodes"].get<int>() + 1);
    EXPECT_EQ(counters["cameraRays"], 16 * 12 * 4);
    EXPECT_GT(counters["indirectRays"], 0);
    EXPECT_GT(counters["boxTests"], 0);
    EXPECT_EQ(counters["badSamples"], 0);
    const auto& pixels = statistics["pixels"];
    EXPECT_DOUBLE_EQ(pixels["nodeVisitsMean"].get<double>() * 16 * 12 * 2, counters["boxTests"]);
    EXPECT_DOUBLE_EQ(pixels["primitiveTestsMean"].get<double>() * 16 * 12,
                     counters["primitiveTests"]);
    EXPECT_GT(pixels["nodeVisitsMax"].get<double>(), pixels["nodeVisitsMean"].get<double>());
    EXPECT_EQ(statistics["filmBytes"], 16 * 12 * (2 * 72 + 4 + 8));
    const auto& seconds = statistics["seconds"];
    double stages = 0;
    for (const char* stage : {"load", "build", "upload", "firstHits", "render", "write"}) {
        stages += seconds[stage].get<double>();
    }
    EXPECT_NEAR(seconds["total"].get<double>(), stages, 0.05 + 0.05 * stages);
}

}  // namespace
}  // namespace sahl::testing
