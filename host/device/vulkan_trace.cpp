#include "device/vulkan_trace.h"

#include "device/vulkan_limits.h"
#include "shared/bindings.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sahl {

namespace {

/// Rays in flight at a time: enough to fill any device, few enough that the state of all of them
/// fits one storage buffer and one dispatch.
uint64_t raysAtOnce(const TraceHost& host)
{
    const VkPhysicalDeviceLimits& limits = host.context.physical.properties.limits;
    uint64_t range =
        std::min<uint64_t>(limits.maxStorageBufferRange, host.context.physical.maxAllocationBytes);
    uint64_t invocations = uint64_t{limits.maxComputeWorkGroupCount[0]} * host.groupSize;
    const uint64_t wanted = bufferShare(host.context.physical, sizeof(SuspendedWalk), 1u << 22);
    constexpr uint32_t TEXELS_PER_RAY = sizeof(TraceRay) / 16;
    const uint64_t texels = host.scene.texel ? limits.maxTexelBufferElements / TEXELS_PER_RAY : wanted;
    return std::min({wanted, texels, range / sizeof(SuspendedWalk), invocations});
}

/// The buffers of the rays in flight.
struct TraceBuffers {
    Buffer rays, hits, walks;
};

TraceBuffers makeBuffers(Context& context, uint64_t count, SceneReads reads)
{
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    return {createBuffer(context, {"rays", count * sizeof(TraceRay), usageFor(raysType(reads)), HostUse::upload}),
            createBuffer(context, {"hits", count * sizeof(TraceHit), usage, HostUse::readBack}),
            createBuffer(context, {"walks", count * sizeof(SuspendedWalk), usage, HostUse::none})};
}

void bindAll(const TraceHost& host, const TraceBuffers& buffers)
{
    std::array<const Buffer*, BINDING_RAY_WALKS + 1> all = {};
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++) all[i] = &host.scene.arrays[i];
    all[BINDING_FRAME] = &host.scene.frame;
    all[BINDING_RAYS] = &buffers.rays;
    all[BINDING_RAY_HITS] = &buffers.hits;
    all[BINDING_RAY_WALKS] = &buffers.walks;
    bindBuffers(host.context, host.pipeline.get(), all);
}

RoundState inspect(std::span<const TraceHit> hits)
{
    RoundState state;
    for (const TraceHit& hit : hits) {
        if (hit.status == TRACE_DONE)
            state.samplesDone++;
        else
            state.samplesMissing = 1;
        state.faults |= hit.faults;
    }
    return state;
}

enum class Repeat { goesOn, beginsAgain };

/// Runs dispatches, of which each after the first goes on with the walks or begins them again, and waits for them.
/// Returns the seconds that this took [s].
double submit(const TraceHost& host, const std::string& name, TraceDispatch job, uint32_t dispatches,
              Repeat repeat)
{
    const uint32_t groups = (job.rayCount + host.groupSize - 1) / host.groupSize;
    auto start = std::chrono::steady_clock::now();
    runCommands(host.context, name, [&](VkCommandBuffer commands) {
        for (uint32_t i = 0; i < dispatches; i++) {
            recordDispatch(commands, host.pipeline.get(), std::as_bytes(std::span(&job, 1)),
                           {groups, 1, 1});
            recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
            if (repeat == Repeat::goesOn) job.begin = 0;
        }
    });
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    host.statistics.dispatches += dispatches;
    return seconds.count();
}

/// Seconds of one dispatch among many: a graphics card that had nothing to do takes a while to its full speed.
double steadySeconds(const TraceHost& host, const std::string& name, const TraceDispatch& job)
{
    constexpr double LEAST_SECONDS = 0.05;  // far below what watchdogs allow
    constexpr uint32_t MOST_DISPATCHES = 1 << 14;
    for (uint32_t dispatches = 1;;) {
        const double seconds = submit(host, name, job, dispatches, Repeat::beginsAgain);
        if (seconds >= LEAST_SECONDS || dispatches >= MOST_DISPATCHES) return seconds / dispatches;
        const double factor = std::clamp(1.2 * LEAST_SECONDS / seconds, 1.5, 8.0);
        dispatches = static_cast<uint32_t>(std::ceil(dispatches * factor));
    }
}

}  // namespace

double traceRaysOnVulkan(const TraceHost& host, std::span<const TraceRay> rays, bool anyHit,
                         std::span<TraceHit> hits)
{
    double seconds = 0;
    const uint64_t atOnce = std::min<uint64_t>(raysAtOnce(host), rays.size());
    TraceBuffers buffers = makeBuffers(host.context, atOnce, sceneReads(host.context.physical, host.scene.texel));
    bindAll(host, buffers);
    for (size_t first = 0; first < rays.size(); first += atOnce) {
        const size_t count = std::min(rays.size() - first, atOnce);
        const std::span<TraceHit> found = hits.subspan(first, count);
        const std::string name = fmt::format("trace rays {} to {}", first, first + count - 1);
        writeBuffer(host.context, buffers.rays, std::as_bytes(rays.subspan(first, count)));

        double secondsOfBatch = 0;
        const uint64_t resumptions = host.statistics.resumptions;
        auto jobOf = [&](bool begin) {
            return TraceDispatch{static_cast<uint32_t>(count), anyHit, host.statistics.stepBudget, begin};
        };
        auto runRound = [&](uint32_t dispatches, bool begin) {
            secondsOfBatch += submit(host, name, jobOf(begin), dispatches, Repeat::goesOn);
            runCommands(host.context, name, [&](VkCommandBuffer commands) {
                recordReadBack(commands, buffers.hits, found.size_bytes());
            });
            readBuffer(buffers.hits, std::as_writable_bytes(found));
            return inspect(found);
        };
        host.work.finish({name, host.scene.stepsPerSample, host.stackSize}, runRound(1, true),
                         [&](uint32_t dispatches) {
                             if (host.pipeline.resume()) bindAll(host, buffers);
                             return runRound(dispatches, false);
                         });
        const bool inOneGo = host.statistics.resumptions == resumptions;
        if (host.context.physical.kind != "software" && inOneGo)
            secondsOfBatch = steadySeconds(host, name, jobOf(true));
        seconds += secondsOfBatch;
    }
    return seconds;
}

}  // namespace sahl
