// --shard, --sample-range and --keep-film: which samples are rendered, and what is refused.
#include "cli/sahl_program.h"
#include "image/exr_layers.h"

namespace sahl::testing {
namespace {

using Variables = std::map<std::string, std::optional<std::string>>;

class Shards : public SceneFolderTest {
protected:
    /// A run in which the scheduler has set these variables, and no other scheduler has.
    RunResult renderUnder(const Variables& variables, const Arguments& more) const
    {
        RunOptions options = here();
        for (const char* name :
             {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
              "SLURM_ARRAY_TASK_STEP", "AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE",
              "JOB_COMPLETION_INDEX", "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK",
              "PMI_SIZE"}) {
            options.environment[name] = {};
        }
        for (const auto& [name, value] : variables) options.environment[name] = value;
        return render(more, options);
    }

    std::string attribute(const std::string& file, const std::string& name) const
    {
        return describeExr(folder / file).metadata[name];
    }
};

TEST_F(Shards, borders_areThoseOfBlocksAndTheLastHasTheRest)
{
    const char* ranges[] = {"0:8", "8:24", "24:37"};  // blocks 0, 1-2, 3-4 of 5
    for (int i = 0; i < 3; i++) {
        const RunResult result =
            render({"--spp", "37", "--shard", std::to_string(i) + "/3", "-o", "a.exr"});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_HAS(result.err, "shard " + std::to_string(i) + "/3: samples " + ranges[i] + "\n");
        EXPECT_EQ(attribute("a.exr", "sahl.sampleRanges"), ranges[i]);
        EXPECT_EQ(attribute("a.exr", "sahl.totalSamples"), "37");
        EXPECT_EQ(attribute("a.exr", "sahl.shard"), std::to_string(i) + "/3");
    }
    EXPECT_EQ(attribute("a.exr", "sahl.firstSample"), "24");
    EXPECT_EQ(attribute("a.exr", "sahl.sampleCount"), "13");
    EXPECT_EQ(attribute("a.exr", "sahl.passes"), "2");
}

TEST_F(Shards, parts_areNamedAfterThemselves)
{
    EXPECT_EQ(render({"--spp", "32", "--shard", "2/4"}).out, "ball-shard-2-of-4.exr\n");
    EXPECT_EQ(render({"--spp", "32", "--sample-range", "8:24"}).out, "ball-samples-8-24.exr\n");
    EXPECT_EQ(files(),
              (std::vector<std::string>{"ball-samples-8-24.exr", "ball-shard-2-of-4.exr"}));
    EXPECT_EQ(attribute("ball-samples-8-24.exr", "sahl.sampleRanges"), "8:24");
}

TEST_F(Shards, ordinaryPictures_haveNoFilm)
{
    ASSERT_EQ(render({"-o", "a.exr"}).exitCode, 0);
    const ExrDescription plain = describeExr(folder / "a.exr");
    EXPECT_FALSE(plain.channels.contains("film.digest"));
    EXPECT_FALSE(plain.metadata.contains("sahl.film"));
    ASSERT_EQ(render({"-o", "a.exr", "--keep-film"}).exitCode, 0);
    const ExrDescription kept = describeExr(folder / "a.exr");
    EXPECT_EQ(kept.channels.size(), plain.channels.size() + 37);
    EXPECT_EQ(kept.metadata.at("sahl.sampleRanges"), "0:4");
}

TEST_F(Shards, impossibleParts_areUsageErrors)
{
    expectRefused(render({"--shard", "5/4"}), 2,
                  "--shard 5 is out of range; give a number from 0 to 3");
    expectRefused(render({"--shard", "4/4"}), 2,
                  "--shard 4 is out of range; give a number from 0 to 3");
    expectRefused(render({"--shard", "0/0"}), 2, "--shard 0 is out of range; give a number from 1");
    expectRefused(render({"--shard", "-1/4"}), 2, "--shard -1 is out of range");
    expectRefused(render({"--shard", "3"}), 2, "--shard '3' is no part; give i/n");
    expectRefused(render({"--shard", "a/b"}), 2, "--shard 'b' is not a whole number");
    expectRefused(render({"--shard", "/"}), 2, "--shard '' is not a whole number");
    expectRefused(render({"--spp", "20", "--shard", "0/4"}), 2,
                  "--shard 0/4: 20 samples are 3 blocks of 8, so there are at most 3 shards");
    expectRefused(render({"--spp", "5", "--shard", "0/2"}), 2, "5 samples are 1 block of 8");
    expectRefused(render({"--shard", "0/1", "--sample-range", "0:8"}), 2, "give one");
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(Shards, impossibleRanges_areUsageErrors)
{
    const Arguments spp = {"--spp", "20"};
    auto range = [&](const char* text) { return render({"--spp", "20", "--sample-range", text}); };
    expectRefused(
        range("3:16"), 2,
        "--sample-range 3:16: 3 is inside a block of 8 samples, which cannot be torn apart; take "
        "0 or 8");
    expectRefused(range("8:19"), 2,
                  "19 is inside a block of 8 samples, which cannot be torn apart; take 16 or 20");
    expectRefused(range("16:24"), 2,
                  "--sample-range 16:24: the picture has 20 samples a pixel; give --spp 24");
    expectRefused(range("8:8"), 2, "--sample-range 8:8 is empty; give A:B with A below B");
    expectRefused(range("16:8"), 2, "is empty");
    expectRefused(range("8"), 2, "--sample-range '8' is no range; give A:B");
    expectRefused(range("0:x"), 2, "--sample-range 'x' is not a whole number");
    expectRefused(range("0:99999999999"), 2, "--sample-range 99999999999 is out of range");
    EXPECT_EQ(range("16:20").exitCode, 0);
    EXPECT_EQ(range("0:20").exitCode, 0);
}

TEST_F(Shards, outputs_canHoldTheFilm)
{
    expectRefused(render({"--shard", "0/1", "-o", "a.png", "-o", "a.pfm"}), 2,
                  "--shard needs an output that ends in .exr: other formats cannot hold the film");
    expectRefused(render({"--sample-range", "0:4", "-o", "a.png"}), 2,
                  "--sample-range needs an output");
    expectRefused(render({"--keep-film", "-o", "a.png"}), 2, "--keep-film needs an output");
    EXPECT_EQ(render({"--shard", "0/1", "-o", "a.png", "-o", "a.EXR"}).exitCode, 0);
}

TEST_F(Shards, rescuedParts_haveTheFilmToo)
{
    fs::create_directory(folder / "elsewhere");
    fs::create_symlink("/dev/full", folder / "a.exr");
    RunOptions options = here();
    options.environment["TMPDIR"] = folder / "elsewhere";
    const RunResult result =
        render({"--spp", "16", "--shard", "0/2", "-o", "a.exr", "-o", "a.pfm"}, options);
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_HAS(result.err, "; the picture was saved as ") << "a.pfm does not hold the film";
    const fs::path rescued = fs::directory_iterator(folder / "elsewhere")->path();
    ASSERT_EQ(render({"--spp", "16", "--shard", "1/2", "-o", "b.exr"}).exitCode, 0);
    EXPECT_EQ(sahl({"merge", rescued.string(), "b.exr", "-o", "c.exr"}, here()).exitCode, 0);
}

TEST_F(Shards, auto_takesPartsFromTheSchedulersVariables)
{
    const std::pair<Variables, const char*> arrays[] = {
        {{{"SLURM_ARRAY_TASK_ID", "1"},
          {"SLURM_ARRAY_TASK_COUNT", "4"},
          {"SLURM_ARRAY_TASK_MIN", "0"}},
         "shard 1/4 (by SLURM_ARRAY_TASK_ID): samples 8:16"},
        {{{"SLURM_ARRAY_TASK_ID", "1"}, {"SLURM_ARRAY_TASK_COUNT", "4"}}, "shard 1/4 "},
        {{{"SLURM_ARRAY_TASK_ID", "4"},
          {"SLURM_ARRAY_TASK_COUNT", "4"},
          {"SLURM_ARRAY_TASK_MIN", "1"}},
         "shard 3/4 "},
        {{{"SLURM_ARRAY_TASK_ID", "9"},
          {"SLURM_ARRAY_TASK_COUNT", "3"},
          {"SLURM_ARRAY_TASK_MIN", "1"},
          {"SLURM_ARRAY_TASK_STEP", "4"}},
         "shard 2/3 "},
        {{{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "2"}},
         "shard 0/2 (by AWS_BATCH_JOB_ARRAY_INDEX): samples 0:16"},
        {{{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}},
         "shard 1/2 (by OMPI_COMM_WORLD_RANK)"},
        {{{"PMI_RANK", "0"}, {"PMI_SIZE", "2"}}, "shard 0/2 (by PMI_RANK)"},
        {{{"SLURM_ARRAY_TASK_ID", "1"},
          {"SLURM_ARRAY_TASK_COUNT", "2"},
          {"PMI_RANK", "0"},
          {"PMI_SIZE", "1"}},
         "shard 1/2 (by SLURM_ARRAY_TASK_ID)"},
    };
    for (const auto& [variables, words] : arrays) {
        const RunResult result =
            renderUnder(variables, {"--spp", "32", "--shard", "auto", "-o", "a.exr"});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_HAS(result.err, words);
    }
}

TEST_F(Shards, autoOfN_takesTheIndexAsItIs)
{
    const Variables again = {{"SLURM_ARRAY_TASK_ID", "2"},
                             {"SLURM_ARRAY_TASK_COUNT", "1"},
                             {"SLURM_ARRAY_TASK_MIN", "2"}};
    EXPECT_HAS(renderUnder(again, {"--spp", "32", "--shard", "auto/4", "-o", "a.exr"}).err,
               "shard 2/4 (by SLURM");
    const Variables kubernetes = {{"JOB_COMPLETION_INDEX", "3"}};
    EXPECT_HAS(renderUnder(kubernetes, {"--spp", "32", "--shard", "auto/4", "-o", "a.exr"}).err,
               "shard 3/4 (by JOB_COMPLETION_INDEX): samples 24:32");
    expectRefused(renderUnder(kubernetes, {"--shard", "auto"}), 2,
                  "--shard auto: JOB_COMPLETION_INDEX is 3, but nothing tells the number of "
                  "shards; give it as "
                  "--shard auto/n");
    expectRefused(renderUnder(kubernetes, {"--shard", "auto/3"}), 2,
                  "--shard auto: JOB_COMPLETION_INDEX is 3, which is no place among 3 shards");
}

TEST_F(Shards, autoWithoutSense_isAUsageError)
{
    expectRefused(
        renderUnder({}, {"--shard", "auto"}), 2,
        "--shard auto: none of SLURM_ARRAY_TASK_ID, AWS_BATCH_JOB_ARRAY_INDEX, "
        "JOB_COMPLETION_INDEX, OMPI_COMM_WORLD_RANK or PMI_RANK is set; give --shard i/n");
    const Variables gaps = {{"SLURM_ARRAY_TASK_ID", "7"},
                            {"SLURM_ARRAY_TASK_COUNT", "3"},
                            {"SLURM_ARRAY_TASK_MIN", "1"}};
    expectRefused(
        renderUnder(gaps, {"--shard", "auto"}), 2,
        "SLURM_ARRAY_TASK_ID is 7, which is no place among 3 shards; number the tasks from 0 on");
    const Variables between = {{"SLURM_ARRAY_TASK_ID", "2"},
                               {"SLURM_ARRAY_TASK_COUNT", "3"},
                               {"SLURM_ARRAY_TASK_MIN", "1"},
                               {"SLURM_ARRAY_TASK_STEP", "2"}};
    expectRefused(renderUnder(between, {"--shard", "auto"}), 2, "is no place among 3 shards");
    for (const char* text : {"x", "-1", "1e3", "99999999999999999999"}) {
        expectRefused(renderUnder({{"PMI_RANK", text}, {"PMI_SIZE", "4"}}, {"--shard", "auto"}), 2,
                      "PMI_RANK ");
    }
    expectRefused(renderUnder({{"PMI_RANK", "0"}, {"PMI_SIZE", "0"}}, {"--shard", "auto"}), 2,
                  "PMI_SIZE 0 is out of range");
    expectRefused(renderUnder({{"PMI_RANK", ""}, {"PMI_SIZE", "4"}}, {"--shard", "auto"}), 2,
                  "none of ");
}

/// A program that stands for Slurm's: runs every task of the array at once, and the job that waits
/// for them.
const char* const SBATCH = R"(#!/usr/bin/env bash
set -euo pipefail
last=
while [[ $# -gt 0 ]]; do
    case $1 in
    --array=0-*) last=${1#--array=0-} ;;
    --wrap) shift; command=$1 ;;
    --dependency=afterok:4711) ;;
    --parsable | --time=1) ;;
    *) echo "sbatch: unknown $1" >&2; exit 1 ;;
    esac
    shift
done
if [[ -z $last ]]; then sh -c "$command" >&2; exit; fi
for ((i = last; i >= 0; i--)); do
    SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_COUNT=$((last + 1)) SLURM_ARRAY_TASK_MIN=0 sh -c "$command" >&2
done
echo "4711;cluster"
)";

