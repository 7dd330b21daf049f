// Tiles that the device begins while the host still reads the one before.
#pragma once

#include "device/device.h"
#include "vulkan/buffer.h"

#include <chrono>
#include <memory>
#include <optional>

namespace sahl {

/// For messages.
std::string nameOf(const TileRequest& tile);

class TilesAhead {
public:
    /// Records all that a tile takes, from clearing `pixels` on, to the blocks in there.
    using RecordTile = std::function<void(VkCommandBuffer commands, const TileRequest& tile)>;

    explicit TilesAhead(Context& context) : context_(context) {}

    /// The blocks of a tile as they are after its commands, whoever may miss samples. Takes those of a tile that was
    /// begun before; begins `next` before it waits. Returns the seconds that the device had for the tile [s].
    double render(const TileRequest& tile, const std::optional<TileRequest>& next, const Buffer& pixels,
                  const RecordTile& record, std::span<PixelBlock> blocks);

    /// Tiles that were asked for and begun before.
    uint64_t taken() const { return taken_; }

    /// Waits for what is under way and forgets it: before the buffers or pipelines in use change.
    void drain();

private:
    using Clock = std::chrono::steady_clock;
    /// A tile under way. All of them share the buffer of pixels, and each copies it to a place of its own.
    struct Flight {
        explicit Flight(Context& context) : submission(context) {}
        Buffer blocks;
        Submission submission;  // after what it writes to, so that it ends before that goes
        TileRequest tile;
        bool begun = false;
        Clock::time_point since;
    };

    Flight& flightOf(const TileRequest& tile);
    void begin(Flight& flight, const TileRequest& tile, const Buffer& pixels, const RecordTile& record);

    Context& context_;
    std::unique_ptr<Flight> flights_[2];
    Clock::time_point lastEnd_ = {};
    uint64_t taken_ = 0;
};

}  // namespace sahl
