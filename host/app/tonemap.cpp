// sahl tonemap: from a linear picture to an 8-bit one, as sahl render makes them.

#include "app/commands.h"
#include "app/option_kinds.h"
#include "app/outputs.h"
#include "app/tone_options.h"
#include "sahl_version.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace sahl {

namespace {

struct TonemapOptions {
    fs::path input;
    fs::path output;  ///< empty: named after the input
    ToneOptions tone;
    bool quiet = false;
};

std::vector<fs::path> checkOutputs(TonemapOptions& options)
{
    checkToneOptions(options.tone);
    if (options.output.empty()) options.output = options.input.stem().string() + ".png";
    checkPngPath("-o", options.output, {});
    if (options.tone.histogram.empty()) return {options.output};
    checkPngPath("--histogram", options.tone.histogram, {options.output});
    return {options.output, options.tone.histogram};
}

void warnAboutValues(const Image& image, const fs::path& path)
{
    const auto bad = std::count_if(image.rgb.begin(), image.rgb.end(),
                                   [](float value) { return !std::isfinite(value); });
    if (bad == 0) return;
    warn(fmt::format("{}: {} of {} values are not finite and count as 0", path.string(), bad,
                     image.rgb.size()));
}

int runTonemap(TonemapOptions& options)
{
    setQuiet(options.quiet);
    const std::vector<fs::path> outputs = checkOutputs(options);
    const Image image = readImage(options.input);
    refuseToReplaceInputs(outputs);
    warnAboutValues(image, options.input);

    const ToneCurve curve = fitToneCurve(image, options.tone.map);
    const ImageMetadata metadata = {{"sahl.version", SAHL_VERSION},
                                    {"sahl.source", options.input.filename().string()},
                                    {"sahl.toneMap", nameOf(curve.op)},
                                    {"sahl.exposure", fmt::format("{:g}", options.tone.map.stops)},
                                    {"sahl.gamma", nameOfGamma(curve.gamma)}};
    writeFileAtomically(options.output, encodePng(applyToneCurve(image, curve), metadata));
    if (!options.tone.histogram.empty()) writeHistogram(image, options.tone, metadata);
    if (!options.quiet) {
        for (const fs::path& path : outputs) answer("{}\n", path.string());
    }
    return 0;
}

}  // namespace

Command addTonemapCommand(CLI::App& app)
{
    auto options = std::make_shared<TonemapOptions>();
    CLI::App* command =
        app.add_subcommand("tonemap", "turn a linear picture into a .png")->group("Commands");
    command->add_option("picture", options->input, "linear picture: .exr, .hdr or .pfm")
        ->required()
        ->type_name("PICTURE");
    command
        ->add_option("-o,--output", options->output,
                     withDefault("picture to write: .png", "PICTURE.png here"))
        ->type_name("FILE")
        ->group("Output");
    addToneOptions(*command, "--operator", options->tone);
    addFlag(*command, "-q,--quiet", options->quiet, "only errors")->group("Messages");
    command->footer("Examples:\n"
                    "  sahl tonemap teapot.exr -o teapot.png --operator filmic --exposure 1\n"
                    "  sahl tonemap grace.hdr --histogram values.png");
    return [options] { return runTonemap(*options); };
}

}  // namespace sahl
