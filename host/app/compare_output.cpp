#include "app/compare_output.h"

#include "sahl_version.h"
#include "util/messages.h"

#include <cmath>

namespace sahl {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN and no infinity.
Json numberJson(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json measureJson(const Measure& measure)
{
    return {{"all", numberJson(measure.all)}, {"trimmed", numberJson(measure.trimmed)}};
}

Json flipJson(const Flip& flip)
{
    Json json = {{"mean", measureJson(flip.mean)},
                 {"weightedMedian", numberJson(flip.weightedMedian)},
                 {"largest", numberJson(flip.largest)}};
    if (!flip.exposures.empty()) json["exposures"] = flip.exposures;
    return json;
}

Json countsJson(const std::array<ValueCounts, 3>& counts)
{
    Json json = Json::object();
    for (size_t c = 0; c < 3; c++) {
        json[std::string(1, "RGB"[c])] = {{"nan", counts[c].nan},
                                          {"infinite", counts[c].infinite},
                                          {"negative", counts[c].negative}};
    }
    return json;
}

Json pictureJson(const LoadedPicture& picture, const std::array<ValueCounts, 3>& counts)
{
    Json metadata = Json::object();
    for (const auto& [name, text] : picture.metadata) metadata[name] = text;
    return {{"file", picture.name},
            {"format", picture.format},
            {"variance", !picture.variance.empty()},
            {"counts", countsJson(counts)},
            {"metadata", metadata}};
}

Json metricsJson(const Metrics& m, const CompareOptions& options)
{
    Json json = {{"pixels", m.pixels},
                 {"excludedPixels", m.excludedPixels},
                 {"unmatchedPixels", m.unmatchedPixels},
                 {"differingPixels", m.differingPixels},
                 {"largestDifference",
                  {{"value", m.largestDifference.value},
                   {"x", m.largestDifference.x},
                   {"y", m.largestDifference.y}}},
                 {"mae", measureJson(m.mae)},
                 {"mse", measureJson(m.mse)},
                 {"rmse", measureJson(m.rmse)},
                 {"relMse", measureJson(m.relMse)},
                 {"smape", measureJson(m.smape)},
                 {"psnr", measureJson(m.psnr)},
                 {"ssim", measureJson(m.ssim)},
                 {"ldrFlip", flipJson(m.ldrFlip)},
                 {"hdrFlip", m.hdrFlip ? flipJson(*m.hdrFlip) : Json(nullptr)}};
    json["exposure"] = options.exposure;
    json["pixelsPerDegree"] = options.pixelsPerDegree;
    return json;
}

Json testJson(const MeanTest& test)
{
    return {{"difference", numberJson(test.difference)},
            {"standardError", numberJson(test.standardError)},
            {"degreesOfFreedom", numberJson(test.degreesOfFreedom)},
            {"z", numberJson(test.z)},
            {"p", numberJson(test.p)}};
}

Json statisticsJson(const Statistics& s, const CompareOptions& options)
{
    Json json = {{"level", options.level},
                 {"frameLevel", s.frameLevel},
                 {"blockLevel", s.blockLevel},
                 {"margin", options.margin},
                 {"tolerated", options.tolerated},
                 {"meanA", s.meanA},
                 {"meanB", s.meanB},
                 {"frame", testJson(s.frame)},
                 {"frameDiffers", s.frameDiffers},
                 {"testedBlocks", s.testedBlocks},
                 {"blocks", s.blocks.size()},
                 {"differingBlocks", Json::array()},
                 {"confidenceBound", numberJson(s.confidenceBound)},
                 {"equivalent", s.equivalent},
                 {"detectableBias", numberJson(s.detectableBias)},
                 {"detectableBlock", numberJson(s.detectableBlock)},
                 {"moreSamples", numberJson(s.moreSamples)},
                 {"excludedPixels", s.excludedPixels},
                 {"noEvidencePixels", s.noEvidencePixels},
                 {"noEvidenceDiffering", s.noEvidenceDiffering},
                 {"noEvidenceShare", s.noEvidenceShare}};
    for (const BlockTest& block : s.blocks) {
        if (!block.differs) continue;
        Json entry = {
            {"x", block.x}, {"y", block.y}, {"width", block.width}, {"height", block.height}};
        entry.update(testJson(block.mean));
        json["differingBlocks"].push_back(entry);
    }
    return json;
}

std::string nameOf(GateState state)
{
    return state == GateState::passed   ? "passed"
           : state == GateState::failed ? "failed"
                                        : "undecided";
}

/// What the file says of how it was made, in a few words.
std::string origin(const LoadedPicture& picture)
{
    const std::pair<const char*, const char*> told[] = {{"sahl.scene", ""},
                                                        {"sahl.sampleCount", "samples "},
                                                        {"sahl.seed", "seed "},
                                                        {"sahl.sampler", "sampler "}};
    std::string text;
    for (const auto& [name, label] : told) {
        const auto found = picture.metadata.find(name);
        if (found != picture.metadata.end()) text += ", " + (label + found->second);
    }
    return text;
}

void printPicture(const char* who, const LoadedPicture& picture, const Comparison& c)
{
    answer("{:<9} {}: {}, {} x {}{}\n", who, picture.name, picture.format, c.width, c.height,
           origin(picture));
}

void printCounts(const char* who, const std::array<ValueCounts, 3>& counts)
{
    std::string text;
    for (size_t c = 0; c < 3; c++) {
        const ValueCounts& v = counts[c];
        if (v.nan + v.infinite + v.negative == 0) continue;
        text += fmt::format("{}{}: {} NaN, {} infinite, {} negative", text.empty() ? "" : "; ",
                            "RGB"[c], v.nan, v.infinite, v.negative);
    }
    answer("values    {}  {}\n", who, text.empty() ? "no NaN, no infinity, none negative" : text);
}

std::string numberText(double value)
{
    if (std::isnan(value)) return "-";
    return fmt::format("{:.6g}", value);
}

void printMeasure(const char* name, const Measure& measure, const std::string& more = "")
{
    answer("  {:<26} {:>13} {:>13}{}\n", name, numberText(measure.all), numberText(measure.trimmed),
           more);
}

void printFlip(const char* name, const Flip& flip)
{
    printMeasure(name, flip.mean,
                 fmt::format("   weighted median {}, largest {}", numberText(flip.weightedMedian),
                             numberText(flip.largest)));
}

void printMetrics(const Metrics& m)
{
    answer("metrics   {:<18} {:>13} {:>13}\n", fmt::format("{} pixels", m.pixels), "all",
           "best 99.9 %");
    printMeasure("MAE", m.mae);
    printMeasure("MSE", m.mse);
    printMeasure("RMSE", m.rmse);
    printMeasure("relMSE (eps 0.01)", m.relMse);
    printMeasure("SMAPE (eps 0.01)", m.smape);
    printMeasure("PSNR [dB]", m.psnr);
    printMeasure("SSIM", m.ssim);
    printFlip("LDR-FLIP", m.ldrFlip);
    if (m.hdrFlip) printFlip("HDR-FLIP", *m.hdrFlip);
    answer("  {} pixels differ; largest difference {:.6g} at pixel ({}, {})\n", m.differingPixels,
           m.largestDifference.value, m.largestDifference.x, m.largestDifference.y);
}

void printStatistics(const Statistics& s, const CompareOptions& options)
{
    answer("noise     mean luminance A {:.6g}, B {:.6g}\n", s.meanA, s.meanB);
    if (!(s.frame.standardError > 0)) return;
    const double mean = std::fabs(0.5 * (s.meanA + s.meanB));
    answer("  A - B          {:+.3g} % of the mean, standard error {:.3g} %: z {:.2f}, p {:.3g}\n",
           100 * s.frame.difference / mean, 100 * s.frame.standardError / mean, s.frame.z,
           s.frame.p);
    answer("  blocks         {} of {} differ (8 x 8 pixels; {} more have no spread)\n",
           s.differingBlocks, s.testedBlocks, s.blocks.size() - s.testedBlocks);
    answer(
        "  detectable     a bias of {:.3g} % of the mean in the frame, of {:.3g} % of it in the "
        "middle block\n"
        "                 (found in 4 of 5 cases; equal scenes are called different in {:.3g} %)\n",
        100 * s.detectableBias, 100 * s.detectableBlock, 100 * options.level);
    answer("  equivalent     within {:.3g} % of the mean, 95 % sure; asked for: {:.3g} %\n",
           100 * s.confidenceBound, 100 * options.margin);
}

void printPaired(const PairedDifferences& paired)
{
    answer(
        "paired    A - B {:+.3g} % of the mean, spread between blocks {:.3g} %, largest of a block "
        "{:.3g} %\n",
        100 * paired.mean, 100 * paired.spread, 100 * paired.largest);
}

const char* headline(Verdict verdict)
{
    switch (verdict) {
    case Verdict::sameBits:
    case Verdict::sameValues:
        return "SAME";
    case Verdict::equivalent:
        return "EQUIVALENT";
    case Verdict::undecided:
        return "UNDECIDED";
    case Verdict::differ:
        return "DIFFERENT";
    }
    return "";
}

}  // namespace

std::string nameOf(Verdict verdict)
{
    switch (verdict) {
    case Verdict::sameBits:
    case Verdict::sameValues:
        return "same";
    case Verdict::equivalent:
        return "equivalent";
    case Verdict::undecided:
        return "undecided";
    case Verdict::differ:
        return "differ";
    }
    return "";
}

Json comparisonJson(const ComparedPictures& compared)
{
    const Comparison& c = compared.comparison;
    Json json = {
        {"version", 1},
        {"sahl", SAHL_VERSION},
        {"width", c.width},
        {"height", c.height},
        {"a", pictureJson(compared.a, c.countsA)},
        {"b", pictureJson(compared.b, c.countsB)},
        {"metrics", metricsJson(c.metrics, compared.options)},
        {"statistics", c.statistics ? statisticsJson(*c.statistics, compared.options) : Json()},
        {"paired", nullptr},
        {"verdict", nameOf(c.verdict)},
        {"sameBits", c.verdict == Verdict::sameBits},
        {"reason", c.reason},
        {"notes", c.notes},
        {"gates", Json::array()}};
    if (c.paired) {
        json["paired"] = {{"mean", c.paired->mean},
                          {"spread", c.paired->spread},
                          {"largestBlock", c.paired->largest}};
    }
    for (const GateResult& gate : compared.gates) {
        json["gates"].push_back(
            {{"gate", gate.name}, {"state", nameOf(gate.state)}, {"finding", gate.finding}});
    }
    json["exitCode"] = exitCodeOf(c, compared.gates);
    return json;
}

void printComparison(const ComparedPictures& compared)
{
    const Comparison& c = compared.comparison;
    printPicture("A", compared.a, c);
    printPicture("B", compared.b, c);
    printCounts("A", c.countsA);
    printCounts("B", c.countsB);
    printMetrics(c.metrics);
    if (c.statistics) printStatistics(*c.statistics, compared.options);
    if (c.paired && c.verdict != Verdict::sameBits) printPaired(*c.paired);
    for (const std::string& note : c.notes) answer("note      {}\n", note);
    for (const GateResult& gate : compared.gates) {
        answer("gate      {} {}: {}\n", gate.name, nameOf(gate.state), gate.finding);
    }
    answer("verdict   {}: {}\n", headline(c.verdict), c.reason);
}

}  // namespace sahl
