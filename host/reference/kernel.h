// The path tracer's text compiled as C++: the same arithmetic as on the device, by an ordinary compiler.
// The text is included inside a struct whose members stand for the device's buffers.
#pragma once

#include "reference/axes.h"
#include "reference/four.h"
#include "shared/adaptive_types.h"
#include "shared/bindings.h"
#include "shared/features.h"
#include "shared/film_types.h"
#include "shared/ray_types.h"
#include "shared/scene_types.h"

#include <glm/gtc/type_precision.hpp>

#include <cmath>
#include <span>

#define CONST static constexpr
#define OUT(T) T&
#define INOUT(T) T&
#define READ(T) const T&
#define UNIFORM(field) frame.field

namespace sahl::reference {

using namespace glm;  // GLSL's names: floor, sqrt, floatBitsToUint, ...

/// One invocation. Order is one of ORDER_*. Scenes without instances are rendered without Instances,
/// which takes a few per cent less time and changes nothing else; likewise those without textures.
/// Watched: walks stop when stepsLeft is spent, and the height of the stack is checked, as on devices. What renders
/// here does without: its steps never end, no compiler cuts loops, and the host knows how high the stack gets.
template <uint Order = ORDER_NEAR_FIRST, bool Instances = true, bool Textures = false,
          uint NodeWidth = 2, bool Watched = false>
struct Kernel {
    static constexpr uint STACK_SIZE = MAX_STACK_SIZE;
    static constexpr uint NODE_WIDTH = NodeWidth;
    static constexpr bool STACK_IN_REGISTERS = false;
    static constexpr bool STEP_BY_STEP = false;
    static constexpr bool WALKS_ARE_WATCHED = Watched;
    static constexpr bool BRANCHES_ARE_GUESSED = true;
    static constexpr uint TRAVERSAL_ORDER = Order;
    static constexpr uint FEATURES = FEATURES_ALL & ~(Instances ? 0u : FEATURE_INSTANCES) &
                                     ~(Textures ? 0u : FEATURE_TEXTURES | FEATURE_CUTOUTS);
    static constexpr uint MATH = MATH_NATIVE;  // C++ divides and takes roots exactly anyway
    static float fusedMultiplyAdd(float a, float b, float c) { return std::fma(a, b, c); }

    std::span<const BvhNode> nodes;
    std::span<const WideNode> wideNodes;
    std::span<const Primitive> primitives;
    std::span<const TriangleCorners> triangleCorners;
    std::span<const Material> materials;
    std::span<const Light> lights;
    std::span<const AliasEntry> aliasEntries;
    std::span<const Texture> textures;
    std::span<const uint> textureTexels;
    std::span<const vec4> probeTexels;
    std::span<const ObjectInstance> instances;
    Frame frame = {};
    const Probe& sceneProbe() const { return frame.probe; }
    const Probe& backgroundProbe() const { return frame.background; }

    const BvhNode& loadNode(uint index) const { return nodes[index]; }
    /// By an offset of 32 bits, in which the number of children is shifted out.
    const WideNode& wideNodeOf(uint ref) const
    {
        return *reinterpret_cast<const WideNode*>(reinterpret_cast<const char*>(wideNodes.data()) + uint(ref << 6));
    }
    const uvec4& loadWideX(uint ref) const { return wideNodeOf(ref).x; }
    const uvec4& loadWideY(uint ref) const { return wideNodeOf(ref).y; }
    const uvec4& loadWideZ(uint ref) const { return wideNodeOf(ref).z; }
    const uvec4& loadWideRefs(uint ref) const { return wideNodeOf(ref).refs; }
    /// Has what a reference to a wide node or a leaf leads to read ahead.
    void expectRef(uint ref) const
    {
        if ((ref & REF_LEAF) != 0) {
            // And the next line: triangles lie across lines, and leaves may have several
            const Primitive* first = primitives.data() + ((ref & ~REF_LEAF) >> LEAF_COUNT_BITS);
            __builtin_prefetch(first);
            __builtin_prefetch(reinterpret_cast<const char*>(first) + 64);
        } else if ((ref & REF_NOT_INNER) == 0)
            __builtin_prefetch(&wideNodeOf(ref));
    }
    const Primitive& loadPrimitive(uint index) const { return primitives[index]; }
    const TriangleCorners& loadCorners(uint index) const { return triangleCorners[index]; }
    const Material& loadMaterial(uint index) const { return materials[index]; }
    const Light& loadLight(uint index) const { return lights[index]; }
    const ObjectInstance& loadInstance(uint index) const { return instances[index]; }
    const AliasEntry& loadAliasEntry(uint index) const { return aliasEntries[index]; }
    const Texture& loadTexture(uint index) const { return textures[index]; }
    uint loadTextureTexel(uint index) const { return textureTexels[index]; }
    const vec4& loadProbeTexel(uint index) const { return probeTexels[index]; }

