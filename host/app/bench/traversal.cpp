// sahl bench traversal: rays of three kinds through a scene, by the device and by Embree in turns.

#include "app/bench/bench.h"
#include "app/bench/embree.h"
#include "app/bench/rays.h"
#include "app/bench/rounds.h"
#include "app/bench/scenes.h"
#include "app/bench/table.h"
#include "util/interrupt.h"
#include "util/messages.h"

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t ROUNDS = 5;

struct Tracer {
    std::string name;
    std::function<double(const RaySet&, std::span<TraceHit>)> trace;
};

struct Work {
    double boxTests = 0, primitiveTests = 0;  ///< a ray
    uint64_t hits = 0;
};

Work workOf(std::span<const TraceHit> hits)
{
    uint64_t boxTests = 0, primitiveTests = 0;
    Work work;
    for (const TraceHit& hit : hits) {
        boxTests += hit.boxTests;
        primitiveTests += hit.primitiveTests;
        work.hits += hit.number != NO_HIT;
    }
    const double rays = std::max(double(hits.size()), 1.0);
    work.boxTests = double(boxTests) / rays;
    work.primitiveTests = double(primitiveTests) / rays;
    return work;
}

Json measureKind(const std::string& scene, const RaySet& set, const std::vector<Tracer>& tracers, uint32_t rounds,
                 std::vector<TableRow>& table)
{
    std::vector<std::vector<TraceHit>> hits(tracers.size(), std::vector<TraceHit>(set.rays.size()));
    std::vector<Contestant> contestants;
    for (size_t i = 0; i < tracers.size(); i++) {
        auto run = [&, i] { return tracers[i].trace(set, hits[i]); };
        run();  // the first time compiles kernels and touches memory
        contestants.push_back({tracers[i].name, run});
    }
    const std::vector<Timing> timings = runRounds(contestants, rounds);
    const Work work = workOf(hits[0]);
    Json json = {{"scene", scene},
                 {"kind", set.kind},
                 {"rays", set.rays.size()},
                 {"hits", work.hits},
                 {"boxTestsPerRay", work.boxTests},
                 {"primitiveTestsPerRay", work.primitiveTests},
                 {"tracers", Json::array()}};
    for (size_t i = 0; i < timings.size(); i++) {
        const double seconds = timings[i].median();
        const double rate = seconds > 0 ? double(set.rays.size()) / seconds : 0;
        const double ratio = medianRatio(timings.back(), timings[i]);
        json["tracers"].push_back({{"name", timings[i].name},
                                   {"seconds", timings[i].seconds},
                                   {"raysPerSecond", rate},
                                   {"spread", timings[i].spread()},
                                   {"rateToLast", ratio},
                                   {"hits", workOf(hits[i]).hits}});
        const bool counts = i == 0;
        table.push_back({i == 0 ? scene + ", " + set.kind : "", timings[i].name, shortNumber(rate * 1e-6),
                         percent(timings[i].spread()), shortNumber(ratio),
                         counts ? shortNumber(work.boxTests) : "", counts ? shortNumber(work.primitiveTests) : ""});
    }
    return json;
}

}  // namespace

Json benchTraversal(const BenchOptions& options)
{
    const unsigned threads = threadsFor(options.common);
    const uint32_t rounds = options.repeat > 0 ? options.repeat : ROUNDS;
    const std::unique_ptr<Device> device = openDeviceFor(options.common);
    const std::string embree = options.alone ? "" : embreeVersion();
    if (embree.empty() && !options.alone) say("no comparison with Embree: {}\n", whyNoEmbree());
    Json rows = Json::array();
    std::vector<TableRow> table;
    for (Scene& scene : commonScenes(options)) {
        const auto theirs =
            options.alone ? nullptr : makeEmbreeScene(scene.primitives, EmbreeBuild::standard, threads);
        const std::string name = scene.name;
        const PreparedScene prepared = prepareScene(std::move(scene), options.common.bvhBuild, threads);
        device->setScene(prepared.deviceScene());
        std::vector<Tracer> tracers = {{device->info().name, [&](const RaySet& set, std::span<TraceHit> hits) {
                                            return device->traceRays(set.rays, set.anyHit, hits);
                                        }}};
        if (theirs) {
            tracers.push_back({"Embree " + embree, [&](const RaySet& set, std::span<TraceHit> hits) {
                                   return theirs->trace(set.rays, set.anyHit, hits);
                               }});
        }
        for (const RaySet& set : makeRays(prepared.scene, prepared.deviceScene(), options.size, threads)) {
            if (interruptSignal() != 0) break;
            rows.push_back(measureKind(name, set, tracers, rounds, table));
        }
    }
    answer("{} x {} pixels, medians of {} rounds, {} threads\n", options.size, options.size, rounds, threads);
    printTable({"rays", "by", "Mrays/s", "spread", embree.empty() ? "ratio" : "/ Embree", "boxes a ray", "tri. a ray"},
               table);
    return {{"threads", threads}, {"rounds", rounds}, {"size", options.size}, {"rows", rows}};
}

}  // namespace sahl
