// sahl bench: the report's benchmark on meshes that are here, and what it says of those that are
// not; the others on tiny scenes.
#include "cli/sahl_program.h"
#include "support/source_folder.h"

#include <algorithm>

namespace sahl::testing {
namespace {

class Bench : public SceneFolderTest {
protected:
    /// `sahl bench report` on tiny pictures, in a folder that has no meshes but those below it.
    RunResult bench(const Arguments& more) const
    {
        RunOptions options = here();
        options.environment["SAHL_ASSETS"] = "";
        Arguments all = {"bench", "report",   "--size", "16", "--repeat",
                         "1",     "--device", "cpu",    "-q"};
        all.insert(all.end(), more.begin(), more.end());
        return sahl(all, options);
    }

    nlohmann::json table() const { return nlohmann::json::parse(textOf(folder / "bench.json")); }
};

TEST_F(Bench, withoutAnyMesh_measuresTheBuiltInTeapotAndNamesWhatIsMissing)
{
    RunResult result = bench({"--json", "bench.json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_HAS(result.out, "teapot ");
    EXPECT_HAS(result.out, "another mesh than the report's: built-in");
    EXPECT_HAS(result.out,
               "bunny      not measured: no meshes/bunny.obj here; see tools/fetch_assets");
    const nlohmann::json json = table();
    ASSERT_EQ(json["rows"].size(), 1u);
    const nlohmann::json& row = json["rows"][0];
    EXPECT_EQ(row["primitives"], 64 * 9 - 8 * 3 + 1);
    EXPECT_EQ(row["rays"], 16 * 16);
    EXPECT_DOUBLE_EQ(row["nodeVisitsPerRay"], row["nodeVisits"].get<double>() / 256);
    EXPECT_FALSE(row.contains("report"));
    EXPECT_GE(json["missing"].size(), 2u);
}

TEST_F(Bench, aMeshOfTheReportsSize_getsTheReportsLineAndRatios)
{
    // 576 triangles, as many as the benchmark's teapot has.
    std::string obj;
    for (int i = 0; i < 576; i++) {
        obj += "v " + std::to_string(i * 0.01) + " 0 0\nv " + std::to_string(i * 0.01) +
               " 1 0\nv " + std::to_string(i * 0.01 + 0.01) + " 0 0\nf -3 -1 -2\n";
    }
    fs::create_directories(folder / "assets/meshes");
    writeText(folder / "assets/meshes/teapot.obj", obj);
    RunResult result = bench({"--assets", "assets", "--json", "bench.json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_HAS(result.out, "  report         695       577     5845260     1600870");
    const nlohmann::json row = table()["rows"][0];
    EXPECT_EQ(row["primitives"], 577);
    EXPECT_EQ(row["mesh"], "assets/meshes/teapot.obj");
    EXPECT_EQ(row["report"]["nodeVisits"], 5845260);
    EXPECT_EQ(row["ratios"]["primitives"], 1);
    EXPECT_DOUBLE_EQ(row["ratios"]["nodeVisits"], row["nodeVisits"].get<double>() / 5845260);
    EXPECT_FALSE(row["ratios"].contains("buildSeconds")) << "the report says 0";
}

/// `sahl bench NAME` of tiny generated scenes on the CPU, once each.
class BenchOf : public SceneFolderTest {
protected:
    nlohmann::json measured(const std::string& name, const Arguments& more = {}) const
    {
        Arguments all = {"bench",    name, "--size", "16",  "--triangles", "500",  "--repeat", "2",
                         "--device", "cpu", "-q",    "--json", "bench.json"};
        all.insert(all.end(), more.begin(), more.end());
        const RunResult result = sahl(all, here());
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const nlohmann::json json = nlohmann::json::parse(textOf(folder / "bench.json"));
        EXPECT_EQ(json["benchmark"], name);
        return json;
    }
};

TEST_F(BenchOf, traversal_tracesTheSameRaysByAll)
{
    const nlohmann::json json = measured("traversal");
    ASSERT_EQ(json["rows"].size(), 6u) << "three kinds of two scenes";
    EXPECT_EQ(json["rows"][0]["rays"], 16 * 16);
    for (const nlohmann::json& row : json["rows"]) {
        EXPECT_GT(row["boxTestsPerRay"], 1);
        EXPECT_GT(row["hits"], 0);
        for (const nlohmann::json& tracer : row["tracers"]) {
            EXPECT_EQ(tracer["seconds"].size(), 2u);
            EXPECT_NEAR(tracer["hits"].get<double>(), row["hits"].get<double>(), 2) << row["kind"];
        }
    }
}

TEST_F(BenchOf, render_makesPicturesOfTheSameBrightness)
{
    const nlohmann::json json = measured("render", {"--spp", "32"});
    const nlohmann::json& rows = json["rows"];
    ASSERT_GE(rows.size(), 2u);
    for (size_t i = 1; i < rows.size(); i++) {
        if (rows[i]["scene"] != rows[i - 1]["scene"]) continue;
        EXPECT_NEAR(rows[i]["mean"].get<double>(), rows[i - 1]["mean"].get<double>(), 0.02);
        EXPECT_NEAR(rows[i]["raysPerSample"].get<double>(), rows[i - 1]["raysPerSample"].get<double>(), 0.2);
    }
}

TEST_F(BenchOf, alone_measuresTheDeviceWithNothingBesideIt)
{
    EXPECT_EQ(measured("render", {"--spp", "1", "--alone"})["rows"].size(), 2u);
    EXPECT_EQ(measured("traversal", {"--alone"})["rows"][0]["tracers"].size(), 1u);
}

TEST_F(BenchOf, build_countsTheTestsOfEveryTree)
{
    const nlohmann::json json = measured("build", {"ball.json"});
    ASSERT_GE(json["rows"].size(), 2u);
    for (const nlohmann::json& row : json["rows"]) {
        EXPECT_EQ(row["scene"], "ball");
        EXPECT_EQ(row["triangles"], 320);
        if (!row.contains("depth")) continue;  // Embree's own
        EXPECT_GT(row["primitiveTestsPerRay"], 0);
    }
}

TEST_F(BenchOf, start_runsTheProgramItself)
{
    const nlohmann::json row = measured("start")["rows"].at(0);
    std::vector<double> starts = row["coldSeconds"].get<std::vector<double>>();
    const std::vector<double> warm = row["warmSeconds"].get<std::vector<double>>();
    EXPECT_EQ(starts.size(), 2u);
    EXPECT_EQ(warm.size(), 2u);
    starts.insert(starts.end(), warm.begin(), warm.end());
    // A run takes longer than its reading and building; the median of these is reached in one of the runs at least
    EXPECT_GT(*std::max_element(starts.begin(), starts.end()), row["loadSeconds"]);
    EXPECT_GT(row["loadSeconds"], 0);
}

TEST_F(BenchOf, scale_drawsAPlot)
{
    const nlohmann::json json = measured("scale", {"--plot", "scale.png"});
    EXPECT_EQ(json["byTriangles"].size(), 1u);
    EXPECT_EQ(json["bySamples"].size(), 6u);
    EXPECT_EQ(json["byBounces"].back()["bounces"], 32);
    EXPECT_EQ(json["growth"]["from"], json["growth"]["to"]) << "there is one row";
    EXPECT_EQ(json["growth"]["sahl"], 1);
    EXPECT_TRUE(textOf(folder / "scale.png").starts_with("\x89PNG"));
}

TEST_F(BenchOf, scenesWithInstances_areRefused)
{
    const fs::path instances = sourceFolder() / "tests/scenes/instances.json";
    expectRefused(sahl({"bench", "build", instances.string(), "--device", "cpu"}), 3, "has instances");
}

TEST_F(Bench, namesOfBenchmarks_areChecked)
{
    expectRefused(sahl({"bench"}), 2,
                  "sahl: name a benchmark: report, traversal, render, build, start, scale or ceiling");
    expectRefused(sahl({"bench", "fast"}), 2, "benchmark 'fast' is not known: report");
    expectRefused(sahl({"bench", "report", "ball.json"}), 2, "measures no scenes but its own, not 'ball.json'");
    expectRefused(sahl({"bench", "ceiling", "--device", "cpu"}), 5, "sahl bench ceiling measures Vulkan devices");
    expectRefused(sahl({"bench", "build", "--plot", "x.png"}), 2, "a plot of sahl bench scale alone");
}

}  // namespace
}  // namespace sahl::testing
