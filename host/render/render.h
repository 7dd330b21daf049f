// The render loop: passes over tiles, progress, and stopping between whole passes.
#pragma once

#include "device/device.h"
#include "film/film.h"

#include <functional>

namespace sahl {

/// Which samples to take of which pixels, and in what pieces. The pieces change no bit.
struct RenderPlan {
    uint32_t width = 0, height = 0;  ///< of the picture, or of a window in it [pixels]
    uint32_t firstSample = 0;        ///< multiple of BLOCK_SIZE
    uint32_t sampleCount = 0;        ///< per pixel, at least 1
    uint32_t tileSize = 0;           ///< side of a tile [pixels]; 0: as large as the device takes
    uint32_t left = 0, top = 0;      ///< of the window, in the scene's full picture [pixels]
    uint32_t maxPasses = 0;          ///< after which to stop; 0: when all samples are there
    double timeLimit = 0;            ///< after which no pass begins [s]; 0: none. One pass always runs
    bool wholeReplicates = false;    ///< the film is to be merged: what is stopped ends with a whole one, where there is one
    unsigned threads = 1;            ///< of the host, which adds up what the device gives
};

/// Why a render ended before all samples were there, a signal aside.
enum class StoppedBy { nothing, passes, time };

struct RenderProgress {
    double fraction = 0;         ///< of all samples of all pixels
    uint32_t samplesDone = 0;    ///< per pixel, in whole passes
    uint64_t rays = 0;           ///< of all kinds, so far
    double seconds = 0;          ///< since the start of the loop
    std::function<double()> relativeError;  ///< see there in film/film_error.h; empty while unknown. Takes a while
};

/// How far the rule of adaptive sampling came.
struct AdaptiveOutcome {
    uint64_t pixels = 0;     ///< of the picture
    uint64_t converged = 0;  ///< that the rule stopped
    uint64_t atMaximum = 0;  ///< that have maxSamples without; the others were interrupted
    bool operator==(const AdaptiveOutcome&) const = default;
};

struct RenderResult {
    Film film;
    uint32_t passes = 0;       ///< whole passes in the film; a pass is one block of every pixel
    bool interrupted = false;  ///< by a signal; a pass that was under way is not in the film, unless
                               ///< it was the first: then its finished tiles are
    double seconds = 0;
    AdaptiveOutcome adaptive = {};  ///< of renderAdaptive() alone
    StoppedBy stoppedBy = StoppedBy::nothing;
    bool endsInReplicate = false;  ///< samples are missing of the newest one: the film is not to be merged
};

/// Whether the plan ends a render after `passes` passes and `seconds` seconds.
StoppedBy stopsAfter(const RenderPlan& plan, uint32_t passes, double seconds);

/// Calls device.render() for every tile of every pass; the device's scene must be set.
/// The film has the plan's width and height; every pixel is that of the full picture, bit for bit.
/// `report` is called after every tile, `passDone` with the film so far after every whole pass but
/// the last.
RenderResult renderPicture(Device& device, const RenderPlan& plan,
                           const std::function<void(const RenderProgress&)>& report,
                           const std::function<void(const RenderResult&)>& passDone = {});

/// What the first `samples` (at most BLOCK_SIZE) camera rays of every pixel of the plan meet; width *
/// height, top row first. The device's scene must be set.
std::vector<FirstHits> renderFirstHits(Device& device, const RenderPlan& plan, uint32_t samples);

/// The same tile of the plan's window as the device counts it.
TileRequest inFullPicture(TileRequest tile, const RenderPlan& plan);

/// The tiles of a picture, row by row: no tile has more than maxPixels.
std::vector<TileRequest> tilesOf(uint32_t width, uint32_t height, uint32_t tileSize, uint32_t maxPixels);

}  // namespace sahl
