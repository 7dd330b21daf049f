// sahl bench: the report's benchmark on meshes that are here, and what it says of those that are
// not.
#include "cli/sahl_program.h"

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

TEST_F(Bench, namesOfBenchmarks_areChecked)
{
    expectRefused(sahl({"bench"}), 2,
                  "sahl: name a benchmark; there is one benchmark: sahl bench report");
    expectRefused(sahl({"bench", "fast"}), 2, "'fast' is not known; there is one benchmark");
}

}  // namespace
}  // namespace sahl::testing
