// Surface area heuristic over 32 bins of the centres on each axis: a few per cent worse trees than
// the sweep in a fraction of its time. Small ranges go to the sweep, where it costs little.
// Wald 2007, "On fast construction of SAH-based bounding volume hierarchies".
#include "bvh/sweep.h"

#include "util/parallel.h"

#include <algorithm>
#include <numeric>

namespace sahl {
namespace {

constexpr uint BIN_COUNT = 32;
constexpr uint SWEEP_BELOW = 512;     ///< primitives for which a sweep is as fast as binning
constexpr uint SUBTREE_SIZE = 16384;  ///< below this a subtree is the work of one thread
constexpr uint CHUNK_SIZE = 16384;    ///< primitives binned at a time; minima, maxima and counts
                                      ///< come out the same however they are grouped

struct Bin {
    Box box;
    uint count = 0;
};

using Bins = std::array<std::array<Bin, BIN_COUNT>, 3>;

/// Range of the centres, doubled as in doubleCentre().
struct Centres {
    std::array<double, 3> lo, hi;
    Centres()
    {
        lo.fill(std::numeric_limits<double>::infinity());
        hi.fill(-std::numeric_limits<double>::infinity());
    }
};

struct BinnedShared {
    std::span<const Box> boxes;
    std::span<uint> order;    ///< ascending numbers within every range not yet divided
    std::span<uint> scratch;  ///< as long as `order`
    std::span<uint8_t> onLeft;
    std::span<DraftNode> nodes;
};

uint binOf(double centre, const Centres& centres, int axis)
{
    const double extent = centres.hi[axis] - centres.lo[axis];
    const double position = (centre - centres.lo[axis]) * (BIN_COUNT / extent);
    return std::min(static_cast<uint>(position), BIN_COUNT - 1);
}

Centres centresOf(std::span<const Box> boxes, std::span<const uint> numbers)
{
    Centres centres;
    for (uint number : numbers) {
        for (int axis = 0; axis < 3; axis++) {
            double centre = doubleCentre(boxes[number], axis);
            centres.lo[axis] = std::min(centres.lo[axis], centre);
            centres.hi[axis] = std::max(centres.hi[axis], centre);
        }
    }
    return centres;
}

Bins binsOf(std::span<const Box> boxes, std::span<const uint> numbers, const Centres& centres)
{
    Bins bins;
    for (uint number : numbers) {
        for (int axis = 0; axis < 3; axis++) {
            if (!(centres.lo[axis] < centres.hi[axis])) continue;
            const Box& box = boxes[number];
            Bin& bin = bins[axis][binOf(doubleCentre(box, axis), centres, axis)];
            grow(bin.box, box);
            bin.count++;
        }
    }
    return bins;
}

/// Results of `measure(chunk)` for the chunks of a range, computed on all threads.
template <class Measure>
auto overChunks(std::span<const uint> numbers, unsigned threads, const Measure& measure)
{
    const size_t chunkCount = (numbers.size() + CHUNK_SIZE - 1) / CHUNK_SIZE;
    std::vector<decltype(measure(numbers))> results(chunkCount);
    parallelFor(chunkCount, threads, [&](size_t i) {
        const size_t first = i * CHUNK_SIZE;
        const size_t count = std::min<size_t>(CHUNK_SIZE, numbers.size() - first);
        results[i] = measure(numbers.subspan(first, count));
    });
    return results;
}

Centres allCentres(const BinnedShared& shared, std::span<const uint> numbers, unsigned threads)
{
    Centres all;
    auto measure = [&](std::span<const uint> chunk) { return centresOf(shared.boxes, chunk); };
    for (const Centres& some : overChunks(numbers, threads, measure)) {
        for (int axis = 0; axis < 3; axis++) {
            all.lo[axis] = std::min(all.lo[axis], some.lo[axis]);
            all.hi[axis] = std::max(all.hi[axis], some.hi[axis]);
        }
    }
    return all;
}

Bins allBins(const BinnedShared& shared, std::span<const uint> numbers, const Centres& centres,
             unsigned threads)
{
    Bins all;
    auto measure = [&](std::span<const uint> chunk) {
        return binsOf(shared.boxes, chunk, centres);
    };
    for (const Bins& some : overChunks(numbers, threads, measure)) {
        for (int axis = 0; axis < 3; axis++) {
            for (uint i = 0; i < BIN_COUNT; i++) {
                grow(all[axis][i].box, some[axis][i].box);
                all[axis][i].count += some[axis][i].count;
            }
        }
    }
    return all;
}

/// Tries the borders between bins along one axis.
void sweepBins(const std::array<Bin, BIN_COUNT>& bins, int axis, uint count, uint levelsBelow,
               Split& best)
{
    std::array<double, BIN_COUNT> rightArea;
    Box right;
    for (uint i = BIN_COUNT; i-- > 1;) {
        grow(right, bins[i].box);
        rightArea[i] = halfArea(right);
    }
    Box left;
    uint leftCount = 0;
    for (uint i = 1; i < BIN_COUNT; i++) {
        grow(left, bins[i - 1].box);
        leftCount += bins[i - 1].count;
        if (leftCount == 0 || leftCount == count || !fits(leftCount, count, levelsBelow)) continue;
        double cost = halfArea(left) * leftCount + rightArea[i] * (count - leftCount);
        keepBetter(best, {cost, axis, leftCount, i}, count);
    }
}

/// Marks the lower half of the range by centre along its longest axis. For where bins find nothing:
/// all centres equal, or no levels to spare.
uint markMedian(const BinnedShared& shared, std::span<const uint> numbers, const Centres& centres)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++) {
        if (centres.hi[axis] - centres.lo[axis] > centres.hi[longest] - centres.lo[longest])
            longest = axis;
    }
    std::vector<std::pair<double, uint>> keys;
    keys.reserve(numbers.size());
    for (uint number : numbers)
        keys.emplace_back(doubleCentre(shared.boxes[number], longest), number);
    const size_t half = keys.size() / 2;
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(half), keys.end());
    for (size_t i = 0; i < keys.size(); i++) shared.onLeft[keys[i].second] = i < half;
    return static_cast<uint>(half);
}

