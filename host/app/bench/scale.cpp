// sahl bench scale: how cost grows with triangles, threads, pixels, samples and bounces.

#include "app/bench/bench.h"
#include "app/bench/embree.h"
#include "app/bench/rays.h"
#include "app/bench/rounds.h"
#include "app/bench/scenes.h"
#include "app/bench/table.h"
#include "image/line_chart.h"
#include "render/render.h"
#include "util/interrupt.h"
#include "util/messages.h"

#include <ctime>
#include <map>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t ROUNDS = 5;
constexpr uint32_t LEAST_TRIANGLES = 10'000, MOST_TRIANGLES = 10'000'000;
constexpr uint32_t TRIANGLES = 70'000;  // where something else grows, and from where triangles do
constexpr uint32_t MOST_BOUNCES = 32;

uint32_t roundsOf(const BenchOptions& options)
{
    return options.repeat > 0 ? options.repeat : ROUNDS;
}

/// Seconds of all threads of this process: on a busy machine they say more than those of a clock.
double processorSeconds()
{
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// `run`, whose processor's seconds go into `processor`.
template <class Run>
std::function<double()> timedRun(Timing& processor, const Run& run)
{
    return [&processor, run] {
        const double before = processorSeconds(), seconds = run();
        processor.seconds.push_back(processorSeconds() - before);
        return seconds;
    };
}

double boxTestsPerRay(std::span<const TraceHit> hits)
{
    uint64_t tests = 0;
    for (const TraceHit& hit : hits) tests += hit.boxTests;
    return double(tests) / std::max(double(hits.size()), 1.0);
}

/// What a picture took, without what had to be made for it [s].
struct Spent {
    double seconds = 0;
    double processor = 0;
};

/// By so many threads of the host.
Spent renderAll(Device& device, uint32_t size, uint32_t spp, unsigned threads)
{
    RenderPlan plan;
    plan.width = plan.height = size;
    plan.sampleCount = spp;
    plan.threads = threads;
    const double before = processorSeconds();
    const double seconds = renderPicture(device, plan, [](const RenderProgress&) {}).seconds;
    return {seconds, processorSeconds() - before};
}

/// 10^4, 70,000, 10^5, ... up to `most`.
std::vector<uint32_t> triangleCounts(uint32_t most)
{
    std::vector<uint32_t> counts;
    for (uint64_t count = std::min(LEAST_TRIANGLES, most); count <= most; count *= 10) {
        counts.push_back(static_cast<uint32_t>(count));
        if (count < TRIANGLES && TRIANGLES < 10 * count && TRIANGLES <= most)
            counts.push_back(TRIANGLES);
    }
    return counts;
}

/// How the time of a ray grows from the row nearest to TRIANGLES to the last one; relative to
/// Embree's, whose rays went in the same rounds.
Json growthOf(const Json& rows)
{
    const Json* from = nullptr;
    for (const Json& row : rows)
        if (!from || row["triangles"] <= 1.05 * TRIANGLES) from = &row;
    if (!from) return nullptr;
    const Json& to = rows.back();
    auto ratio = [&](const char* key) {
        return to[key].get<double>() / (*from)[key].get<double>();
    };
    Json growth = {
        {"from", (*from)["triangles"]}, {"to", to["triangles"]}, {"sahl", ratio("nsPerRay")}};
    if (to.contains("timeToEmbree")) {
        growth["embree"] = ratio("embreeNsPerRay");
        growth["relative"] = ratio("timeToEmbree");
        growth["relativeByProcessor"] = ratio("processorTimeToEmbree");
        answer("from {} to {} triangles a diffuse ray takes {} times as long, Embree's {} times: "
               "{} relative to it, "
               "by the processor's time {}\n",
               growth["from"].get<uint64_t>(), growth["to"].get<uint64_t>(),
               shortNumber(growth["sahl"]), shortNumber(growth["embree"]),
               shortNumber(growth["relative"]), shortNumber(growth["relativeByProcessor"]));
    }
    return growth;
}

/// Diffuse rays through tori of more and more triangles, and the time to build their trees.
Json growTriangles(const BenchOptions& options, Device& device, std::vector<LineChart>& charts)
{
    const unsigned threads = threadsFor(options.common);
    const uint32_t most = options.triangles > 0 ? options.triangles : MOST_TRIANGLES;
    ChartLine ours = {"sahl", {}}, theirs = {"embree", {}}, ourProcessor = {"sahl cpu", {}},
              embreeProcessor = {"embree cpu", {}}, build = {"sahl", {}},
              theirBuild = {"embree", {}};
    Json rows = Json::array();
    std::vector<TableRow> table;
    for (uint32_t triangles : triangleCounts(most)) {
        if (interruptSignal() != 0) break;
        Scene scene = torusScene(triangles, options.size, 1);
        const size_t count = scene.primitives.size();
        const auto embree = options.alone
                                ? nullptr
                                : makeEmbreeScene(scene.primitives, EmbreeBuild::standard, threads);
        const PreparedScene prepared =
            prepareScene(std::move(scene), options.common.bvhBuild, threads);
        device.setScene(prepared.deviceScene());
        const RaySet diffuse =
            makeRays(prepared.scene, prepared.deviceScene(), options.size, threads).back();
        std::vector<TraceHit> hits(diffuse.rays.size());
        Timing processor = {"sahl", {}}, theirProcessor = {"embree", {}};
        auto ourRays = [&] { return device.traceRays(diffuse.rays, false, hits); };
        auto theirRays = [&] { return embree->trace(diffuse.rays, false, hits); };
        std::vector<Contestant> contestants = {{"sahl", timedRun(processor, ourRays)}};
        if (embree) {
            contestants.push_back({"embree", timedRun(theirProcessor, theirRays)});
            theirRays();  // the first time touches memory
        }
        ourRays();
        const double boxTests = boxTestsPerRay(hits);
        const std::vector<Timing> timings = runRounds(contestants, roundsOf(options));
        auto nanoseconds = [&](const Timing& timing) {
            return timing.median() * 1e9 / double(diffuse.rays.size());
        };
        Json row = {{"triangles", count},
                    {"rays", diffuse.rays.size()},
                    {"buildSeconds", prepared.bvh.statistics.seconds},
                    {"boxTestsPerRay", boxTests},
                    {"nsPerRay", nanoseconds(timings[0])},
                    {"processorNsPerRay", nanoseconds(processor)},
                    {"spread", timings[0].spread()}};
        ours.points.emplace_back(count, nanoseconds(timings[0]));
        ourProcessor.points.emplace_back(count, nanoseconds(processor));
        build.points.emplace_back(count, prepared.bvh.statistics.seconds);
        TableRow line = {std::to_string(count), shortNumber(prepared.bvh.statistics.seconds),
                         shortNumber(nanoseconds(timings[0])), "", ""};
        if (embree) {
            row["embreeBuildSeconds"] = embree->buildSeconds();
            row["embreeNsPerRay"] = nanoseconds(timings[1]);
            row["embreeProcessorNsPerRay"] = nanoseconds(theirProcessor);
            row["timeToEmbree"] = medianRatio(timings[0], timings[1]);
            row["processorTimeToEmbree"] = medianRatio(processor, theirProcessor);
            theirs.points.emplace_back(count, nanoseconds(timings[1]));
            embreeProcessor.points.emplace_back(count, nanoseconds(theirProcessor));
            theirBuild.points.emplace_back(count, embree->buildSeconds());
            line[3] = shortNumber(embree->buildSeconds());
            line[4] = shortNumber(nanoseconds(timings[1]));
        }
        rows.push_back(row);
        table.push_back(line);
    }
    printTable({"triangles", "tree [s]", "ns a ray", "Embree's tree", "Embree's ray"}, table);
    charts.push_back(
        {"ns a diffuse ray by triangles", {ours, theirs, ourProcessor, embreeProcessor}});
    charts.push_back({"seconds to build a tree by triangles", {build, theirBuild}});
    return rows;
}

/// One number grows; nanoseconds of a sample are plotted.
struct Growth {
    const char* name;
    std::vector<uint32_t> values;
    std::function<Spent(uint32_t value)> render;
    std::function<double(uint32_t value)> samples;
};

Json grow(const Growth& growth, const BenchOptions& options, std::vector<LineChart>& charts)
{
    std::vector<Contestant> contestants;
    std::map<uint32_t, Timing> processor;
    for (uint32_t value : growth.values)
        contestants.push_back({std::to_string(value), [&, value] {
                                   const Spent spent = growth.render(value);
                                   processor[value].seconds.push_back(spent.processor);
                                   return spent.seconds;
                               }});
    const std::vector<Timing> timings = runRounds(contestants, roundsOf(options));
    ChartLine line = {"sahl", {}}, processorLine = {"sahl cpu", {}};
    Json rows = Json::array();
    std::vector<TableRow> table;
    for (size_t i = 0; i < timings.size(); i++) {
        const uint32_t value = growth.values[i];
        const double nanoseconds = timings[i].median() * 1e9 / growth.samples(value);
        const double ofProcessor = processor[value].median() * 1e9 / growth.samples(value);
        rows.push_back({{growth.name, value},
                        {"seconds", timings[i].seconds},
                        {"nsPerSample", nanoseconds},
                        {"processorNsPerSample", ofProcessor},
                        {"spread", timings[i].spread()}});
        table.push_back({std::to_string(value), shortNumber(timings[i].median()),
                         shortNumber(nanoseconds), shortNumber(ofProcessor),
                         percent(timings[i].spread())});
        if (nanoseconds > 0) line.points.emplace_back(value, nanoseconds);
        if (ofProcessor > 0) processorLine.points.emplace_back(value, ofProcessor);
    }
    printTable({growth.name, "seconds", "ns a sample", "processor's ns", "spread"}, table);
    charts.push_back({std::string("ns a sample by ") + growth.name, {line, processorLine}});
    return rows;
}

std::vector<uint32_t> doublings(uint32_t from, uint32_t to)
{
    std::vector<uint32_t> values;
    for (uint32_t value = from; value < to; value *= 2) values.push_back(value);
    values.push_back(to);
    return values;
}

/// The same picture by 1, 2, 4, ... threads of the CPU.
Json growThreads(const BenchOptions& options, const PreparedScene& scene,
                 std::vector<LineChart>& charts)
{
    auto render = [&](uint32_t threads) {
        DeviceOptions device = options.common.deviceOptions;
        device.threads = threads;
        const std::unique_ptr<Device> cpu = makeCpuDevice(device);
        cpu->setScene(scene.deviceScene());
        return renderAll(*cpu, options.size, BLOCK_SIZE, threads);
    };
    auto samples = [&](uint32_t) { return double(options.size) * options.size * BLOCK_SIZE; };
    return grow({"threads", doublings(1, threadsFor(options.common)), render, samples}, options,
                charts);
}

Json growPixels(const BenchOptions& options, Device& device, std::vector<LineChart>& charts)
{
    auto render = [&](uint32_t size) {
        const PreparedScene scene = prepareScene(
            torusScene(TRIANGLES, size, 1), options.common.bvhBuild, threadsFor(options.common));
        device.setScene(scene.deviceScene());
        return renderAll(device, size, BLOCK_SIZE, threadsFor(options.common));
    };
    auto samples = [](uint32_t size) { return double(size) * size * BLOCK_SIZE; };
    const uint32_t least = std::max(options.size / 8, 1u);
    return grow({"width", doublings(least, options.size), render, samples}, options, charts);
}

Json growSamples(const BenchOptions& options, Device& device, std::vector<LineChart>& charts)
{
    auto render = [&](uint32_t spp) { return renderAll(device, options.size, spp, threadsFor(options.common)); };
    auto samples = [&](uint32_t spp) { return double(options.size) * options.size * spp; };
    return grow({"spp", doublings(1, 4 * BLOCK_SIZE), render, samples}, options, charts);
}

/// In the courtyard, where paths go on for long.
Json growBounces(const BenchOptions& options, Device& device, std::vector<LineChart>& charts)
{
    PreparedScene scene = prepareScene(courtyardScene(TRIANGLES, options.size, 1),
                                       options.common.bvhBuild, threadsFor(options.common));
    auto render = [&](uint32_t bounces) {
        scene.scene.settings.maxBounces = bounces;
        device.setScene(scene.deviceScene());
        return renderAll(device, options.size, BLOCK_SIZE, threadsFor(options.common));
    };
    render(1);
    auto samples = [&](uint32_t) { return double(options.size) * options.size * BLOCK_SIZE; };
    return grow({"bounces", doublings(1, MOST_BOUNCES), render, samples}, options, charts);
}

}  // namespace

Json benchScale(const BenchOptions& options)
{
    const std::unique_ptr<Device> device = openDeviceFor(options.common);
    std::vector<LineChart> charts;
    Json json = {{"rounds", roundsOf(options)},
                 {"size", options.size},
                 {"threads", threadsFor(options.common)}};
    json["byTriangles"] = growTriangles(options, *device, charts);
    json["growth"] = growthOf(json["byTriangles"]);
    const PreparedScene scene = prepareScene(torusScene(TRIANGLES, options.size, 1),
                                             options.common.bvhBuild, threadsFor(options.common));
    json["byThreads"] = growThreads(options, scene, charts);
    json["byPixels"] = growPixels(options, *device, charts);
    device->setScene(scene.deviceScene());
    renderAll(*device, options.size, 1, threadsFor(options.common));
    json["bySamples"] = growSamples(options, *device, charts);
    json["byBounces"] = growBounces(options, *device, charts);
    if (!options.plotPath.empty() && interruptSignal() == 0)
        writeFileAtomically(fs::path(options.plotPath),
                            encodePng(drawCharts(charts), {{"Software", "sahl"}}));
    return json;
}

}  // namespace sahl