    // Of adaptive sampling: of all pixels of a picture, top row first.
    std::span<const PixelEstimate> estimates;
    uint pictureWidth = 0;
    uint estimatesWidth() const { return pictureWidth; }
    uint estimatesHeight() const { return static_cast<uint>(estimates.size() / pictureWidth); }
    const PixelEstimate& loadEstimate(uint x, uint y) const { return estimates[y * pictureWidth + x]; }

#include "pathtrace/pathtrace.glsl"
#include "pathtrace/film_sums.glsl"
#include "pathtrace/adaptive.glsl"
#include "pathtrace/adaptive_schedule.glsl"
#include "pathtrace/adaptive_halves.glsl"

    /// Renders block `pass` of the pixel: until it is full, or the rule stops the pixel.
    void renderBlock(uint x, uint y, uint pass, const AdaptiveRule& rule, AdaptivePixel& pixel)
    {
        pixel.firstSample = pass * BLOCK_SIZE;
        while (pixel.state == PIXEL_ACTIVE && pixel.block.samplesDone < BLOCK_SIZE) {
            uint sampleIndex = pixel.firstSample + pixel.block.samplesDone;
            vec3 L = renderSample(x, y, sampleIndex, pixel.block);
            pixel.state = stateAfter(rule, L, sampleIndex + 1, pixel.mean);
        }
    }

    /// Adds what the camera ray of a sample meets first.
    void renderFirstHit(uint x, uint y, uint sampleIndex, bool isFirst, FirstHits& sums)
    {
        faults = 0;
        PathState path = beginPath(x, y, sampleIndex);
        Traversal walk = beginPathTraversal(path);
        while (path.phase != PHASE_ENDED && faults == 0) {
            stepsLeft = 0xffffffffu;
            advanceFirstHit(path, walk);
        }
        addFirstHit(path, walk, isFirst, sums);
    }

    /// What the ray meets, and the work that it takes to find out.
    TraceHit traceRay(const TraceRay& ray, bool anyHit)
    {
        tally = {};
        faults = 0;
        Traversal walk = beginTraversal(ray.tMax);
        do stepsLeft = 0xffffffffu;
        while (!traverse(ray.org, ray.dir, anyHit, walk) && faults == 0);
        return {walk.number,    walk.tHit,            walk.b1,    walk.b2,
                tally.boxTests, tally.primitiveTests, TRACE_DONE, faults};
    }

    /// Renders sample `sampleIndex` of pixel (x, y), adds it to the block and returns what was added.
    vec3 renderSample(uint x, uint y, uint sampleIndex, PixelBlock& block)
    {
        tally = {};
        faults = 0;
        PathState path = beginPath(x, y, sampleIndex);
        Traversal walk = beginPathTraversal(path);
        while (path.phase != PHASE_ENDED && faults == 0) {
            stepsLeft = 0xffffffffu;
            advancePath(path, walk);
        }
        block.faults |= faults;
        return addSample(path, block);
    }
};

}  // namespace sahl::reference
