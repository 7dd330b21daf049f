// sahl merge: pictures of some of the samples into the picture of all of them.

#include "film/merge.h"

#include "app/commands.h"
#include "app/option_kinds.h"
#include "app/outputs.h"
#include "film/layers.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>
#include <memory>

namespace sahl {

namespace {

struct MergeOptions {
    std::vector<fs::path> inputs;
    OutputOptions output;
    bool allowGaps = false;
    bool keepFilm = false;
    bool quiet = false;
};

std::vector<fs::path> checkOutputs(const MergeOptions& options)
{
    checkToneOptions(options.output.tone);
    std::vector<fs::path> outputs = options.output.paths;
    checkPicturePaths(outputs);
    if (options.output.tone.histogram.empty()) return outputs;
    checkPngPath("--histogram", options.output.tone.histogram, outputs);
    outputs.push_back(options.output.tone.histogram);
    return outputs;
}

/// The film stays in the file while there is something to add to it, or on demand.
bool keepsFilm(const MergeOptions& options, const FilmLabel& label)
{
    return options.keepFilm || !label.isWhole();
}

void writeAll(MergeOptions& options, const MergedFilm& merged)
{
    ImageMetadata metadata = merged.metadata;
    options.output.place = merged.place;
    options.output.film = keepsFilm(options, merged.label);
    if (options.output.film) metadata.merge(filmMetadata(merged.film, merged.label));
    std::vector<ImageChannel> channels = statisticsChannels(merged.film);
    channels.insert(channels.end(), merged.firstHits.begin(), merged.firstHits.end());
    writeOutputs(merged.film, options.output, metadata, channels);
    if (!options.output.tone.histogram.empty()) {
        writeHistogram(meanImage(merged.film), options.output.tone, metadata);
    }
}

void printSummary(const MergeOptions& options, const MergedFilm& merged,
                  const std::vector<fs::path>& outputs)
{
    if (options.quiet) return;
    const Counters& counters = merged.film.counters;
    say("{} file{}, samples {} of {} per pixel, {} rays\n", options.inputs.size(),
        options.inputs.size() == 1 ? "" : "s", rangesText(merged.label.ranges),
        merged.label.totalSamples,
        counters.cameraRays + counters.indirectRays + counters.shadowRays);
    if (counters.badSamples > 0) {
        warn(fmt::format("{} samples were negative or not finite and count as black",
                         counters.badSamples));
    }
    if (counters.clamped > 0) say("indirect light was clamped {} times (biased)\n", counters.clamped);
    for (const fs::path& path : outputs) answer("{}\n", path.string());
}

int runMerge(MergeOptions& options)
{
    setQuiet(options.quiet);
    const std::vector<fs::path> outputs = checkOutputs(options);
    std::vector<FilmFile> files;
    for (const fs::path& path : options.inputs) files.push_back(openFilmFile(path));
    refuseToReplaceInputs(outputs);
    const MergedFilm merged = mergeFilms(std::move(files), options.allowGaps);
    writeAll(options, merged);
    printSummary(options, merged, outputs);
    return 0;
}

}  // namespace

Command addMergeCommand(CLI::App& app)
{
    auto options = std::make_shared<MergeOptions>();
    CLI::App* command =
        app.add_subcommand("merge", "put parts of a picture together, to the bits of one run")
            ->group("Commands");
    command
        ->add_option("files", options->inputs,
                     "parts of one picture, in any order: .exr files by\n"
                     "sahl render --shard, --sample-range or --keep-film")
        ->required()
        ->expected(-1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("FILE...");
    command
        ->add_option("-o,--output", options->output.paths,
                     "picture to write: .exr or .pfm (linear), .png (tone mapped);\n"
                     "repeatable; required")
        ->required()
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Output");
    addFlag(*command, "--keep-film", options->keepFilm,
            "the exact film in the .exr although it is whole, to add\nmore samples later")
        ->group("Output");
    addFlag(*command, "--allow-gaps", options->allowGaps,
            "do without samples that are missing; the film is kept, so\nthat they can be added")
        ->group("Output");
    addToneOptions(*command, "--tone-map", options->output.tone);
    addFlag(*command, "-q,--quiet", options->quiet, "only errors")->group("Messages");
    command->footer(
        "docs/merge.md says what parts must have in common, and how arrays of jobs make them.\n\n"
        "Examples:\n"
        "  sahl render scene.json --shard 0/2 -o a.exr\n"
        "  sahl render scene.json --shard 1/2 -o b.exr\n"
        "  sahl merge a.exr b.exr -o picture.exr -o picture.png");
    return [options] { return runMerge(*options); };
}

}  // namespace sahl
