// sahl bench report: counts and times of the report's benchmark, beside what the report printed.

#include "app/bench/bench.h"
#include "app/bench/report_scenes.h"
#include "app/stats.h"
#include "render/prepare.h"
#include "render/render.h"
#include "util/interrupt.h"
#include "util/messages.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

/// What was counted and timed of a scene.
struct BenchRow {
    const BenchScene* scene;
    std::string mesh;
    uint64_t nodes, primitives, dropped, rays, nodeVisits, primitiveTests;
    double buildSeconds, renderSeconds;
};

struct Missing {
    const char* scene;
    std::string reason;
};

/// --assets, else $SAHL_ASSETS and what tools/fetch_assets fetches.
std::vector<fs::path> assetFolders(const BenchOptions& options)
{
    std::vector<fs::path> folders;
    if (!options.assets.empty()) {
        folders.emplace_back(options.assets);
    } else if (const char* assets = std::getenv("SAHL_ASSETS")) {
        if (*assets != 0) folders.emplace_back(assets);
    }
    folders.emplace_back(".assets");
    return folders;
}

uint32_t repeats(const BenchOptions& options)
{
    return options.repeat > 0 ? options.repeat : 3;
}

/// Renders `repeat` times: the counts are the same each time, of the seconds the least is taken.
BenchRow measure(const BenchScene& described, const fs::path& mesh, const BenchOptions& options,
                 Device& device)
{
    Scene scene = makeBenchScene(described, mesh, options.size);
    Stopwatch watch;
    const PreparedScene prepared =
        prepareScene(std::move(scene), options.common.bvhBuild, threadsFor(options.common));
    const double buildSeconds = watch.lap();
    device.setScene(prepared.deviceScene());

    RenderPlan plan;
    plan.width = plan.height = options.size;
    plan.sampleCount = 1;
    plan.tileSize = options.common.tileSize;
    plan.threads = threadsFor(options.common);
    double renderSeconds = 0;
    Counters counters = {};
    for (uint32_t i = 0; i < repeats(options) && interruptSignal() == 0; i++) {
        const RenderResult result = renderPicture(device, plan, [](const RenderProgress&) {});
        counters = result.film.counters;
        renderSeconds = i == 0 ? result.seconds : std::min(renderSeconds, result.seconds);
    }
    const BvhStatistics& tree = prepared.bvh.statistics;
    return {&described,
            mesh.string(),
            tree.innerNodes + tree.leaves,
            tree.primitivesSeen,
            prepared.scene.droppedTriangles,
            counters.cameraRays + counters.indirectRays + counters.shadowRays,
            counters.boxTests / 2,
            counters.primitiveTests,
            buildSeconds,
            renderSeconds};
}

double perRay(uint64_t count, const BenchRow& row)
{
    return row.rays > 0 ? double(count) / double(row.rays) : 0;
}

/// The report's line, where the mesh is the one that it measured.
const ReportRow* reportOf(const BenchRow& row)
{
    const std::optional<ReportRow>& report = row.scene->report;
    return report && report->leaves == row.primitives + row.dropped ? &*report : nullptr;
}

/// The numbers that both have, in the order of the report's table.
Json valuesOf(const BenchRow& row)
{
    return {{"nodes", row.nodes},
            {"primitives", row.primitives},
            {"nodeVisits", row.nodeVisits},
            {"primitiveTests", row.primitiveTests},
            {"buildSeconds", row.buildSeconds},
            {"renderSeconds", row.renderSeconds}};
}

Json valuesOf(const ReportRow& row)
{
    return {{"nodes", row.nodes},
            {"primitives", row.leaves},
            {"nodeVisits", row.rayTraversals},
            {"primitiveTests", row.triangleIntersections},
            {"buildSeconds", row.buildSeconds},
            {"renderSeconds", row.renderSeconds}};
}

/// Ours to theirs, where theirs is not 0.
Json ratiosOf(const Json& ours, const Json& theirs)
{
    Json ratios = Json::object();
    for (const auto& [key, value] : theirs.items()) {
        const double divisor = value.get<double>();
        if (divisor > 0) ratios[key] = ours.at(key).get<double>() / divisor;
    }
    return ratios;
}

