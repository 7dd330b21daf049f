// The render loop beside a device that computes elsewhere: the film is added up while the next pass is rendered.
#include "film/film_error.h"
#include "support/forwarding_device.h"
#include "support/render_scenes.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

namespace sahl::testing {
namespace {

constexpr uint32_t WIDTH = 24, HEIGHT = 18, SPP = 29;

/// Says that it is a graphics card, and sees that tiles come as they were announced.
struct CardLike : ForwardingDevice {
    CardLike() { inner = makeCpuDevice({}); }
    DeviceInfo info() const override { return {"card", "1", "discrete"}; }
    void expectTile(const TileRequest& tile) override { announced = tile; }
    void render(const TileRequest& tile, std::span<PixelBlock> blocks) override
    {
        if (tiles > 0) {
            EXPECT_TRUE(due && *due == tile) << tiles;
        }
        due = std::exchange(announced, {});
        tiles++;
        inner->render(tile, blocks);
    }
    std::optional<TileRequest> announced;  // for after the next one
    std::optional<TileRequest> due;
    int tiles = 0;
};

const PreparedScene& scene()
{
    static const PreparedScene prepared =
        prepareScene(builtInScene(smallPicture(WIDTH, HEIGHT, SPP)), BvhBuild::sweep, 2);
    return prepared;
}

RenderPlan planOf(uint32_t tileSize)
{
    RenderPlan plan = {WIDTH, HEIGHT, 0, SPP, tileSize};
    plan.threads = 3;
    return plan;
}

TEST(RenderLoop, addsTheSameFilmWhileTheNextPassIsRendered)
{
    const Film expected = renderFilm(*makeCpuDevice({}), scene());
    for (uint32_t tileSize : {0u, 7u}) {
        CardLike card;
        card.setScene(scene().deviceScene());
        EXPECT_TRUE(renderPicture(card, planOf(tileSize), [](const RenderProgress&) {}).film == expected) << tileSize;
    }
}

TEST(RenderLoop, saysWhichTileComesAfterTheNextOne)
{
    CardLike card;
    card.setScene(scene().deviceScene());
    renderPicture(card, planOf(7), [](const RenderProgress&) {});
    EXPECT_EQ(card.tiles, 4 * 4 * 3);  // passes, of tiles of 7 x 7 pixels
    EXPECT_FALSE(card.due.has_value()) << "nothing follows the last one";
}

TEST(RenderLoop, showsWholePassesAndTheirErrorWhileItAdds)
{
    CardLike card;
    card.setScene(scene().deviceScene());
    uint32_t passes = 0;
    double lastError = 0;
    auto report = [&](const RenderProgress& progress) {
        EXPECT_EQ(bool(progress.relativeError), passes > 0);
        if (progress.relativeError) lastError = progress.relativeError();
    };
    const RenderResult result = renderPicture(card, planOf(7), report, [&](const RenderResult& soFar) {
        passes++;
        EXPECT_EQ(soFar.passes, passes);
        EXPECT_TRUE(soFar.film == renderFilm(*makeCpuDevice({}), scene(), 0, passes * BLOCK_SIZE));
    });
    EXPECT_EQ(passes, 3u);
    EXPECT_EQ(lastError, relativeError(renderFilm(*makeCpuDevice({}), scene(), 0, 3 * BLOCK_SIZE)));
    EXPECT_EQ(result.passes, 4u);
}

}  // namespace
}  // namespace sahl::testing
