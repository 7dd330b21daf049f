#include "app/stats.h"

#include "bvh/build_names.h"
#include "film/fireflies.h"
#include "sahl_version.h"

#include <algorithm>

#include <sys/resource.h>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

double perSecond(uint64_t count, double seconds)
{
    return seconds > 0 ? double(count) / seconds : 0;
}

/// Work of the rays of all samples of a pixel: mean over the pixels, and most.
Json pixelsJson(const Film& film)
{
    PixelWork most;
    for (const PixelWork& pixel : film.work) {
        most.boxTests = std::max(most.boxTests, pixel.boxTests);
        most.primitiveTests = std::max(most.primitiveTests, pixel.primitiveTests);
    }
    const double pixels = std::max(double(film.work.size()), 1.0);
    return {{"nodeVisitsMean", double(film.counters.boxTests / 2) / pixels},
            {"nodeVisitsMax", most.boxTests / 2},
            {"primitiveTestsMean", double(film.counters.primitiveTests) / pixels},
            {"primitiveTestsMax", most.primitiveTests}};
}

/// Number and weight of the fireflies, and where the worst are.
Json firefliesJson(const Film& film)
{
    constexpr size_t MOST_LISTED = 16;
    const std::vector<Firefly> fireflies = firefliesOf(film);
    Json worst = Json::array();
    for (const Firefly& firefly : fireflies) {
        if (worst.size() == MOST_LISTED) break;
        worst.push_back({{"x", firefly.x},
                         {"y", firefly.y},
                         {"luminance", firefly.luminance},
                         {"around", firefly.around},
                         {"share", firefly.share}});
    }
    return {
        {"pixels", fireflies.size()}, {"excess", excessShare(film, fireflies)}, {"worst", worst}};
}

}  // namespace

uint64_t peakMemory()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

double Stopwatch::lap()
{
    auto now = std::chrono::steady_clock::now();
    double seconds = std::chrono::duration<double>(now - lap_).count();
    lap_ = now;
    return seconds;
}

double Stopwatch::total() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

Json countersJson(const Counters& counters)
{
    return {{"cameraRays", counters.cameraRays},         {"indirectRays", counters.indirectRays},
            {"shadowRays", counters.shadowRays},         {"boxTests", counters.boxTests},
            {"primitiveTests", counters.primitiveTests}, {"bounces", counters.bounces},
            {"badSamples", counters.badSamples},
            {"clamped", counters.clamped}};
}

Json treeJson(const BvhStatistics& tree)
{
    return {{"build", nameOf(tree.build)},     {"innerNodes", tree.innerNodes},
            {"leaves", tree.leaves},           {"depth", tree.depth},
            {"largestLeaf", tree.largestLeaf}, {"sahCost", tree.sahCost}};
}

Json statisticsJson(const PreparedScene& prepared, const Film& film, Device& device,
                    const StageSeconds& seconds)
{
    const Scene& scene = prepared.scene;
    const DeviceScene arrays = prepared.deviceScene();
    const Counters& counters = film.counters;
    DeviceInfo info = device.info();
    DeviceStatistics work = device.statistics();
    uint64_t rays = counters.cameraRays + counters.indirectRays + counters.shadowRays;
    return {
        {"version", 1},
        {"sahl", SAHL_VERSION},
        {"scene",
         {{"name", scene.name},
          {"primitives", arrays.primitives.size()},
          {"primitivesSeen", prepared.bvh.statistics.primitivesSeen},
          {"instances", arrays.instances.size()},
          {"droppedTriangles", scene.droppedTriangles},
          {"materials", arrays.materials.size()},
          {"lights", arrays.frame.lightCount},
          {"width", scene.settings.width},
          {"height", scene.settings.height},
          {"maxBounces", scene.settings.maxBounces},
          {"seed", scene.settings.seed}}},
        {"tree", treeJson(prepared.bvh.statistics)},
        {"device",
         {{"name", info.name},
          {"driver", info.driver},
          {"kind", info.kind},
          {"texelBuffers", work.texelBuffers},
          {"variant", work.variant},
          {"exactMath", work.exactMath},
          {"walksWatched", work.walksWatched},
          {"sceneBytes", work.sceneBytes},
          {"pipelines", work.pipelines},
          {"dispatches", work.dispatches},
          {"resumptions", work.resumptions},
          {"retries", work.retries},
          {"stepBudget", work.stepBudget}}},
        {"counters", countersJson(counters)},
        {"pixels", pixelsJson(film)},
        {"fireflies", firefliesJson(film)},
        {"seconds",
         {{"load", seconds.load},
          {"build", seconds.build},
          {"upload", seconds.upload},
          {"firstHits", seconds.firstHits},
          {"firstSample", seconds.firstSample},
          {"render", seconds.render},
          {"write", seconds.write},
          {"total", seconds.total}}},
        {"rates",
         {{"samplesPerSecond", perSecond(counters.cameraRays, seconds.render)},
          {"raysPerSecond", perSecond(rays, seconds.render)},
          {"cameraRaysPerSecond", perSecond(counters.cameraRays, seconds.render)},
          {"indirectRaysPerSecond", perSecond(counters.indirectRays, seconds.render)},
          {"shadowRaysPerSecond", perSecond(counters.shadowRays, seconds.render)},
          {"raysPerSample",
           counters.cameraRays > 0 ? double(rays) / double(counters.cameraRays) : 0},
          {"boxTestsPerRay", rays > 0 ? double(counters.boxTests) / double(rays) : 0},
          {"primitiveTestsPerRay", rays > 0 ? double(counters.primitiveTests) / double(rays) : 0}}},
        {"filmBytes", filmBytes(film.width, film.height, film.replicateSize)},
        {"peakMemoryBytes", peakMemory()},
    };
}

}  // namespace sahl
