// The one interface behind which pictures are computed. Two makers: Vulkan and CPU.
// Both run the text of shaders/pathtrace/ and give the same bits.
#pragma once

#include "shared/adaptive_types.h"
#include "shared/film_types.h"
#include "shared/ray_types.h"
#include "shared/scene_types.h"

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// The wide trees of a scene (bvh/widen.h): where there are any, rays may walk them in place of the binary
/// ones. The primitives are the same.
struct WideScene {
    std::span<const WideNode> nodes;             ///< empty: there are none
    std::span<const ObjectInstance> instances;   ///< in place of the scene's
    uint rootRef = REF_NONE;                     ///< this and the grid in place of the frame's
    vec3 gridAt = vec3(0.0f);
    uint gridScale = 0;
    uint32_t worstPending = 0;                   ///< references on the stack, whatever the ray
    uint32_t worstGroups = 0;                    ///< nodes of which children wait, whatever the ray
};

/// What a device reads: spans over the scene's arrays and its tree. They must stay valid until the
/// next setScene() or the end of the device: the CPU reads them in place.
struct DeviceScene {
    std::span<const BvhNode> nodes;
    std::span<const Primitive> primitives;  ///< in leaf order
    std::span<const TriangleCorners> triangleCorners;
    std::span<const Material> materials;
    std::span<const Light> lights;
    std::span<const AliasEntry> aliasEntries;  ///< to choose a light, then to choose a probe's texel
    std::span<const Texture> textures;
    std::span<const uint32_t> textureTexels;  ///< RGBA8
    std::span<const vec4> probeTexels;
    std::span<const ObjectInstance> instances;
    Frame frame = {};
    uint32_t treeDepth = 0;  ///< decides the size of the traversal stack
    WideScene wide;
};

/// What can be told of a scene before its tree is built (render/outline.h).
struct SceneOutline {
    uint32_t features = 0;  ///< as featuresOf() has them
    size_t primitives = 0;
    size_t triangleCorners = 0;
    uint64_t samples = std::numeric_limits<uint64_t>::max();  ///< of all pixels together, at most
};

/// Part of a picture and of its samples. x, y, width and height in pixels of the full picture.
struct TileRequest {
    uint32_t x = 0, y = 0, width = 0, height = 0;
    uint32_t firstSample = 0;  ///< multiple of BLOCK_SIZE
    uint32_t sampleCount = 0;  ///< 1 to BLOCK_SIZE
    bool operator==(const TileRequest&) const = default;
};

/// Who computes, for messages, files and reports.
struct DeviceInfo {
    std::string name;    ///< "llvmpipe (LLVM 15.0.6, 256 bits)", "CPU, 2 threads"
    std::string driver;  ///< "llvmpipe Mesa 22.3.6 ...", "gcc 12.2.0 ..."
    std::string kind;    ///< "discrete", "integrated", "virtual", "software", "cpu"
};

/// How the work of a device went; the same picture comes out whatever these numbers are.
struct DeviceStatistics {
    uint64_t dispatches = 0;
    uint64_t retries = 0;       ///< dispatches in which a loop was cut and whose pixels went again
    uint64_t resumptions = 0;   ///< extra dispatches for paths that ran out of steps
    uint32_t stepBudget = 0;    ///< in force at the end
    double uploadSeconds = 0;
    double renderSeconds = 0;   ///< inside render()
    uint64_t sceneBytes = 0;    ///< on the device
    bool exactMath = false;     ///< division and root made exact rather than the device's own
    bool texelBuffers = false;  ///< scene read through texel buffers rather than storage buffers
    uint32_t pipelines = 0;     ///< that were made of kernels
    bool walksWatched = false;  ///< on the device: walks count their steps, and say where a loop was cut
    uint64_t tilesBegunAhead = 0;  ///< that were asked for and under way already (see expectTile())
    std::string variant;        ///< way in which kernels run (variants.h), what a scene does not allow left out; empty on the CPU
};

/// What a pass of adaptive sampling did.
struct AdaptivePass {
    uint32_t activePixels = 0;  ///< that take more samples; with 0 the tile is finished. Under `crossed`
                                ///< and after its decision a pixel counts once for each half
    uint64_t samples = 0;       ///< of this pass
    uint64_t rays = 0;          ///< of all kinds, of this pass
};

/// Part of a picture [pixels].
struct AdaptiveWindow {
    uint32_t left = 0, top = 0, width = 0, height = 0;
};

/// Adaptive sampling of a tile. What the pixels have so far, which of them go on and whether they have
/// enough lives on the device; only a pass's few counts come back.
class AdaptiveTile {
public:
    virtual ~AdaptiveTile() = default;

    /// Up to BLOCK_SIZE samples more for every active pixel: fewer for pixels that the rule stops on the
    /// way. Pixels that are finished cost nothing. Where a decision is due after the pass (see
    /// decisionIsDue in device/adaptive_schedule.h) all its pixels count as active. Throws deviceLost.
    virtual AdaptivePass runPass() = 0;

    /// Decides who goes on, once every tile of the picture has run the pass after which that is due.
    /// Returns the number of active pixels. Throws deviceLost.
    virtual uint32_t decide(const AdaptiveFloors& floors) = 0;

    /// All pixels as they are now, top row first; pixels.size() == width * height.
    virtual void read(std::span<AdaptivePixel> pixels) = 0;
};

/// Adaptive sampling of a picture, tile by tile. Rules that look at neighbours need all its tiles alive.
class AdaptivePicture {
public:
    virtual ~AdaptivePicture() = default;

