// A built tree made better: subtrees are taken out and put in again where the tree becomes cheapest.
// Meister and Bittner 2018, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", with the
// moves of a round found in parallel on the unchanged tree and made one after the other, best first: so
// the result does not depend on the threads.
//
// Spatial splits (Stich et al. 2009) are no choice here: a box that is cut off from a primitive's own does
// not enclose it, and the closest hit would depend on the tree (shaders/pathtrace/traverse.glsl).
#include "bvh/reinsert.h"

#include "util/parallel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sahl {
namespace {

constexpr uint NONE = 0xffffffffu;
constexpr uint STRIDE = 4;        ///< rounds after which every node has had its turn
constexpr uint MOST_ROUNDS = 64;
constexpr uint MOST_VISITS = 1024;  ///< of nodes in search of one move: boxes within boxes can ask for all
constexpr size_t CHUNK = 1024;
constexpr uint DEEPEST = 1000;  ///< inner nodes one after another that the recursions below are made for

/// Nodes below `leafCount` are the leaves, of one primitive each, by number of the primitive.
struct Tree {
    std::vector<Box> boxes;
    std::vector<uint> parents;                  ///< NONE for the root
    std::vector<std::array<uint, 2>> children;  ///< NONE for leaves
    uint root = NONE;
    uint leafCount = 0;

