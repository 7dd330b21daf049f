// Surface area heuristic by sweeping: every position between two neighbouring centres on all three
// axes is a candidate. Sorted once; stable partitions keep the order on the way down.
// Goldsmith and Salmon 1987; MacDonald and Booth 1990; Wald and Havran 2006 for sorting once.
#include "bvh/sweep.h"

#include "util/parallel.h"

#include <algorithm>
#include <numeric>

namespace sahl {
namespace {

/// Below this many primitives a subtree is the work of one thread.
constexpr uint SUBTREE_SIZE = 4096;

SweepRange part(const SweepRange& range, uint offset, uint count)
{
    return {{range.sorted[0].subspan(offset, count), range.sorted[1].subspan(offset, count),
             range.sorted[2].subspan(offset, count)},
            range.scratch.subspan(offset, count),
            range.areas.subspan(offset, count)};
}

/// Tries every split along one axis. Returns half the area of the whole range's box.
double sweepAxis(const SweepShared& shared, const SweepRange& range, int axis, uint levelsBelow,
                 Split& best)
{
    const std::span<const uint> sorted = range.sorted[axis];
    const uint count = static_cast<uint>(sorted.size());
    Box right;
    for (uint i = count; i-- > 0;) {
        grow(right, shared.boxes[sorted[i]]);
        range.areas[i] = halfArea(right);
    }
    Box left;
    for (uint i = 1; i < count; i++) {
        grow(left, shared.boxes[sorted[i - 1]]);
        if (!fits(i, count, levelsBelow)) continue;
        double cost = halfArea(left) * i + range.areas[i] * (count - i);
        keepBetter(best, {cost, axis, i, 0}, count);
    }
    return range.areas[0];
}

void stablePartition(const SweepShared& shared, std::span<uint> sorted, std::span<uint> scratch)
{
    size_t left = 0, right = 0;
    for (uint number : sorted) {
        if (shared.onLeft[number])
            sorted[left++] = number;
        else
            scratch[right++] = number;
    }
    std::copy_n(scratch.begin(), right, sorted.begin() + static_cast<std::ptrdiff_t>(left));
}

/// Finds the best split of a range of two or more primitives and divides the three orders by it.
/// Returns the left side's count; `area` is half that of the range's box.
uint divide(const SweepShared& shared, const SweepRange& range, uint levels, double& area)
{
    Split best;
    for (int axis = 0; axis < 3; axis++) area = sweepAxis(shared, range, axis, levels - 1, best);
    const std::span<const uint> sorted = range.sorted[best.axis];
    for (uint i = 0; i < sorted.size(); i++) shared.onLeft[sorted[i]] = i < best.leftCount;
    for (int axis = 0; axis < 3; axis++) {
        if (axis != best.axis) stablePartition(shared, range.sorted[axis], range.scratch);
    }
    return best.leftCount;
}

void makeLeaf(const SweepShared& shared, const SweepRange& range, const Subtree& tree)
{
    std::sort(range.sorted[0].begin(), range.sorted[0].end());
    shared.nodes[tree.slot] = {tree.first, tree.count, 0};
}

struct SweepWork {
    SweepRange range;
    Subtree tree;
};

/// Divides large ranges until what is left is enough small work for all threads.
std::vector<SweepWork> divideLarge(const SweepShared& shared, const SweepWork& root)
{
    std::vector<SweepWork> pending = {root}, small;
    while (!pending.empty()) {
        const auto [range, tree] = pending.back();
        pending.pop_back();
        if (tree.count <= SUBTREE_SIZE) {
            small.push_back({range, tree});
            continue;
        }
        double area;
        const uint leftCount = divide(shared, range, tree.levels, area);
        const Subtree left = leftOf(tree, leftCount), right = rightOf(tree, leftCount);
        shared.nodes[tree.slot] = {tree.first, tree.count, right.slot};
        pending.push_back({part(range, leftCount, right.count), right});
        pending.push_back({part(range, 0, leftCount), left});
    }
    return small;
}

}  // namespace

double sweepSubtree(const SweepShared& shared, const SweepRange& range, const Subtree& tree)
{
    if (tree.count == 1 || tree.levels == 0) {
        makeLeaf(shared, range, tree);
        Box box;
        for (uint number : range.sorted[0]) grow(box, shared.boxes[number]);
        return COST_PRIMITIVE * halfArea(box) * tree.count;
    }
    double area = 0;
    const uint leftCount = divide(shared, range, tree.levels, area);
    const Subtree left = leftOf(tree, leftCount), right = rightOf(tree, leftCount);
    shared.nodes[tree.slot] = {tree.first, tree.count, right.slot};
    double cost = COST_NODE * area;
    cost += sweepSubtree(shared, part(range, 0, leftCount), left);
    cost += sweepSubtree(shared, part(range, leftCount, right.count), right);

    // Decided on the way back, when the true cost of dividing is known.
    const double leafCost = COST_PRIMITIVE * area * tree.count;
    if (tree.count > MAX_LEAF_SIZE || cost < leafCost) return cost;
    makeLeaf(shared, range, tree);
    return leafCost;
}

void sortByCentre(std::span<const Box> boxes, std::span<const uint> numbers, int axis,
                  std::span<uint> sorted)
{
    std::vector<std::pair<double, uint>> keys;
    keys.reserve(numbers.size());
    for (uint number : numbers) keys.emplace_back(doubleCentre(boxes[number], axis), number);
    std::sort(keys.begin(), keys.end());
    for (size_t i = 0; i < keys.size(); i++) sorted[i] = keys[i].second;
}

Draft buildSweep(std::span<const Box> boxes, uint levels, unsigned threads)
{
    const size_t count = boxes.size();
    Draft draft;
    draft.nodes.resize(2 * count - 1);
    draft.order.resize(count);
    std::vector<uint> numbers(count), sortedY(count), sortedZ(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::array<std::span<uint>, 3> sorted = {draft.order, sortedY, sortedZ};
    parallelFor(3, threads, [&](size_t axis) {
        sortByCentre(boxes, numbers, static_cast<int>(axis), sorted[axis]);
    });

    std::vector<uint8_t> onLeft(count);
    std::vector<double> areas(count);
    const SweepShared shared = {boxes, onLeft, draft.nodes};
    const SweepRange all = {sorted, numbers, areas};
    std::vector<SweepWork> work =
        divideLarge(shared, {all, {0, static_cast<uint>(count), 0, levels}});
    parallelFor(work.size(), threads,
                [&](size_t i) { sweepSubtree(shared, work[i].range, work[i].tree); });
    return draft;
}

}  // namespace sahl
