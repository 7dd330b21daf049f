// Tiles under adaptive sampling that go through passes together, and the decisions between two
// passes.
#pragma once

#include "device/device.h"

#include <functional>
#include <span>

namespace sahl {

struct TileInWork {
    TileRequest request;  ///< in the full picture
    std::unique_ptr<AdaptiveTile> tile;
    uint32_t active = 0;  ///< as AdaptivePass has it
    uint32_t passes = 0;
};

/// 1 % of the picture's median luminance, from each half's pilots or from both together: pixels
/// darker than that need not be better than this one. The same bits everywhere.
AdaptiveFloors floorsOf(std::span<const PixelEstimate> estimates);

class AdaptivePasses {
public:
    /// Begins the tiles, which lie in the window. Rules that look at neighbours want the whole
    /// window in them.
    AdaptivePasses(Device& device, const AdaptiveWindow& window, std::span<const TileRequest> tiles,
                   const AdaptiveRule& rule);

    bool isFinished() const;

    /// One pass of every tile that has active pixels, and the decision where one is due.
    ///   beforeTile  asked before each tile; false ends the pass, and with it the work
    ///   tileDone    told after each tile, with what was active before
    /// Returns whether the pass is whole.
    bool runPass(const std::function<bool()>& beforeTile,
                 const std::function<void(const TileInWork&, uint32_t activeBefore,
                                          const AdaptivePass&)>& tileDone);

    std::span<const TileInWork> tiles() const { return tiles_; }
    uint32_t passes() const { return passes_; }  ///< whole ones

private:
    void decide();

    AdaptiveRule rule_;
    std::vector<PixelEstimate> estimates_;
    AdaptiveFloors floors_ = {};
    std::unique_ptr<AdaptivePicture> picture_;
    std::vector<TileInWork> tiles_;
    uint32_t passes_ = 0;
};

}  // namespace sahl
