#include "app/tone_options.h"

#include "app/option_kinds.h"
#include "image/histogram.h"
#include "util/error.h"

namespace sahl {

namespace {

constexpr size_t HISTOGRAM_BINS = 160;

const std::vector<std::pair<std::string, ToneOperator>> OPERATORS = {
    {"percentile", ToneOperator::percentile},
    {"naive", ToneOperator::naive},
    {"exposure", ToneOperator::exposure},
    {"filmic", ToneOperator::filmic}};

double parseGamma(const std::string& text)
{
    if (text == "srgb") return SRGB_GAMMA;
    try {
        return parseReal("--gamma", text, 0.1, 10);
    } catch (const CLI::ValidationError& error) {
        throw CLI::ValidationError(std::string(error.what()) + ", or srgb");
    }
}

}  // namespace

std::string nameOf(ToneOperator op)
{
    for (const auto& [name, value] : OPERATORS) {
        if (value == op) return name;
    }
    return "";
}

std::string nameOfGamma(double gamma)
{
    return gamma == SRGB_GAMMA ? "srgb" : fmt::format("{:g}", gamma);
}

void addToneOptions(CLI::App& command, const std::string& name, ToneOptions& options)
{
    addChoice(command, name, options.map.op, OPERATORS,
              "percentile (5-95), naive (min-max), exposure or\nfilmic (docs/tone_mapping.md)")
        ->group("Output");
    auto setExposure = [&options](const std::string& text) {
        options.map.stops = parseReal("--exposure", text, -100, 100);
        options.exposureGiven = true;
    };
    command
        .add_option_function<std::string>(
            "--exposure", setExposure,
            withDefault("for exposure and filmic [stops], -100 to 100", "0"))
        ->type_name("X")
        ->group("Output");
    command
        .add_option_function<std::string>(
            "--gamma",
            [&options](const std::string& text) { options.map.gamma = parseGamma(text); },
            withDefault("v^(1/G) after the operator, 0.1 to 10, or srgb",
                        "1 for percentile\nand naive, srgb for exposure and filmic"))
        ->type_name("G")
        ->group("Output");
    command
        .add_option("--histogram", options.histogram,
                    withDefault("plots of values before and after tone mapping, .png", "none"))
        ->type_name("FILE")
        ->group("Output");
}

void checkToneOptions(const ToneOptions& options)
{
    const ToneOperator op = options.map.op;
    const bool fitted = op == ToneOperator::percentile || op == ToneOperator::naive;
    if (options.exposureGiven && fitted) {
        throw usageError(
            "--exposure changes nothing with {}, which fits the picture's range; choose "
            "exposure or filmic",
            nameOf(op));
    }
}

void writeHistogram(const Image& image, const ToneOptions& options, const ImageMetadata& metadata)
{
    std::vector<float> values = finiteValues(image);
    std::vector<HistogramPlot> plots;
    plots.push_back({"rgb values before", histogramOfRange(values, HISTOGRAM_BINS)});
    const ToneCurve curve = fitToneCurve(image, options.map);
    for (float& value : values) value = static_cast<float>(curve(double{value}));
    plots.push_back({"after " + nameOf(options.map.op), histogramOfUnit(values, HISTOGRAM_BINS)});
    writeFileAtomically(options.histogram, encodePng(plotHistograms(plots), metadata));
}

}  // namespace sahl
