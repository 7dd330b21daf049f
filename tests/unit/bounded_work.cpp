// What is known to fit one submission, by what others took.
#include "device/bounded_work.h"

#include <gtest/gtest.h>

namespace sahl {
namespace {

TEST(BoundedWork, fitsASubmissionOnceItIsKnownToBeShortEnough)
{
    PhysicalDevice device = {};
    device.kind = "discrete";
    DeviceStatistics statistics;
    BoundedWork work(device, 0, statistics);
    EXPECT_FALSE(work.fitOneSubmission(1, 1)) << "nothing is known yet";
    work.noteSubmission(1000, 8, 0.1);  // aimed at is 0.25 s
    EXPECT_TRUE(work.fitOneSubmission(1000, 8));
    EXPECT_TRUE(work.fitOneSubmission(2400, 8));
    EXPECT_FALSE(work.fitOneSubmission(2600, 8));
    EXPECT_TRUE(work.fitOneSubmission(2600, 4));
    work.noteSubmission(1000, 8, 0.3);
    EXPECT_FALSE(work.fitOneSubmission(1000, 8)) << "the newest counts";
}

TEST(BoundedWork, stateOfBlocksIsTheSameForAnyNumberOfThreads)
{
    std::vector<PixelBlock> blocks(200000, PixelBlock{});
    for (PixelBlock& block : blocks) block.samplesDone = 5;
    blocks[150000].samplesDone = 3;
    blocks[199999].faults = FAULT_LOOP_CUT;
    blocks[7].samplesDone = 8;  // more than is asked for counts as that
    for (unsigned threads : {1u, 3u}) {
        const RoundState state = stateOf(blocks, 5, threads);
        EXPECT_EQ(state.samplesMissing, 2u);
        EXPECT_EQ(state.samplesDone, 5u * 200000 - 2);
        EXPECT_EQ(state.faults, FAULT_LOOP_CUT);
    }
}

}  // namespace
}  // namespace sahl
