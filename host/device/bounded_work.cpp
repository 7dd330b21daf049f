#include "device/bounded_work.h"

#include "device/vulkan_limits.h"
#include "util/error.h"
#include "util/parallel.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

constexpr uint32_t MIN_STEP_BUDGET = 64;     // a driver that cuts fewer steps than that is broken
constexpr uint32_t MAX_CUT_ROUNDS = 64;      // at the smallest budget, without a finished sample
constexpr double SUBMISSION_SECONDS = 0.25;  // watchdogs of real GPUs bite after 2 s
constexpr double SOFTWARE_SUBMISSION_SECONDS = 4;  // nothing waits for these

RoundState inspectPart(std::span<const PixelBlock> blocks, uint32_t sampleCount)
{
    RoundState state;
    for (const PixelBlock& block : blocks) {
        uint32_t done = std::min(block.samplesDone, sampleCount);
        state.samplesMissing = std::max(state.samplesMissing, sampleCount - done);
        state.samplesDone += done;
        state.faults |= block.faults;
    }
    return state;
}

}  // namespace

RoundState stateOf(std::span<const PixelBlock> blocks, uint32_t sampleCount, unsigned threads)
{
    constexpr size_t PART = 1 << 16;  // blocks
    std::vector<RoundState> parts((blocks.size() + PART - 1) / PART);
    parallelFor(parts.size(), threads, [&](size_t i) {
        parts[i] = inspectPart(blocks.subspan(i * PART, std::min(PART, blocks.size() - i * PART)), sampleCount);
    });
    RoundState state;
    for (const RoundState& part : parts) {
        state.samplesMissing = std::max(state.samplesMissing, part.samplesMissing);
        state.samplesDone += part.samplesDone;
        state.faults |= part.faults;
    }
    return state;
}

BoundedWork::BoundedWork(const PhysicalDevice& device, uint32_t stepBudget,
                         DeviceStatistics& statistics)
    : device_(device.name),
      statistics_(statistics),
      submissionSeconds_(device.kind == "software" ? SOFTWARE_SUBMISSION_SECONDS : SUBMISSION_SECONDS)
{
    statistics_.stepBudget = stepBudget > 0 ? stepBudget : defaultStepBudget(device);
    minStepBudget_ = std::min(MIN_STEP_BUDGET, statistics_.stepBudget);
}

void BoundedWork::finish(const BoundedTask& task, RoundState state,
                         const std::function<RoundState(uint32_t samples)>& runRound)
{
    beginRounds();
    if (state.samplesMissing > 0 && state.faults != 0) handleFaults(task, state.faults);
    while (state.samplesMissing > 0) {
        uint64_t before = state.samplesDone;
        uint64_t dispatches = statistics_.dispatches;
        state = runRound(state.samplesMissing);
        dispatches = statistics_.dispatches - dispatches;
        statistics_.resumptions += dispatches;
        noteRound(task, before, state, dispatches * statistics_.stepBudget);
    }
}

void BoundedWork::beginRounds()
{
    cutRounds_ = 0;
    idleSteps_ = 0;
}

void BoundedWork::noteRound(const BoundedTask& task, uint64_t doneBefore, const RoundState& state, uint64_t steps)
{
    if (state.samplesDone > doneBefore) cutRounds_ = 0;
    bool progress = state.samplesDone > doneBefore || state.faults != 0;
    idleSteps_ = progress ? 0 : idleSteps_ + steps;
    if (idleSteps_ > task.stepsPerSample && idleSteps_ - task.stepsPerSample > statistics_.stepBudget)
        throw Error(ErrorKind::deviceLost,
                    fmt::format("{}: '{}' makes no progress: {} steps for each path and none "
                                "ended, though {} are enough for any; the driver does not "
                                "compute what it was given, try --device cpu",
                                task.name, device_, idleSteps_, task.stepsPerSample));
    if (state.samplesMissing > 0 && state.faults != 0) handleFaults(task, state.faults);
}

/// Counts a retry and halves the step budget. Throws deviceLost when that does not help any more.
void BoundedWork::handleFaults(const BoundedTask& task, uint32_t faults)
{
    if (faults & FAULT_STACK_OVERFLOW)
        throw Error(ErrorKind::deviceLost,
                    fmt::format("{}: on '{}' a traversal overflowed its stack of {} entries, which "
                                "the tree's depth rules out; the driver does not compute what it "
                                "was given, try --device cpu",
                                task.name, device_, task.stackSize));
    statistics_.retries++;
    if (statistics_.stepBudget > minStepBudget_) {
        statistics_.stepBudget = std::max(statistics_.stepBudget / 2, minStepBudget_);
        return;
    }
    if (++cutRounds_ > MAX_CUT_ROUNDS)
        throw Error(ErrorKind::deviceLost,
                    fmt::format("{}: '{}' ends loops before their end even at {} steps a dispatch, "
                                "so nothing can be computed on it; try --device cpu",
                                task.name, device_, statistics_.stepBudget));
}

void BoundedWork::runInParts(uint64_t pixels, uint32_t samples,
                             const std::function<void(uint32_t, bool, bool)>& submit)
{
    for (uint32_t done = 0; done < samples;) {
        double fit =
            secondsPerPixel_ > 0 ? submissionSeconds_ / (secondsPerPixel_ * double(pixels)) : 1;
        auto count = static_cast<uint32_t>(std::clamp(fit, 1.0, double(samples - done)));
        auto start = std::chrono::steady_clock::now();
        submit(count, done == 0, done + count == samples);
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        noteSubmission(pixels, count, seconds.count());
        done += count;
    }
}

bool BoundedWork::fitOneSubmission(uint64_t pixels, uint32_t samples) const
{
    return secondsPerPixel_ > 0 && secondsPerPixel_ * double(pixels) * samples <= submissionSeconds_;
}

void BoundedWork::noteSubmission(uint64_t pixels, uint32_t samples, double seconds)
{
    secondsPerPixel_ = seconds / (double(pixels) * samples);
}

}  // namespace sahl
