#include "render/trials.h"

#include "render/verify.h"

#include <algorithm>

namespace sahl {

namespace {

void run(Trial& trial, const TileRequest& tile, std::span<const PixelBlock> expected)
{
    std::vector<PixelBlock> blocks(expected.size());
    const double before = trial.device->statistics().renderSeconds;
    trial.device->render(tile, blocks);
    trial.seconds.push_back(trial.device->statistics().renderSeconds - before);

    uint32_t wrong = 0;
    for (size_t i = 0; i < blocks.size(); i++) wrong += sameBits(blocks[i], expected[i]) ? 0 : 1;
    trial.wrongPixels = std::max(trial.wrongPixels, wrong);
}

}  // namespace

void runTrials(std::span<Trial> trials, const TileRequest& tile, std::span<const PixelBlock> expected, int rounds)
{
    for (Trial& trial : trials) {
        run(trial, tile, expected);
        trial.seconds.clear();
    }
    for (int round = 0; round < rounds; round++)
        for (Trial& trial : trials) run(trial, tile, expected);
}

double medianSeconds(const Trial& trial)
{
    std::vector<double> values = trial.seconds;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

const Trial* fastestRight(std::span<const Trial> trials)
{
    const Trial* best = nullptr;
    for (const Trial& trial : trials)
        if (trial.isRight() && (best == nullptr || medianSeconds(trial) < medianSeconds(*best))) best = &trial;
    return best;
}

}  // namespace sahl
