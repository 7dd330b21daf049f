// sahl bench render: whole paths of the common work, by the device, by the CPU and by a small path tracer
// on Embree's single rays, in turns.

#include "app/bench/bench.h"
#include "app/bench/embree_paths.h"
#include "app/bench/rounds.h"
#include "app/bench/scenes.h"
#include "app/bench/table.h"
#include "render/render.h"
#include "util/interrupt.h"
#include "util/messages.h"

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t ROUNDS = 5;

/// What a renderer made of the scene the last time.
struct Picture {
    double mean = 0;           ///< of all values
    double raysPerSample = 0;
};

Picture pictureOf(const Film& film)
{
    double sum = 0;
    for (const auto& half : film.half) {
        for (const HalfPixel& pixel : half)
            for (const Fixed64x64& channel : pixel.sum) sum += channel.toDouble();
    }
    const Counters& counted = film.counters;
    const auto samples = double(counted.cameraRays);
    return {sum / (3 * samples), double(counted.cameraRays + counted.indirectRays + counted.shadowRays) / samples};
}

double renderOn(Device& device, const BenchOptions& options, uint32_t spp, Picture& picture)
{
    RenderPlan plan;
    plan.width = plan.height = options.size;
    plan.sampleCount = spp;
    plan.tileSize = options.common.tileSize;
    plan.threads = threadsFor(options.common);
    const RenderResult result = renderPicture(device, plan, [](const RenderProgress&) {});
    picture = pictureOf(result.film);
    return result.seconds;
}

}  // namespace

Json benchRender(const BenchOptions& options)
{
    const unsigned threads = threadsFor(options.common);
    const uint32_t rounds = options.repeat > 0 ? options.repeat : ROUNDS;
    std::vector<std::unique_ptr<Device>> devices;
    devices.push_back(openDeviceFor(options.common));
    if (!options.alone && devices[0]->info().kind != "cpu")
        devices.push_back(makeCpuDevice(options.common.deviceOptions));
    const std::string embree = options.alone ? "" : embreeVersion();
    if (embree.empty() && !options.alone) say("no comparison with Embree: {}\n", whyNoEmbree());

    Json rows = Json::array();
    std::vector<TableRow> table;
    for (Scene& scene : commonScenes(options)) {
        if (interruptSignal() != 0) break;
        const auto theirs =
            options.alone ? nullptr : makeEmbreeScene(scene.primitives, EmbreeBuild::standard, threads);
        const std::string name = scene.name;
        const PreparedScene prepared = prepareScene(std::move(scene), options.common.bvhBuild, threads);
        std::vector<Contestant> contestants;
        std::vector<Picture> pictures(devices.size() + 1);
        for (size_t i = 0; i < devices.size(); i++) {
            devices[i]->setScene(prepared.deviceScene());
            renderOn(*devices[i], options, 1, pictures[i]);  // compiles kernels
            contestants.push_back({devices[i]->info().name,
                                   [&, i] { return renderOn(*devices[i], options, options.spp, pictures[i]); }});
        }
        if (theirs) {
            contestants.push_back({"paths on Embree " + embree, [&] {
                                       const EmbreePaths made =
                                           renderOnEmbree(*theirs, prepared.scene, options.spp, threads);
                                       pictures.back() = {made.mean, made.raysPerSample};
                                       return made.seconds;
                                   }});
        }
        const std::vector<Timing> timings = runRounds(contestants, rounds);
        const double samples = double(options.size) * options.size * options.spp;
        for (size_t i = 0; i < timings.size(); i++) {
            const Timing& timing = timings[i];
            const Picture& picture = i < devices.size() ? pictures[i] : pictures.back();
            const double rate = timing.median() > 0 ? samples / timing.median() : 0;
            const double ratio = medianRatio(timings.back(), timing);
            rows.push_back({{"scene", name},
                            {"renderer", timing.name},
                            {"seconds", timing.seconds},
                            {"samplesPerSecond", rate},
                            {"spread", timing.spread()},
                            {"rateToLast", ratio},
                            {"raysPerSample", picture.raysPerSample},
                            {"mean", picture.mean}});
            table.push_back({i == 0 ? name : "", timing.name, shortNumber(rate * 1e-6), percent(timing.spread()),
                             shortNumber(ratio), fmt::format("{:.3f}", picture.raysPerSample),
                             fmt::format("{:.5f}", picture.mean)});
        }
    }
    answer("{} x {} pixels, {} samples each, medians of {} rounds, {} threads\n", options.size, options.size,
           options.spp, rounds, threads);
    printTable({"scene", "by", "Msamples/s", "spread", embree.empty() ? "ratio" : "/ Embree", "rays a sample", "mean"},
               table);
    return {{"threads", threads}, {"rounds", rounds}, {"size", options.size}, {"spp", options.spp}, {"rows", rows}};
}

}  // namespace sahl