    bool isLeaf(uint node) const { return node < leafCount; }
    uint sibling(uint node) const
    {
        const auto& [a, b] = children[parents[node]];
        return a == node ? b : a;
    }
};

Box unionOf(const Box& a, const Box& b)
{
    Box box = a;
    grow(box, b);
    return box;
}

uint appendInner(Tree& tree, uint left, uint right)
{
    const auto node = static_cast<uint>(tree.boxes.size());
    tree.boxes.push_back(unionOf(tree.boxes[left], tree.boxes[right]));
    tree.children.push_back({left, right});
    tree.parents.push_back(NONE);
    tree.parents[left] = tree.parents[right] = node;
    return node;
}

/// The primitives order[first .. first + count) as a subtree of halves.
uint appendHalves(Tree& tree, std::span<const uint> numbers)
{
    if (numbers.size() == 1) return numbers[0];
    const size_t half = numbers.size() / 2;
    const uint left = appendHalves(tree, numbers.first(half));
    return appendInner(tree, left, appendHalves(tree, numbers.subspan(half)));
}

uint appendDraft(Tree& tree, const Draft& draft, uint slot)
{
    const DraftNode& node = draft.nodes[slot];
    if (node.right == 0) return appendHalves(tree, std::span(draft.order).subspan(node.first, node.count));
    const uint left = appendDraft(tree, draft, slot + 1);
    return appendInner(tree, left, appendDraft(tree, draft, node.right));
}

Tree treeOf(const Draft& draft, std::span<const Box> boxes)
{
    Tree tree;
    tree.leafCount = static_cast<uint>(boxes.size());
    tree.boxes.reserve(2 * boxes.size());
    tree.boxes.assign(boxes.begin(), boxes.end());
    tree.parents.assign(boxes.size(), NONE);
    tree.children.assign(boxes.size(), {NONE, NONE});
    tree.root = appendDraft(tree, draft, 0);
    return tree;
}

/// Half areas of all inner nodes: what moves make smaller.
double costOf(const Tree& tree)
{
    double cost = 0;
    for (size_t node = tree.leafCount; node < tree.boxes.size(); node++) cost += halfArea(tree.boxes[node]);
    return cost;
}

/// A node, its new sibling, and by how much that makes half areas of inner nodes smaller [m^2].
struct Move {
    uint node = NONE, target = NONE;
    double gain = 0;
};

/// A subtree that may hold a better sibling, and what is gained so far on the way to it.
struct Pending {
    double gain;
    uint node;
};

/// The best place for a node: branch and bound over the siblings of its ancestors, nearest first. What the
/// node leaves behind shrinks its ancestors up to the one below which it comes back (`pivot`); what it
/// comes into grows.
Move bestMove(const Tree& tree, uint node, std::vector<Pending>& pending)
{
    const Box& box = tree.boxes[node];
    const double area = halfArea(box);
    const uint parent = tree.parents[node];
    Move best = {node, NONE, 0};
    double freed = halfArea(tree.boxes[parent]);
    Box left = tree.boxes[tree.sibling(node)];  // of the pivot without the node
    uint from = tree.sibling(node), visits = 0;
    for (uint pivot = parent;;) {
        pending.push_back({freed, from});
        while (!pending.empty()) {
            if (visits++ == MOST_VISITS) {
                pending.clear();
                return best;
            }
            const auto [gain, target] = pending.back();
            pending.pop_back();
            if (gain - area <= best.gain) continue;  // the new parent encloses the node at least
            const double remaining = gain - halfArea(unionOf(tree.boxes[target], box));
            const bool stays = pivot == parent && target == tree.sibling(node);
            if (remaining > best.gain && !stays) best = {node, target, remaining};
            if (tree.isLeaf(target)) continue;
            const double below = remaining + halfArea(tree.boxes[target]);
            for (uint child : tree.children[target]) pending.push_back({below, child});
        }
        const uint above = tree.parents[pivot];
        if (above == NONE) return best;
        from = tree.sibling(pivot);
        if (pivot != parent) freed += halfArea(tree.boxes[pivot]) - halfArea(left);
        grow(left, tree.boxes[from]);
        pivot = above;
    }
}

void replaceChild(Tree& tree, uint parent, uint child, uint by)
{
    tree.parents[by] = parent;
    if (parent == NONE)
        tree.root = by;
    else
        tree.children[parent][tree.children[parent][0] == child ? 0 : 1] = by;
}

void refitFrom(Tree& tree, uint node)
{
    for (; node != NONE; node = tree.parents[node]) {
        const auto& [a, b] = tree.children[node];
        tree.boxes[node] = unionOf(tree.boxes[a], tree.boxes[b]);
    }
}

bool isAncestor(const Tree& tree, uint ancestor, uint node)
{
    while (node != NONE && node != ancestor) node = tree.parents[node];
    return node == ancestor;
}

/// Takes the node's parent out with it and puts both in above the target.
void make(Tree& tree, const Move& move)
{
    const uint parent = tree.parents[move.node], above = tree.parents[parent];
    replaceChild(tree, above, parent, tree.sibling(move.node));
    refitFrom(tree, above);
    replaceChild(tree, tree.parents[move.target], move.target, parent);
    tree.children[parent] = {move.target, move.node};
    tree.parents[move.target] = parent;
    refitFrom(tree, parent);
}

/// The best moves of every STRIDE-th node from `first` on, of those that have one.
std::vector<Move> findMoves(const Tree& tree, uint first, unsigned threads)
{
    const size_t count = (tree.boxes.size() - first + STRIDE - 1) / STRIDE;
    const size_t chunks = (count + CHUNK - 1) / CHUNK;
    std::vector<std::vector<Move>> found(chunks);
    parallelFor(chunks, threads, [&](size_t chunk) {
        std::vector<Pending> pending;
        const size_t end = std::min(count, (chunk + 1) * CHUNK);
        for (size_t i = chunk * CHUNK; i < end; i++) {
            const auto node = static_cast<uint>(first + i * STRIDE);
            if (node == tree.root) continue;
            const Move move = bestMove(tree, node, pending);
            if (move.target != NONE) found[chunk].push_back(move);
        }
    });
    std::vector<Move> moves;
    for (const auto& some : found) moves.insert(moves.end(), some.begin(), some.end());
    return moves;
}

/// Makes the moves, the best first, but those that touch a node which an earlier one has touched.
void makeMoves(Tree& tree, std::vector<Move>& moves, std::vector<bool>& touched)
{
    std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
        return a.gain != b.gain ? a.gain > b.gain : a.node < b.node;
    });
    touched.assign(tree.boxes.size(), false);
    for (const Move& move : moves) {
        const uint parent = tree.parents[move.node];
        if (parent == NONE || tree.parents[move.target] == NONE) continue;  // the root has changed
        const uint above = tree.parents[parent] == NONE ? parent : tree.parents[parent];
        const std::array<uint, 6> nodes = {move.node, parent, above, tree.sibling(move.node),
                                           move.target, tree.parents[move.target]};
        if (std::any_of(nodes.begin(), nodes.end(), [&](uint node) { return touched[node]; })) continue;
        if (isAncestor(tree, move.node, move.target)) continue;
        for (uint node : nodes) touched[node] = true;
        make(tree, move);
    }
}

