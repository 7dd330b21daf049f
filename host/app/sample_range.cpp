#include "app/sample_range.h"

#include "app/adaptive.h"
#include "app/option_kinds.h"
#include "app/outputs.h"
#include "film/replicates.h"
#include "scene/adaptive.h"
#include "util/error.h"

#include <algorithm>

namespace sahl {

namespace {

SampleRange parseRange(const std::string& text)
{
    const size_t colon = text.find(':');
    if (colon == std::string::npos) {
        throw CLI::ValidationError(fmt::format(
            "--sample-range '{}' is no range; give A:B for the samples A, A+1, ..., B-1", text));
    }
    const SampleRange range = {
        parseNumber("--sample-range", text.substr(0, colon), {0, MAX_SAMPLES - 1}),
        parseNumber("--sample-range", text.substr(colon + 1), {1, MAX_SAMPLES})};
    if (range.first >= range.end) {
        throw CLI::ValidationError(
            fmt::format("--sample-range {} is empty; give A:B with A below B", text));
    }
    return range;
}

ArrayTask parseShard(const std::string& text)
{
    if (text == "auto") return arrayTask({});
    const size_t slash = text.find('/');
    if (slash == std::string::npos) {
        throw CLI::ValidationError(fmt::format(
            "--shard '{}' is no part; give i/n with i from 0 to n-1, auto or auto/n", text));
    }
    const std::string index = text.substr(0, slash);
    const uint32_t count = parseNumber("--shard", text.substr(slash + 1), {1, MAX_SAMPLES});
    if (index == "auto") return arrayTask(count);
    return {parseNumber("--shard", index, {0, count - 1}), count, ""};
}

/// Sums are exact across blocks of samples, so a part begins and ends where blocks do.
void requireBlockBorder(uint32_t sample, const SampleRange& range, uint32_t blockSize, uint32_t total)
{
    if (sample % blockSize == 0 || sample == total) return;
    const uint32_t below = sample / blockSize * blockSize;
    throw usageError(
        "--sample-range {}: {} is inside a block of {} samples, which cannot be torn apart; "
        "take {} or {}",
        rangeText(range), sample, blockSize, below, std::min(below + blockSize, total));
}

}  // namespace

void addRangeOptions(CLI::App& command, RangeOptions& options)
{
    auto setShard = [&options](const std::string& text) { options.shard = parseShard(text); };
    command
        .add_option_function<std::string>(
            "--shard", setShard,
            withDefault("render part i of n (i from 0 on) of the samples; sahl merge\n"
                        "puts the parts together. auto: by the variables of Slurm,\n"
                        "AWS Batch, Kubernetes or MPI; auto/n: of n parts",
                        "all"))
        ->type_name("I/N")
        ->group("Parts");
    auto setRange = [&options](const std::string& text) { options.range = parseRange(text); };
    command
        .add_option_function<std::string>(
            "--sample-range", setRange,
            withDefault("render samples A to B-1 of every pixel; both multiples\n"
                        "of 8 (by sobol64 of 64), or B the last",
                        "all"))
        ->type_name("A:B")
        ->group("Parts");
    addFlag(command, "--keep-film", options.keepFilm,
            "the exact film as channels of every .exr, for sahl merge;\nparts have it always "
            "(docs/merge.md)")
        ->group("Parts");
    addFlag(command, "--skip-existing", options.skipExisting,
            "render nothing when every -o is there, finished by an earlier\nrun with the same "
            "settings: for "
            "retries")
        ->group("Parts");
}

void checkRangeOptions(const RangeOptions& options, const std::vector<fs::path>& outputs)
{
    if (options.range && options.shard) {
        throw usageError("--sample-range and --shard both say which samples to render; give one");
    }
    if (options.skipExisting && !options.wantsFilm()) {
        throw usageError(
            "--skip-existing looks at films; use it with --shard, --sample-range or --keep-film");
    }
    if (options.skipExisting && !std::all_of(outputs.begin(), outputs.end(), isExrPath)) {
        throw usageError(
            "--skip-existing cannot tell whether other outputs than .exr files are finished; "
            "write those by sahl merge");
    }
    if (!options.wantsFilm() || std::any_of(outputs.begin(), outputs.end(), isExrPath)) return;
    throw usageError("{} needs an output that ends in .exr: other formats cannot hold the film",
                     options.shard   ? "--shard"
                     : options.range ? "--sample-range"
                                     : "--keep-film");
}

SampleRange rangeOf(const RangeOptions& options, const RenderSettings& settings)
{
    if (options.wantsFilm() && isAdaptive(settings)) {
        throw usageError(
            "adaptive sampling by the rule {} decides how many samples a pixel gets from all of "
            "its samples together, so parts cannot be merged; render them with --adaptive none",
            adaptiveRuleName(settings.adaptive.rule));
    }
    const uint32_t total = mostSamples(settings);
    const uint32_t blockSize = blockOfReplicates(replicateSizeOf(settings.samplerKind));
    if (options.range) {
        const SampleRange range = *options.range;
        if (range.end > total) {
            throw usageError("--sample-range {}: the picture has {} samples a pixel; give --spp {}",
                             rangeText(range), total, range.end);
        }
        requireBlockBorder(range.first, range, blockSize, total);
        requireBlockBorder(range.end, range, blockSize, total);
        return range;
    }
    if (!options.shard) return {0, total};
    const uint32_t blocks = blocksIn(total, blockSize);
    if (options.shard->count > blocks) {
        throw usageError(
            "--shard {}/{}: {} samples are {} block{} of {}, so there are at most {} shards",
            options.shard->index, options.shard->count, total, blocks, blocks == 1 ? "" : "s",
            blockSize, blocks);
    }
    return shardOf(options.shard->index, options.shard->count, total, blockSize);
}

std::string shardText(const ArrayTask& shard)
{
    return fmt::format("{}/{}", shard.index, shard.count);
}

std::string partSuffix(const RangeOptions& options)
{
    if (options.shard)
        return fmt::format("-shard-{}-of-{}", options.shard->index, options.shard->count);
    if (options.range)
        return fmt::format("-samples-{}-{}", options.range->first, options.range->end);
    return "";
}

}  // namespace sahl