Json rowJson(const BenchRow& row)
{
    Json json = {{"scene", row.scene->name}, {"mesh", row.mesh}, {"rays", row.rays}};
    const Json ours = valuesOf(row);
    json.update(ours);
    json["nodeVisitsPerRay"] = perRay(row.nodeVisits, row);
    json["primitiveTestsPerRay"] = perRay(row.primitiveTests, row);
    if (const ReportRow* report = reportOf(row)) {
        const Json theirs = valuesOf(*report);
        json["report"] = theirs;
        json["ratios"] = ratiosOf(ours, theirs);
    }
    return json;
}

Json benchJson(const std::vector<BenchRow>& rows, const std::vector<Missing>& missing,
               const BenchOptions& options, const Device& device)
{
    const DeviceInfo info = device.info();
    Json json = {{"device", {{"name", info.name}, {"driver", info.driver}, {"kind", info.kind}}},
                 {"size", options.size},
                 {"repeat", repeats(options)},
                 {"rows", Json::array()},
                 {"missing", Json::array()}};
    for (const BenchRow& row : rows) json["rows"].push_back(rowJson(row));
    for (const Missing& m : missing) {
        json["missing"].push_back({{"scene", m.scene}, {"reason", m.reason}});
    }
    return json;
}

std::string ratioText(const Json& ratios, const char* key)
{
    return ratios.contains(key) ? fmt::format("{:.3g}", ratios.at(key).get<double>()) : "-";
}

void printRow(const BenchRow& row)
{
    constexpr const char* LINE = "{:<10} {:>9} {:>9} {:>11} {:>11} {:>9} {:>9} {:>11} {:>9}\n";
    answerText(fmt::format(fmt::runtime(LINE), row.scene->name, row.nodes, row.primitives,
                           row.nodeVisits, row.primitiveTests,
                           fmt::format("{:.3f}", row.buildSeconds),
                           fmt::format("{:.3f}", row.renderSeconds),
                           fmt::format("{:.2f}", perRay(row.nodeVisits, row)),
                           fmt::format("{:.2f}", perRay(row.primitiveTests, row))));
    if (!reportOf(row)) {
        if (row.scene->report) answer("  another mesh than the report's: {}\n", row.mesh);
        return;
    }
    const ReportRow& report = *reportOf(row);
    answerText(fmt::format(fmt::runtime(LINE), "  report", report.nodes, report.leaves,
                           report.rayTraversals, report.triangleIntersections, report.buildSeconds,
                           report.renderSeconds, "", ""));
    const Json ratios = ratiosOf(valuesOf(row), valuesOf(report));
    answerText(fmt::format(fmt::runtime(LINE), "  ratio", ratioText(ratios, "nodes"),
                           ratioText(ratios, "primitives"), ratioText(ratios, "nodeVisits"),
                           ratioText(ratios, "primitiveTests"), ratioText(ratios, "buildSeconds"),
                           ratioText(ratios, "renderSeconds"), "", ""));
}

void printHead(const BenchOptions& options)
{
    answer("{} x {} pixels, 1 ray each; the best of {} (docs/bench.md)\n", options.size,
           options.size, repeats(options));
    answer("{:<10} {:>9} {:>9} {:>11} {:>11} {:>9} {:>9} {:>11} {:>9}\n", "scene", "nodes",
           "leaves", "traversals", "triangles", "tree [s]", "image [s]", "trav. a ray",
           "tri. a ray");
}

}  // namespace

Json benchReport(const BenchOptions& options)
{
    const std::vector<fs::path> folders = assetFolders(options);
    CommonOptions common = options.common;
    common.deviceOptions.nodeWidth = 2;  // as the report's program, whose counts stand beside ours
    std::unique_ptr<Device> device = openDeviceFor(common);
    std::vector<BenchRow> rows;
    std::vector<Missing> missing;
    printHead(options);
    for (const BenchScene& scene : benchScenes()) {
        const fs::path mesh = findMesh(scene, folders);
        if (mesh.empty()) {
            missing.push_back(
                {scene.name, "no " + scene.meshes.back() + " here; see tools/fetch_assets"});
            answer("{:<10} not measured: {}\n", scene.name, missing.back().reason);
            continue;
        }
        const BenchRow row = measure(scene, mesh, options, *device);
        if (interruptSignal() != 0) break;
        printRow(row);
        flushAnswers();
        rows.push_back(row);
    }
    return benchJson(rows, missing, options, *device);
}

}  // namespace sahl