    /// Begins a tile with its sample 0; it lies in the window, and its firstSample and sampleCount have
    /// no meaning. The tile must be gone before the picture. Several may be alive. Throws as render() does.
    virtual std::unique_ptr<AdaptiveTile> beginTile(const TileRequest& tile) = 0;

    /// What the pixels said of themselves before the newest decision, top row of the window first;
    /// estimates.size() == width * height. For rules that look at neighbours.
    virtual void readEstimates(std::span<PixelEstimate> estimates) = 0;
};

class Device {
public:
    virtual ~Device() = default;

    virtual DeviceInfo info() const = 0;

    /// Makes ahead what setScene() will need for a scene that is about like that; where it turns out to be different,
    /// setScene() makes that again. Throws as setScene() does.
    virtual void expectScene(const SceneOutline&) {}

    /// Uploads a scene; replaces the one before. Throws badInput or noDevice with numbers when the
    /// device's limits do not allow it, deviceLost when it runs out of memory.
    virtual void setScene(const DeviceScene& scene) = 0;

    /// Says which tile render() will be asked for after the next one. It may be begun while that is read; if something
    /// else follows, it is forgotten.
    virtual void expectTile(const TileRequest&) {}

    /// Renders the samples of a tile. blocks.size() == width * height, top row first; all fields of
    /// every block are overwritten; `faults` is 0 and `status` BLOCK_IDLE on return.
    /// Throws deviceLost.
    virtual void render(const TileRequest& tile, std::span<PixelBlock> blocks) = 0;

    /// What the camera rays of the tile's samples meet first: rays as in render(), at most BLOCK_SIZE
    /// samples from sample 0 on. pixels.size() == width * height. Throws as render() does.
    virtual void renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels) = 0;

    /// Traces rays through the scene: the closest hit of each, or with `anyHit` some hit, and the work
    /// that it took. hits.size() == rays.size(). For measurements and tests. Returns the seconds that
    /// the tracing took [s], without the way of rays and hits to and from the device; on a graphics card the mean of
    /// as many times as take 0.05 s.
    /// Throws as render() does.
    virtual double traceRays(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits) = 0;

    /// Begins adaptive sampling of a window of the picture. The result must be gone before the next
    /// setScene() and before the device. Throws as render() does.
    virtual std::unique_ptr<AdaptivePicture> beginAdaptive(const AdaptiveWindow& window,
                                                           const AdaptiveRule& rule) = 0;

    /// Sampler of the scene that is set, one of SAMPLER_*: what the spread of samples means depends on it.
    virtual uint32_t samplerKind() const = 0;

    /// Largest width * height that render() takes.
    virtual uint32_t maxTilePixels() const = 0;

    /// Pixels that all AdaptiveTiles alive should have together at most, for their memory.
    virtual uint64_t maxAdaptivePixels() const = 0;

    virtual DeviceStatistics statistics() const = 0;
};

/// Settings for users and tests. None of them changes a bit of the film.
struct DeviceOptions {
    unsigned threads = 0;              ///< CPU: 0 means all cores
    uint32_t traversalOrder = 0;       ///< one of ORDER_* (changes counters)
    uint32_t nodeWidth = 4;            ///< 4: the wide tree where the scene has one; 2 (changes counters)
    // Vulkan only:
    enum class Buffers { automatic, texel, storage } buffers = Buffers::automatic;
    /// Division and square root by the device itself, made exact, or as a test of the device decides.
    enum class Math { automatic, native, exact } math = Math::automatic;
    std::string variant;                      ///< of variants.h; empty: as was tuned, else by the driver
    uint32_t groupWidth = 0, groupHeight = 0;  ///< 0: by the variant
    uint32_t stepBudget = 0;           ///< 0: by the driver; steps one invocation takes a dispatch
    uint32_t waveSlots = 0;            ///< 0: by the driver; paths under way at a time, where they go in waves
    bool beginsAhead = false;          ///< for tests: expectTile() has an effect on any device, however slow
    bool trustsLoops = false;          ///< for tests: walks that are short go unwatched, whatever the driver does to loops
    bool validation = false;           ///< Khronos validation with synchronization checks, if installed
};

/// The same text compiled as C++, on all cores.
std::unique_ptr<Device> makeCpuDevice(const DeviceOptions& options);

/// A Vulkan device found on this machine.
struct VulkanDeviceInfo {
    uint32_t index = 0;
    std::string name, driver, kind, uuid, apiVersion;
    uint64_t deviceMemory = 0;            ///< bytes of the largest device-local heap
    uint64_t maxStorageBufferBytes = 0;   ///< of one binding
    uint64_t maxTexelBufferElements = 0;
    uint32_t subgroupSize = 0;
    uint32_t maxGroupInvocations = 0;
    std::string unusable;                 ///< empty, or why it cannot be used
};

/// All Vulkan devices. Empty when there is no loader or no driver; `whyNone` then says why.
std::vector<VulkanDeviceInfo> listVulkanDevices(std::string& whyNone);

/// Opens one of listVulkanDevices(). Throws noDevice.
std::unique_ptr<Device> makeVulkanDevice(uint32_t index, const DeviceOptions& options);

/// Opens what --device names: "auto", "cpu", an index, a UUID, a part of a name, "discrete",
/// "integrated" or "software". `note` is a line for the user about what was chosen and why, or empty.
/// auto: a real GPU, else software Vulkan; CPU only where there is no Vulkan at all, with a note.
/// Throws noDevice with the list of devices when nothing fits.
std::unique_ptr<Device> openDevice(const std::string& selection, const DeviceOptions& options,
                                   std::string& note);

/// Number of messages the validation layer has given so far in this process (0 without it).
uint64_t validationMessageCount();

}  // namespace sahl
