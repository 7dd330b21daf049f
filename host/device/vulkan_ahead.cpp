#include "device/vulkan_ahead.h"

#include <algorithm>
#include <utility>

namespace sahl {

namespace {

constexpr Access ANYTHING = {VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                             VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};

uint64_t blockBytes(const TileRequest& tile)
{
    return uint64_t{tile.width} * tile.height * sizeof(PixelBlock);
}

}  // namespace

std::string nameOf(const TileRequest& tile)
{
    return fmt::format("render tile {}x{} at {},{}, samples {} to {}", tile.width, tile.height,
                       tile.x, tile.y, tile.firstSample,
                       uint64_t{tile.firstSample} + tile.sampleCount - 1);
}

/// The flight that has begun the tile, or one that is free.
TilesAhead::Flight& TilesAhead::flightOf(const TileRequest& tile)
{
    for (const std::unique_ptr<Flight>& flight : flights_)
        if (flight && flight->begun && flight->tile == tile) return *flight;
    drain();
    if (!flights_[0]) {
        for (std::unique_ptr<Flight>& flight : flights_) flight = std::make_unique<Flight>(context_);
    }
    return *flights_[0];
}

void TilesAhead::begin(Flight& flight, const TileRequest& tile, const Buffer& pixels, const RecordTile& record)
{
    const uint64_t bytes = blockBytes(tile);
    if (flight.blocks.bytes < bytes) {
        flight.blocks = {};
        flight.blocks =
            createBuffer(context_, {"blocks of a tile", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostUse::none});
    }
    flight.submission.begin(nameOf(tile), [&](VkCommandBuffer commands) {
        recordBarrier(commands, ANYTHING, ANYTHING);  // the tile before is in the same buffer
        record(commands, tile);
        recordBarrier(commands, COMPUTE_WRITE, TRANSFER_READ);
        const VkBufferCopy region = {0, 0, bytes};
        vkCmdCopyBuffer(commands, pixels.handle.get(), flight.blocks.handle.get(), 1, &region);
        recordBarrier(commands, TRANSFER_WRITE, HOST_READ);
    });
    flight.tile = tile;
    flight.begun = true;
    flight.since = Clock::now();
}

double TilesAhead::render(const TileRequest& tile, const std::optional<TileRequest>& next, const Buffer& pixels,
                          const RecordTile& record, std::span<PixelBlock> blocks)
{
    Flight& flight = flightOf(tile);
    Flight& other = *flights_[&flight == flights_[0].get() ? 1 : 0];
    if (flight.begun)
        taken_++;
    else
        begin(flight, tile, pixels, record);
    if (next && !other.begun) begin(other, *next, pixels, record);
    flight.begun = false;
    flight.submission.wait();
    const Clock::time_point from = std::max(flight.since, lastEnd_);
    lastEnd_ = Clock::now();
    readBuffer(flight.blocks, std::as_writable_bytes(blocks));
    return std::chrono::duration<double>(lastEnd_ - from).count();
}

void TilesAhead::drain()
{
    for (const std::unique_ptr<Flight>& flight : flights_) {
        if (!flight || !std::exchange(flight->begun, false)) continue;
        flight->submission.wait();
    }
}

}  // namespace sahl