/// Divides a range in two, keeping ascending numbers on both sides. Returns the left side's count.
uint divide(const BinnedShared& shared, const Subtree& tree, unsigned threads)
{
    const std::span<uint> numbers = shared.order.subspan(tree.first, tree.count);
    const Centres centres = allCentres(shared, numbers, threads);
    const Bins bins = allBins(shared, numbers, centres, threads);
    Split best;
    for (int axis = 0; axis < 3; axis++)
        sweepBins(bins[axis], axis, tree.count, tree.levels - 1, best);
    uint leftCount = best.leftCount;
    if (leftCount == 0) {
        leftCount = markMedian(shared, numbers, centres);
    } else {
        const int axis = best.axis;
        for (uint number : numbers) {
            const double centre = doubleCentre(shared.boxes[number], axis);
            shared.onLeft[number] = binOf(centre, centres, axis) < best.bin;
        }
    }
    size_t left = 0, right = 0;
    for (uint number : numbers) {
        if (shared.onLeft[number])
            numbers[left++] = number;
        else
            shared.scratch[tree.first + right++] = number;
    }
    std::copy_n(shared.scratch.begin() + tree.first, right,
                numbers.begin() + static_cast<std::ptrdiff_t>(left));
    return leftCount;
}

void sweepSmall(const BinnedShared& shared, const Subtree& tree)
{
    const std::span<uint> numbers = shared.order.subspan(tree.first, tree.count);
    std::array<std::array<uint, SWEEP_BELOW>, 3> sorted;
    std::array<double, SWEEP_BELOW> areas;
    SweepRange range;
    for (int axis = 0; axis < 3; axis++) {
        range.sorted[axis] = std::span(sorted[axis]).first(tree.count);
        sortByCentre(shared.boxes, numbers, axis, range.sorted[axis]);
    }
    range.scratch = shared.scratch.subspan(tree.first, tree.count);
    range.areas = std::span(areas).first(tree.count);
    sweepSubtree({shared.boxes, shared.onLeft, shared.nodes}, range, tree);
    std::copy(range.sorted[0].begin(), range.sorted[0].end(), numbers.begin());
}

/// Divides `root` until nothing above `size` primitives is left; returns what is left.
std::vector<Subtree> divideDownTo(const BinnedShared& shared, const Subtree& root, uint size,
                                  unsigned threads)
{
    std::vector<Subtree> pending = {root}, small;
    while (!pending.empty()) {
        const Subtree tree = pending.back();
        pending.pop_back();
        if (tree.count <= size) {
            small.push_back(tree);
            continue;
        }
        const uint leftCount = divide(shared, tree, threads);
        const Subtree left = leftOf(tree, leftCount), right = rightOf(tree, leftCount);
        shared.nodes[tree.slot] = {tree.first, tree.count, right.slot};
        pending.push_back(right);
        pending.push_back(left);
    }
    return small;
}

}  // namespace

Draft buildBinned(std::span<const Box> boxes, uint levels, unsigned threads)
{
    const size_t count = boxes.size();
    Draft draft;
    draft.nodes.resize(2 * count - 1);
    draft.order.resize(count);
    std::iota(draft.order.begin(), draft.order.end(), 0u);
    std::vector<uint> scratch(count);
    std::vector<uint8_t> onLeft(count);
    const BinnedShared shared = {boxes, draft.order, scratch, onLeft, draft.nodes};
    const Subtree all = {0, static_cast<uint>(count), 0, levels};
    const std::vector<Subtree> work = divideDownTo(shared, all, SUBTREE_SIZE, threads);
    parallelFor(work.size(), threads, [&](size_t i) {
        for (const Subtree& small : divideDownTo(shared, work[i], SWEEP_BELOW, 1))
            sweepSmall(shared, small);
    });
    return draft;
}

}  // namespace sahl
