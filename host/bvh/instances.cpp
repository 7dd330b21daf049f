#include "bvh/instances.h"

#include "bvh/draft.h"
#include "util/error.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sahl {
namespace {

// The stack holds, on the longest way, an entry for every inner node of both levels and one for the
// way back; leaves of the world are divided up to 3 times more so that instances stand alone.
constexpr uint LEVELS_OF_DIVIDED_LEAF = 3;
constexpr uint WORLD_LEVELS = 25;
constexpr uint OBJECT_LEVELS = MAX_STACK_SIZE - 1 - LEVELS_OF_DIVIDED_LEAF - WORLD_LEVELS;

constexpr double ROUNDING = 0x1p-24;

glm::dmat3 absolute(const glm::dmat3& m)
{
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

double largest(const glm::dvec3& v)
{
    return std::max({v.x, v.y, v.z});
}

double largest(const glm::dmat3& m)
{
    const glm::dmat3 size = absolute(m);
    return std::max({largest(size[0]), largest(size[1]), largest(size[2])});
}

bool isFinite(const glm::dmat3& m)
{
    return std::isfinite(m[0][0] + m[0][1] + m[0][2] + m[1][0] + m[1][1] + m[1][2] + m[2][0] +
                         m[2][1] + m[2][2]);
}

/// As numbers.h does for all that is read: devices may flush denormals.
float withoutDenormals(double value)
{
    return std::abs(value) < 1e-30 ? 0.0f : static_cast<float>(value);
}

vec3 rowOf(const glm::dmat3& m, int row)
{
    return {withoutDenormals(m[0][row]), withoutDenormals(m[1][row]), withoutDenormals(m[2][row])};
}

float below(double value)
{
    const float nearest = static_cast<float>(value);
    return nearest <= value ? nearest : std::nextafter(nearest, -INFINITY);
}

float above(double value)
{
    const float nearest = static_cast<float>(value);
    return nearest >= value ? nearest : std::nextafter(nearest, INFINITY);
}

struct DoubleBox {
    glm::dvec3 lo, hi;
};

DoubleBox exactBox(const Placement& placement, const Box& box)
{
    DoubleBox placed = {placement.translation, placement.translation};
    for (int k = 0; k < 3; k++) {
        const glm::dvec3 a = placement.linear[k] * double{box.lo[k]};
        const glm::dvec3 b = placement.linear[k] * double{box.hi[k]};
        placed.lo += glm::min(a, b);
        placed.hi += glm::max(a, b);
    }
    return placed;
}

/// How far, on each axis of the world, the ray that the device intersects with the object may be
/// beside the real one, where it meets the object.
///
/// With A = toObject, M its inverse, and the ray o + t d, the device computes o' = A (o - T) and d'
/// = A d. Each component is off by at most 4 roundings (2^-24) of the sum of its terms' sizes, so
/// that on the ray at t they are 4 of |A| (|o - T| + |t d|); as t d leads from o to the object,
/// that is at most 4 of |A| 3 r, with r = reach + |T| bounding o - T and the object's own extent.
/// Storing A and M in float adds 1 of each. Then the tests in the object's space take the ray to be
/// beside where it is by as much as a WIDENING of their largest coordinate (traverse.glsl). Both
/// come back to the world by |M|.
glm::dvec3 slackOf(const Placement& placement, const Box& object, double reach)
{
    const glm::dmat3 toObject = absolute(glm::inverse(placement.linear));
    const glm::dvec3 r = glm::abs(placement.translation) + reach;
    const glm::dvec3 byMap = toObject * r * (3 * 8 * ROUNDING);
    const glm::dvec3 extent =
        glm::max(glm::abs(glm::dvec3(object.lo)), glm::abs(glm::dvec3(object.hi)));
    const double byTests = (largest(toObject * r) + largest(extent)) * double{BOX_WIDENING};
    return absolute(placement.linear) * (byMap + byTests);
}

double reachOf(const Box& box)
{
    return std::max(largest(glm::abs(glm::dvec3(box.lo))), largest(glm::abs(glm::dvec3(box.hi))));
}

/// Appends a tree without instances and returns its root's reference there.
uint appendTree(const Bvh& tree, Bvh& all)
{
    const uint nodes = static_cast<uint>(all.nodes.size());
    const uint primitives = static_cast<uint>(all.primitives.size());
    auto moved = [&](uint ref) {
        if (ref == REF_NONE) return ref;
        return (ref & REF_LEAF) != 0 ? ref + (primitives << LEAF_COUNT_BITS) : ref + nodes;
    };
    for (BvhNode node : tree.nodes) {
        node.ref0 = moved(node.ref0);
        node.ref1 = moved(node.ref1);
        all.nodes.push_back(node);
    }
    all.primitives.insert(all.primitives.end(), tree.primitives.begin(), tree.primitives.end());
    return moved(tree.rootRef);
}

/// The trees of all objects that are placed.
struct ObjectTrees {
    std::vector<Bvh> trees;  ///< one for each object; empty when it is not placed
    std::vector<Box> boxes;
    uint64_t stored = 0;  ///< primitives
};

ObjectTrees buildObjects(std::span<const std::vector<Primitive>> objects,
                         std::span<const Placement> placements, BvhBuild build, unsigned threads)
{
    ObjectTrees result;
    result.trees.resize(objects.size());
    result.boxes.resize(objects.size());
    for (const Placement& placement : placements) {
        const std::vector<Primitive>& object = objects[placement.object];
        Bvh& tree = result.trees[placement.object];
        if (!tree.primitives.empty() || object.empty()) continue;
        tree = withPrimitives(buildTree({object, {}, {}}, OBJECT_LEVELS, build, threads), object, threads);
        for (const Primitive& primitive : object)
            grow(result.boxes[placement.object], boxOf(primitive));
        result.stored += object.size();
    }
    return result;
}

void requireCounts(std::span<const Primitive> primitives,
                   std::span<const std::vector<Primitive>> objects,
                   std::span<const Placement> placements)
{
    if (placements.size() > MAX_INSTANCES) {
        throw badInput("the scene has {} instances, at most {} are possible", placements.size(),
                       MAX_INSTANCES);
    }
    uint64_t seen = primitives.size();
    for (const Placement& placement : placements) seen += objects[placement.object].size();
    if (seen >= NO_HIT) {
        throw badInput("the scene's instances show {} primitives, more than the {} that can be "
                       "numbered; place fewer, or simplify the objects",
                       seen, NO_HIT);
    }
}

}  // namespace

bool isPlaceable(const Placement& placement)
{
    if (!isFinite(placement.linear) || glm::determinant(placement.linear) == 0) return false;
    const glm::dmat3 inverse = glm::inverse(placement.linear);
    return isFinite(inverse) && largest(placement.linear) <= LARGEST_STRETCH &&
           largest(inverse) <= LARGEST_STRETCH;
}

Box placedBox(const Placement& placement, const Box& box)
{
    const DoubleBox exact = exactBox(placement, box);
    Box placed;
    for (int axis = 0; axis < 3; axis++) {
        placed.lo[axis] = below(exact.lo[axis]);
        placed.hi[axis] = above(exact.hi[axis]);
    }
    return placed;
}

ObjectInstance makeInstance(const Placement& placement, const Box& object, double reach)
{
    if (!isPlaceable(placement)) {
        throw badInput("the map of an instance cannot be inverted, or stretches or shrinks by more "
                       "than {:g}",
                       LARGEST_STRETCH);
    }
    const glm::dmat3 toObject = glm::inverse(placement.linear);
    ObjectInstance instance = {};
    instance.toObject0 = rowOf(toObject, 0);
    instance.toObject1 = rowOf(toObject, 1);
    instance.toObject2 = rowOf(toObject, 2);
    instance.toWorld0 = rowOf(placement.linear, 0);
    instance.toWorld1 = rowOf(placement.linear, 1);
    instance.toWorld2 = rowOf(placement.linear, 2);
    for (int axis = 0; axis < 3; axis++)
        instance.translation[axis] = withoutDenormals(placement.translation[axis]);
    instance.material = placement.material;

    const DoubleBox exact = exactBox(placement, object);
    // Like every box in boxOf(), for the roundings of the box test itself.
    const double size = std::max(largest(glm::abs(exact.lo)), largest(glm::abs(exact.hi)));
    const glm::dvec3 slack = slackOf(placement, object, reach) + size * double{BOX_WIDENING};
    for (int axis = 0; axis < 3; axis++) {
        instance.lo[axis] = below(exact.lo[axis] - slack[axis]);
        instance.hi[axis] = above(exact.hi[axis] + slack[axis]);
        if (!std::isfinite(instance.lo[axis]) || !std::isfinite(instance.hi[axis])) {
            throw badInput(
                "an instance reaches outside the range of numbers; scale the scene down");
        }
    }
    return instance;
}

std::vector<uint> appendObjects(std::span<const Bvh> objects, Bvh& world)
{
    std::vector<uint> roots;
    BvhStatistics& all = world.statistics;
    uint32_t deepest = 0;
    for (const Bvh& object : objects) {
        const BvhStatistics& own = object.statistics;
        roots.push_back(appendTree(object, world));
        all.innerNodes += own.innerNodes;
        all.leaves += own.leaves;
        all.largestLeaf = std::max(all.largestLeaf, own.largestLeaf);
        deepest = std::max(deepest, own.depth);
    }
    all.depth += 1 + deepest;
    return roots;
}

Bvh buildTwoLevels(std::span<const Primitive> primitives,
                   std::span<const std::vector<Primitive>> objects,
                   std::span<const Placement> placements, double reach, BvhBuild build,
                   unsigned threads)
{
    const auto start = std::chrono::steady_clock::now();
    requireCounts(primitives, objects, placements);
    const ObjectTrees built = buildObjects(objects, placements, build, threads);
    if (primitives.size() + built.stored > MAX_PRIMITIVES) {
        throw badInput("the scene has {} primitives, more than the {} that the tree can number; "
                       "simplify or divide the scene",
                       primitives.size() + built.stored, MAX_PRIMITIVES);
    }

    for (const Primitive& primitive : primitives)
        reach = std::max(reach, reachOf(extentOf(primitive)));
    for (const Placement& placement : placements) {
        if (objects[placement.object].empty()) continue;
        reach = std::max(reach, reachOf(placedBox(placement, built.boxes[placement.object])));
    }
    // Origins are moved off the surfaces that they lie on, and the camera of a saved scene away
    // when the picture gets another shape.
    reach *= 2;
    std::vector<ObjectInstance> instances;
    std::vector<Box> instanceBoxes;
    std::vector<double> costs;
    uint64_t number = primitives.size();
    for (const Placement& placement : placements) {
        if (objects[placement.object].empty()) continue;
        ObjectInstance& instance =
            instances.emplace_back(makeInstance(placement, built.boxes[placement.object], reach));
        instance.firstNumber = static_cast<uint>(number);
        number += objects[placement.object].size();
        instanceBoxes.push_back({instance.lo, instance.hi});
        costs.push_back(costOfInstance(built.trees[placement.object]));
    }

    Bvh all = withPrimitives(buildTree({primitives, instanceBoxes, costs}, WORLD_LEVELS, build, threads),
                             primitives, threads);
    const std::vector<uint> roots = appendObjects(built.trees, all);
    size_t next = 0;
    for (const Placement& placement : placements) {
        if (!objects[placement.object].empty()) instances[next++].rootRef = roots[placement.object];
    }
    all.instances = std::move(instances);
    all.statistics.primitivesSeen = number;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    all.statistics.seconds = elapsed.count();
    return all;
}

}  // namespace sahl
