// Work on a Vulkan device is bounded: an invocation takes so many steps a dispatch and no more, a
// submission so much time; what is left is dispatched again, and drivers that get nowhere are given
// up.
#pragma once

#include "device/device.h"
#include "vulkan/physical_device.h"

#include <functional>

namespace sahl {

/// What the blocks of the pixels at work say after a round of dispatches.
struct RoundState {
    uint32_t samplesMissing = 0;  ///< of the pixel that lacks most
    uint64_t samplesDone = 0;     ///< of all pixels
    uint32_t faults = 0;          ///< FAULT_* of any pixel
};

/// What the blocks of a tile say after a round of dispatches.
RoundState stateOf(std::span<const PixelBlock> blocks, uint32_t sampleCount, unsigned threads);

/// Work of which every pixel gets its samples.
struct BoundedTask {
    std::string name;             ///< for messages
    uint64_t stepsPerSample = 0;  ///< that no sample can need more of
    uint32_t stackSize = 0;
};

class BoundedWork {
public:
    /// `stepBudget` 0: as fits the device. Counts in `statistics`, which must outlive this.
    BoundedWork(const PhysicalDevice& device, uint32_t stepBudget, DeviceStatistics& statistics);

    /// Goes on from `state` until no sample is missing: paths that ran out of steps go on, pixels
    /// in which a loop was cut go again with fewer steps. Throws deviceLost when that does not
    /// help.
    ///   runRound(n)  gives every pixel up to n samples, in submissions as below
    void finish(const BoundedTask& task, RoundState state,
                const std::function<RoundState(uint32_t samples)>& runRound);

    /// For who runs rounds alone: before the first of them, and after each with the samples that were done before it
    /// and the steps that it gave every path under way. Lowers the step budget and throws as finish() does.
    void beginRounds();
    void noteRound(const BoundedTask& task, uint64_t doneBefore, const RoundState& state, uint64_t steps);

    /// Calls submit(n, isFirst, isLast) so that the n add up to `samples` and no call takes much longer
    /// than a watchdog would stand.
    void runInParts(uint64_t pixels, uint32_t samples,
                    const std::function<void(uint32_t count, bool isFirst, bool isLast)>& submit);

    /// Whether that many samples of so many pixels are known to fit one submission.
    bool fitOneSubmission(uint64_t pixels, uint32_t samples) const;

    /// For who submits by itself: how long that took [s].
    void noteSubmission(uint64_t pixels, uint32_t samples, double seconds);

private:
    void handleFaults(const BoundedTask& task, uint32_t faults);

    std::string device_;  // its name
    DeviceStatistics& statistics_;
    uint32_t minStepBudget_;
    double submissionSeconds_;    // aimed at
    double secondsPerPixel_ = 0;  // of one sample, as last measured; 0 before the first
    uint32_t cutRounds_ = 0;      // in a row, at the smallest step budget
    uint64_t idleSteps_ = 0;      // offered since the last sample was finished
};

}  // namespace sahl
