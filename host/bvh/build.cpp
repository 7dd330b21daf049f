// buildBvh: checks the primitives, picks the builder, hands over to flatten.
#include "bvh/draft.h"
#include "bvh/reinsert.h"

#include "util/error.h"
#include "util/parallel.h"

#include <chrono>
#include <cmath>

namespace sahl {
namespace {

constexpr size_t BINNED_FROM = 200'000;  ///< primitives; a sweep takes about half a second there
constexpr size_t CHUNK_SIZE = 65'536;

bool isFinite(const vec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::vector<Box> boxesOf(std::span<const Primitive> primitives, unsigned threads)
{
    std::vector<Box> boxes(primitives.size());
    const size_t chunks = (primitives.size() + CHUNK_SIZE - 1) / CHUNK_SIZE;
    parallelFor(chunks, threads, [&](size_t chunk) {
        const size_t end = std::min(primitives.size(), (chunk + 1) * CHUNK_SIZE);
        for (size_t i = chunk * CHUNK_SIZE; i < end; i++) boxes[i] = boxOf(primitives[i]);
    });
    return boxes;
}

void requireSoundSphere(const Primitive& sphere)
{
    if (!(sphere.p1.x > 0)) {
        throw badInput("primitive {} is a sphere of radius {}; the radius must be positive",
                       sphere.number, sphere.p1.x);
    }
    const Box box = extentOf(sphere);
    if (!isFinite(box.lo) || !isFinite(box.hi)) {
        throw badInput("primitive {} is a sphere that is not finite or reaches beyond the range of "
                       "numbers; scale the scene down",
                       sphere.number);
    }
}

/// A NaN has no place in any order, and an infinite box no area.
void requireSound(std::span<const Primitive> primitives)
{
    for (const Primitive& primitive : primitives) {
        if (primitive.shape == SHAPE_SPHERE) {
            requireSoundSphere(primitive);
        } else if (!isFinite(primitive.p0) || !isFinite(primitive.p1) || !isFinite(primitive.p2)) {
            throw badInput("primitive {} is a triangle with a corner that is not finite; "
                           "remove it or repair the mesh",
                           primitive.number);
        }
    }
}

BareTree buildWorld(std::span<const Primitive> primitives, BvhBuild build, unsigned threads)
{
    if (primitives.size() > MAX_PRIMITIVES) {
        throw badInput("the scene has {} primitives, more than the {} that the tree can number; "
                       "simplify or divide the scene",
                       primitives.size(), MAX_PRIMITIVES);
    }
    return buildTree({primitives, {}, {}}, MAX_STACK_SIZE, build, threads);
}

Bvh timed(Bvh bvh, std::chrono::steady_clock::time_point start)
{
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    bvh.statistics.primitivesSeen = bvh.primitives.size();
    bvh.statistics.seconds = elapsed.count();
    return bvh;
}

/// primitives[i] becomes what primitives[order[i]] was: along the cycles of the permutation.
void putInOrder(std::vector<Primitive>& primitives, std::vector<uint> order)
{
    for (uint begin = 0; begin < order.size(); begin++) {
        const Primitive first = primitives[begin];
        uint to = begin;
        for (uint from = order[to]; from != begin; from = order[to]) {
            primitives[to] = primitives[from];
            order[to] = to;
            to = from;
        }
        primitives[to] = first;
        order[to] = to;
    }
}

}  // namespace

BareTree buildTree(const TreeItems& items, uint levels, BvhBuild build, unsigned threads)
{
    const size_t count = items.primitives.size() + items.instanceBoxes.size();
    const bool high = build == BvhBuild::high;
    if (high || build == BvhBuild::automatic)
        build = count < BINNED_FROM ? BvhBuild::sweep : BvhBuild::binned;

    BareTree tree;
    if (count > 0) {
        requireSound(items.primitives);
        std::vector<Box> boxes = boxesOf(items.primitives, threads);
        boxes.insert(boxes.end(), items.instanceBoxes.begin(), items.instanceBoxes.end());
        Draft draft = build == BvhBuild::sweep ? buildSweep(boxes, levels, threads)
                                               : buildBinned(boxes, levels, threads);
        if (high)
            improveByReinsertion(draft, boxes, levels, TO_THE_END, threads);
        else if (build == BvhBuild::sweep)
            improveByReinsertion(draft, boxes, levels, WHILE_IT_PAYS, threads);
        boxes = std::vector<Box>();  // '= {}' would keep their memory
        tree.bvh = flatten(draft, items, threads);
        tree.order = std::move(draft.order);
        if (!items.instanceBoxes.empty())
            std::erase_if(tree.order, [&](uint number) { return number >= items.primitives.size(); });
    }
    tree.bvh.statistics.build = high ? BvhBuild::high : build;
    return tree;
}

Bvh withPrimitives(BareTree tree, std::span<const Primitive> primitives, unsigned threads)
{
    std::vector<Primitive>& sorted = tree.bvh.primitives;
    sorted.resize(tree.order.size());
    const size_t chunks = (sorted.size() + CHUNK_SIZE - 1) / CHUNK_SIZE;
    parallelFor(chunks, threads, [&](size_t chunk) {
        const size_t end = std::min(sorted.size(), (chunk + 1) * CHUNK_SIZE);
        for (size_t i = chunk * CHUNK_SIZE; i < end; i++) sorted[i] = primitives[tree.order[i]];
    });
    return std::move(tree.bvh);
}

Bvh buildBvh(std::span<const Primitive> primitives, BvhBuild build, unsigned threads)
{
    const auto start = std::chrono::steady_clock::now();
    BareTree tree = buildWorld(primitives, build, threads);
    return timed(withPrimitives(std::move(tree), primitives, threads), start);
}

Bvh buildBvh(std::vector<Primitive>&& primitives, BvhBuild build, unsigned threads)
{
    const auto start = std::chrono::steady_clock::now();
    BareTree tree = buildWorld(primitives, build, threads);
    putInOrder(primitives, std::move(tree.order));
    tree.bvh.primitives = std::move(primitives);
    return timed(std::move(tree.bvh), start);
}

}  // namespace sahl
