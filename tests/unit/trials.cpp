// The fastest of several ways to compute a picture is only taken if it is right.
#include "render/trials.h"

#include "support/forwarding_device.h"
#include "support/render_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

constexpr uint32_t WIDTH = 12, HEIGHT = 9;
constexpr TileRequest TILE = {0, 0, WIDTH, HEIGHT, 0, BLOCK_SIZE};

/// Says how long a picture took, and counts one box test too many for a pixel of the picture of that number.
struct Slow : ForwardingDevice {
    Slow(double seconds, int wrong) : secondsOfAPicture(seconds), wrongPicture(wrong)
    {
        inner = makeCpuDevice({});
    }
    void render(const TileRequest& tile, std::span<PixelBlock> blocks) override
    {
        inner->render(tile, blocks);
        if (++pictures == wrongPicture) blocks[7].boxTests++;
    }
    DeviceStatistics statistics() const override
    {
        DeviceStatistics statistics;
        statistics.renderSeconds = pictures * secondsOfAPicture;
        return statistics;
    }
    double secondsOfAPicture;
    int wrongPicture;
    int pictures = 0;
};

const PreparedScene& scene()
{
    static const PreparedScene prepared =
        prepareScene(builtInScene(smallPicture(WIDTH, HEIGHT, BLOCK_SIZE)), BvhBuild::sweep, 2);
    return prepared;
}

std::vector<PixelBlock> reference()
{
    std::vector<PixelBlock> blocks(WIDTH * HEIGHT);
    const auto cpu = makeCpuDevice({});
    cpu->setScene(scene().deviceScene());
    cpu->render(TILE, blocks);
    return blocks;
}

Trial trialOf(const std::string& name, double seconds, int wrongPicture = 0)
{
    Trial trial = {name, std::make_unique<Slow>(seconds, wrongPicture)};
    trial.device->setScene(scene().deviceScene());
    return trial;
}

std::vector<Trial> tried(std::vector<Trial> trials)
{
    runTrials(trials, TILE, reference(), 3);
    return trials;
}

template <class... Trials>
std::vector<Trial> listOf(Trials... trials)
{
    std::vector<Trial> list;
    (list.push_back(std::move(trials)), ...);
    return list;
}

TEST(Trials, areWonByTheFastest)
{
    const std::vector<Trial> trials = tried(listOf(trialOf("slow", 2), trialOf("fast", 0.5), trialOf("middle", 1)));
    EXPECT_EQ(fastestRight(trials)->name, "fast");
    EXPECT_EQ(trials[0].seconds, std::vector<double>(3, 2.0)) << "the round that makes kernels does not count";
    EXPECT_DOUBLE_EQ(medianSeconds(trials[1]), 0.5);
}

TEST(Trials, areNotWonByOneThatWasWrongInAnyRound)
{
    for (int picture : {1, 2, 4}) {
        const std::vector<Trial> trials = tried(listOf(trialOf("right", 2), trialOf("wrong", 1, picture)));
        EXPECT_EQ(fastestRight(trials)->name, "right") << picture;
        EXPECT_EQ(trials[1].wrongPixels, 1u) << picture;
        EXPECT_FALSE(trials[1].isRight()) << picture;
        EXPECT_TRUE(trials[0].isRight()) << picture;
    }
}

TEST(Trials, areWonByNobodyWhereAllAreWrong)
{
    const std::vector<Trial> trials = tried(listOf(trialOf("one", 2, 3), trialOf("another", 1, 1)));
    EXPECT_EQ(fastestRight(trials), nullptr);
}

}  // namespace
}  // namespace sahl::testing