TEST_F(Shards, slurmScript_rendersAnArrayAndMergesIt)
{
    fs::create_directory(folder / "bin");
    writeText(folder / "bin/sbatch", SBATCH);
    fs::permissions(folder / "bin/sbatch", fs::perms::owner_all);
    fs::copy(folder / "ball.json", folder / "my ball.json");
    RunOptions options = here();
    options.environment["PATH"] = (folder / "bin").string() + ":" + std::getenv("PATH");
    options.environment["SAHL"] = SAHL_PROGRAM;
    options.environment["SBATCH_OPTIONS"] = "--time=1";
    const RunResult result =
        runProgram(SAHL_SOURCE_FOLDER "/tools/slurm_render",
                   {"my ball.json", "3", "out put.exr", "--spp", "44", "--device", "cpu"}, options);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    ASSERT_EQ(
        sahl({"render", "my ball.json", "--spp", "44", "--device", "cpu", "-o", "one.exr"}, here())
            .exitCode,
        0);
    EXPECT_TRUE(textOf(folder / "out put.exr") == textOf(folder / "one.exr"));
    EXPECT_TRUE(fs::exists(folder / "out put.parts/2.exr"));
    EXPECT_EQ(runProgram(SAHL_SOURCE_FOLDER "/tools/slurm_render", {"my ball.json", "0", "a.exr"},
                         options)
                  .exitCode,
              2);
}

}  // namespace
}  // namespace sahl::testing
