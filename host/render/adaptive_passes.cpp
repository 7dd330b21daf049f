#include "render/adaptive_passes.h"

#include "device/adaptive_schedule.h"

#include <algorithm>

namespace sahl {

namespace {

AdaptiveRule onSampler(AdaptiveRule rule, const Device& device)
{
    rule.overBlocks = device.samplerKind() == SAMPLER_SOBOL ? 1 : 0;
    return rule;
}

/// The upper one of two in the middle.
float floorOf(std::vector<float> luminances)
{
    if (luminances.empty()) return 0;
    auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::ranges::nth_element(luminances, middle);
    const float leastY = *middle * 0.01f;
    return leastY < 1e-30f ? 0.0f : leastY;  // as flushed() in the text
}

}  // namespace

AdaptiveFloors floorsOf(std::span<const PixelEstimate> estimates)
{
    std::vector<float> ofA, ofB;
    for (const PixelEstimate& estimate : estimates) {
        ofA.push_back(estimate.luminanceA);
        ofB.push_back(estimate.luminanceB);
    }
    return {floorOf(std::move(ofA)), floorOf(std::move(ofB))};
}

AdaptivePasses::AdaptivePasses(Device& device, const AdaptiveWindow& window,
                               std::span<const TileRequest> tiles, const AdaptiveRule& rule)
    : rule_(onSampler(rule, device)),
      estimates_(looksAtNeighbours(rule) ? size_t{window.width} * window.height : 0),
      picture_(device.beginAdaptive(window, rule_))
{
    for (const TileRequest& tile : tiles) {
        tiles_.push_back({tile, picture_->beginTile(tile), tile.width * tile.height, 0});
    }
}

bool AdaptivePasses::isFinished() const
{
    return std::ranges::all_of(tiles_, [](const TileInWork& work) { return work.active == 0; });
}

bool AdaptivePasses::runPass(const std::function<bool()>& beforeTile,
                             const std::function<void(const TileInWork&, uint32_t activeBefore,
                                                      const AdaptivePass&)>& tileDone)
{
    for (TileInWork& work : tiles_) {
        if (work.active == 0) continue;
        if (!beforeTile()) return false;
        const uint32_t before = work.active;
        const AdaptivePass pass = work.tile->runPass();
        work.active = pass.activePixels;
        work.passes++;
        tileDone(work, before, pass);
    }
    passes_++;
    if (decisionIsDue(rule_, passes_)) decide();
    return true;
}

/// Takes the floors from what is known at the first decision.
void AdaptivePasses::decide()
{
    if (!estimates_.empty()) {
        picture_->readEstimates(estimates_);
        floors_ = floorsOf(estimates_);
        estimates_ = {};
    }
    for (TileInWork& work : tiles_) {
        if (work.active > 0) work.active = work.tile->decide(floors_);
    }
}

}  // namespace sahl