/// From the tree to ranges of primitives again, with leaves where they are cheaper.
class Drafting {
public:
    Drafting(const Tree& tree, Draft& draft) : tree_(tree), draft_(draft), counts_(tree.boxes.size(), 1)
    {
        becomesLeaf_.assign(tree.boxes.size(), false);
        decide(tree.root, 0);
    }

    /// False, and nothing is written, when more than `levels` inner nodes would follow one another.
    bool write(uint levels)
    {
        if (depth_ > levels) return false;
        write(tree_.root, 0);
        return true;
    }

private:
    /// Returns the cost of the subtree.
    double decide(uint node, uint level)
    {
        const double area = halfArea(tree_.boxes[node]);
        if (tree_.isLeaf(node) || level == DEEPEST) {
            depth_ = std::max(depth_, level);
            return COST_PRIMITIVE * area;
        }
        const auto& [left, right] = tree_.children[node];
        const double divided = COST_NODE * area + decide(left, level + 1) + decide(right, level + 1);
        counts_[node] = counts_[left] + counts_[right];
        const double whole = COST_PRIMITIVE * area * counts_[node];
        becomesLeaf_[node] = counts_[node] <= MAX_LEAF_SIZE && whole <= divided;
        return becomesLeaf_[node] ? whole : divided;
    }

    void gather(uint node)
    {
        if (tree_.isLeaf(node)) {
            draft_.order[next_++] = node;
            return;
        }
        for (uint child : tree_.children[node]) gather(child);
    }

    void write(uint node, uint slot)
    {
        const uint first = next_, count = counts_[node];
        if (tree_.isLeaf(node) || becomesLeaf_[node]) {
            gather(node);
            std::sort(draft_.order.begin() + first, draft_.order.begin() + first + count);
            draft_.nodes[slot] = {first, count, 0};
            return;
        }
        const auto& [left, right] = tree_.children[node];
        const uint rightSlot = slot + 2 * counts_[left];
        draft_.nodes[slot] = {first, count, rightSlot};
        write(left, slot + 1);
        write(right, rightSlot);
    }

    const Tree& tree_;
    Draft& draft_;
    std::vector<uint> counts_;  ///< primitives below
    std::vector<bool> becomesLeaf_;
    uint next_ = 0, depth_ = 0;
};

}  // namespace

void improveByReinsertion(Draft& draft, std::span<const Box> boxes, uint levels, ReinsertionEnd end,
                          unsigned threads)
{
    if (boxes.size() < 4) return;
    Tree tree = treeOf(draft, boxes);
    std::vector<bool> touched;
    double before = costOf(tree);
    for (uint round = 0; round < MOST_ROUNDS; round++) {
        std::vector<Move> moves = findMoves(tree, round % STRIDE, threads);
        makeMoves(tree, moves, touched);
        if ((round + 1) % end.rounds != 0) continue;
        const double cost = costOf(tree);
        if (!(cost < before * (1 - end.gain))) {
            if (round + 1 == end.rounds) return;  // not worth writing it anew
            break;
        }
        before = cost;
    }
    Drafting(tree, draft).write(levels);
}

}  // namespace sahl
