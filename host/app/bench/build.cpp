// sahl bench build: how long trees take, and how good they are: by tests that diffuse rays need, counted by
// our traversal, also in a tree that Embree's builder of high quality made.

#include "app/bench/bench.h"
#include "app/bench/embree.h"
#include "app/bench/rays.h"
#include "app/bench/rounds.h"
#include "app/bench/scenes.h"
#include "app/bench/table.h"
#include "util/interrupt.h"
#include "util/messages.h"

#include <chrono>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t ROUNDS = 5;

struct Builder {
    std::string name;
    std::function<double(std::span<const Primitive>, Bvh& tree)> build;  ///< returns [s]; the tree may stay empty
    bool isEmbree = false;
};

Builder ownBuilder(const std::string& name, BvhBuild build, unsigned threads)
{
    return {name, [build, threads](std::span<const Primitive> primitives, Bvh& tree) {
                tree = {};
                const auto start = std::chrono::steady_clock::now();
                tree = buildBvh(primitives, build, threads);
                const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
                return seconds.count();
            }};
}

Builder embreeBuilder(const std::string& name, EmbreeBuild build, unsigned threads)
{
    return {name,
            [build, threads](std::span<const Primitive> primitives, Bvh& tree) {
                if (build == EmbreeBuild::high && tree.primitives.empty()) tree = embreeTree(primitives, threads);
                return makeEmbreeScene(primitives, build, threads)->buildSeconds();
            },
            true};
}

/// Tests that one ray needs on average.
struct TestsPerRay {
    double boxes = 0, primitives = 0;
};

/// In the binary tree, or in the wide one that is made from it.
TestsPerRay countTests(const DeviceScene& scene, const Bvh& tree, bool asWide, const RaySet& set, unsigned threads)
{
    DeviceScene changed = scene;
    changed.nodes = tree.nodes;
    changed.primitives = tree.primitives;
    changed.frame.rootRef = tree.rootRef;
    changed.treeDepth = tree.statistics.depth;
    changed.wide = {};  // the wide tree was made of another one
    WideTrees wide;
    if (asWide) {
        wide = widen(tree.nodes, {}, tree.rootRef, reachOf(scene.frame.camera));
        changed.wide = {wide.nodes, {}, wide.rootRef, wide.gridAt, wide.gridScale, wide.worstPending,
                        wide.worstGroups};
    }
    DeviceOptions options;
    options.threads = threads;
    const std::unique_ptr<Device> device = makeCpuDevice(options);
    device->setScene(changed);
    std::vector<TraceHit> hits(set.rays.size());
    device->traceRays(set.rays, set.anyHit, hits);
    uint64_t boxes = 0, primitives = 0;
    for (const TraceHit& hit : hits) {
        boxes += hit.boxTests;
        primitives += hit.primitiveTests;
    }
    const double rays = std::max(double(set.rays.size()), 1.0);
    return {double(boxes) / rays, double(primitives) / rays};
}

}  // namespace

Json benchBuild(const BenchOptions& options)
{
    const unsigned threads = threadsFor(options.common);
    const uint32_t rounds = options.repeat > 0 ? options.repeat : ROUNDS;
    std::vector<Builder> builders = {ownBuilder("sweep", BvhBuild::sweep, threads),
                                     ownBuilder("binned", BvhBuild::binned, threads),
                                     ownBuilder("high", BvhBuild::high, threads)};
    const std::string embree = embreeVersion();
    if (embree.empty()) {
        say("no comparison with Embree: {}\n", whyNoEmbree());
    } else {
        builders.push_back(embreeBuilder("Embree " + embree + ", high quality", EmbreeBuild::high, threads));
        builders.push_back(embreeBuilder("Embree " + embree, EmbreeBuild::standard, threads));
    }

    Json rows = Json::array();
    std::vector<TableRow> table;
    for (Scene& scene : commonScenes(options)) {
        const std::string name = scene.name;
        const std::vector<Primitive> primitives = scene.primitives;
        const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, threads);
        const RaySet diffuse = makeRays(prepared.scene, prepared.deviceScene(), options.size, threads).back();
        std::vector<Bvh> trees(builders.size());
        std::vector<Contestant> contestants;
        for (size_t i = 0; i < builders.size(); i++)
            contestants.push_back({builders[i].name, [&, i] { return builders[i].build(primitives, trees[i]); }});
        const std::vector<Timing> timings = runRounds(contestants, rounds);
        if (interruptSignal() != 0) break;
        for (size_t i = 0; i < timings.size(); i++) {
            const double ratio = medianRatio(timings[i], timings.back());
            Json row = {{"scene", name},
                        {"triangles", primitives.size()},
                        {"builder", timings[i].name},
                        {"seconds", timings[i].seconds},
                        {"medianSeconds", timings[i].median()},
                        {"spread", timings[i].spread()},
                        {"timeToLast", ratio}};
            TableRow line = {i == 0 ? name : "", timings[i].name, shortNumber(timings[i].median()),
                             percent(timings[i].spread()), shortNumber(ratio)};
            if (trees[i].primitives.empty()) {
                line.insert(line.end(), {"", "", "", ""});
            } else {
                const DeviceScene device = prepared.deviceScene();
                const TestsPerRay tests = countTests(device, trees[i], false, diffuse, threads);
                const TestsPerRay wide = countTests(device, trees[i], true, diffuse, threads);
                row["boxTestsPerRay"] = tests.boxes;
                row["wideBoxTestsPerRay"] = wide.boxes;
                row["primitiveTestsPerRay"] = tests.primitives;
                row["depth"] = trees[i].statistics.depth;
                if (!builders[i].isEmbree) row["sahCost"] = trees[i].statistics.sahCost;
                line.insert(line.end(), {shortNumber(tests.boxes), shortNumber(wide.boxes), shortNumber(tests.primitives),
                                         std::to_string(trees[i].statistics.depth)});
            }
            rows.push_back(row);
            table.push_back(line);
        }
    }
    answer("medians of {} rounds, {} threads; tests are those of diffuse rays\n", rounds, threads);
    printTable({"scene", "builder", "seconds", "spread", embree.empty() ? "ratio" : "/ Embree", "boxes a ray",
                "wide", "tri. a ray", "depth"},
               table);
    return {{"threads", threads}, {"rounds", rounds}, {"rows", rows}};
}

}  // namespace sahl
