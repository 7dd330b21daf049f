// A device that hands everything on to another one, for tests to change some of it.
#pragma once

#include "device/device.h"

namespace sahl::testing {

struct ForwardingDevice : Device {
    std::unique_ptr<Device> inner;
    DeviceInfo info() const override { return inner->info(); }
    void setScene(const DeviceScene& scene) override { inner->setScene(scene); }
    void expectTile(const TileRequest& tile) override { inner->expectTile(tile); }
    void render(const TileRequest& tile, std::span<PixelBlock> blocks) override { inner->render(tile, blocks); }
    void renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels) override
    {
        inner->renderFirstHits(tile, pixels);
    }
    double traceRays(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits) override
    {
        return inner->traceRays(rays, anyHit, hits);
    }
    std::unique_ptr<AdaptivePicture> beginAdaptive(const AdaptiveWindow& window, const AdaptiveRule& rule) override
    {
        return inner->beginAdaptive(window, rule);
    }
    uint32_t samplerKind() const override { return inner->samplerKind(); }
    uint32_t maxTilePixels() const override { return inner->maxTilePixels(); }
    uint64_t maxAdaptivePixels() const override { return inner->maxAdaptivePixels(); }
    DeviceStatistics statistics() const override { return inner->statistics(); }
};

}  // namespace sahl::testing
