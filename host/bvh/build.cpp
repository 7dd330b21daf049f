// buildBvh: checks the triangles, picks the builder, hands over to flatten.
#include "bvh/draft.h"

#include "util/error.h"
#include "util/parallel.h"

#include <chrono>
#include <cmath>

namespace sahl {
namespace {

constexpr size_t BINNED_FROM = 200'000;  ///< triangles; a sweep takes about half a second there
constexpr size_t CHUNK_SIZE = 65'536;

bool isFinite(const vec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::vector<Box> boxesOf(std::span<const Primitive> triangles, unsigned threads)
{
    std::vector<Box> boxes(triangles.size());
    const size_t chunks = (triangles.size() + CHUNK_SIZE - 1) / CHUNK_SIZE;
    parallelFor(chunks, threads, [&](size_t chunk) {
        const size_t end = std::min(triangles.size(), (chunk + 1) * CHUNK_SIZE);
        for (size_t i = chunk * CHUNK_SIZE; i < end; i++) boxes[i] = boxOf(triangles[i]);
    });
    return boxes;
}

/// A NaN has no place in any order, and an infinite box no area.
void requireFinite(std::span<const Primitive> triangles)
{
    for (const Primitive& triangle : triangles) {
        if (!isFinite(triangle.p0) || !isFinite(triangle.p1) || !isFinite(triangle.p2)) {
            throw badInput("triangle {} has a corner that is not finite; "
                           "remove it or repair the mesh",
                           triangle.number);
        }
    }
}

}  // namespace

Bvh buildBvh(std::span<const Primitive> triangles, BvhBuild build, unsigned threads)
{
    const auto start = std::chrono::steady_clock::now();
    if (triangles.size() > MAX_PRIMITIVES) {
        throw badInput("the scene has {} triangles, more than the {} that the tree can number; "
                       "simplify or divide the scene",
                       triangles.size(), MAX_PRIMITIVES);
    }
    if (build == BvhBuild::automatic)
        build = triangles.size() < BINNED_FROM ? BvhBuild::sweep : BvhBuild::binned;

    Bvh bvh;
    if (!triangles.empty()) {
        requireFinite(triangles);
        const std::vector<Box> boxes = boxesOf(triangles, threads);
        const Draft draft =
            build == BvhBuild::sweep ? buildSweep(boxes, threads) : buildBinned(boxes, threads);
        bvh = flatten(draft, triangles, boxes);
    }
    bvh.statistics.build = build;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    bvh.statistics.seconds = elapsed.count();
    return bvh;
}

}  // namespace sahl
