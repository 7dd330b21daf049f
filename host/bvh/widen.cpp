#include "bvh/widen.h"

#include "bvh/box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace sahl {
namespace {

constexpr int LARGEST_STEP = 40;    ///< steps are 2^k; a ray's inverse is at most 2^60
constexpr int SMALLEST_STEP = -80;  ///< and at least 2^-32 (LARGEST_STRETCH)
constexpr int LARGEST_COUNT = 100;  ///< an origin is at most 2^100 steps away
constexpr double LAST_PLANE = 65535;

/// Along one axis: plane q lies at (q + at) 2^step.
struct Axis {
    double at = 0;
    int step = 0;
};

using Grid = std::array<Axis, 3>;

struct Child {
    uint ref = REF_NONE;
    Box box;
};

std::array<Child, 2> childrenOf(const BvhNode& node)
{
    return {{{node.ref0, {node.lo0, node.hi0}}, {node.ref1, {node.lo1, node.hi1}}}};
}

bool isInner(uint ref)
{
    return (ref & REF_NOT_INNER) == 0;
}

/// Exact: floats scaled by powers of two that leave them in the range of double.
double lowerPlane(float x, int step)
{
    return std::floor(std::ldexp(double{x}, -step));
}

double upperPlane(float x, int step)
{
    return std::ceil(std::ldexp(double{x}, -step));
}

/// The finest grid that holds [lo, hi] and origins up to `reach`; nothing where a step would be too
/// large.
std::optional<Axis> axisOver(float lo, float hi, double reach)
{
    // frexp: x < 2^exponent
    const auto exponentOf = [](double x) {
        int exponent = 0;
        std::frexp(x, &exponent);
        return exponent;
    };
    int step = std::max({SMALLEST_STEP, exponentOf((double{hi} - double{lo}) / LAST_PLANE) - 1,
                         exponentOf(reach) - LARGEST_COUNT});
    while (upperPlane(hi, step) - lowerPlane(lo, step) > LAST_PLANE) step++;
    if (step > LARGEST_STEP) return std::nullopt;
    // A float, as `lo` is one and floor() leaves no more digits
    return Axis{lowerPlane(lo, step), step};
}

/// The planes of a box along one axis, as WideNode has them.
uint planesOf(const Axis& axis, float lo, float hi)
{
    const auto lower = static_cast<uint>(lowerPlane(lo, axis.step) - axis.at);
    const auto upper = static_cast<uint>(upperPlane(hi, axis.step) - axis.at);
    return lower | upper << 16;
}

/// Expected cost of a wide node and of a primitive for a ray that reaches them, relative to each
/// other. Measured: from 0.3 to 0.6 nothing changes.
constexpr double COST_WIDE_NODE = 1.0;
constexpr double COST_WIDE_PRIMITIVE = 0.4;

/// How a binary tree is best collapsed: for every node the least cost of all below it when it is
/// replaced by at most 1, 2 or 3 subtrees (a leaf counts as one), each in the place of a child.
/// Wald, Benthin and Boulos 2008, "Getting Rid of Packets", have the collapse by surface area;
/// Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs", Sec. 3, its optimum.
class Collapse {
public:
    explicit Collapse(std::span<const BvhNode> nodes) : nodes_(nodes), parts_(nodes.size())
    {
        // Children follow their parents
        for (size_t i = nodes.size(); i-- > 0;) parts_[i] = partOf(static_cast<uint>(i));
    }

    /// The children of the wide node that takes the place of a binary one.
    std::vector<Child> childrenOfWide(uint ref) const
    {
        std::vector<Child> children;
        divide(ref, 4, children);
        return children;
    }

private:
    struct Part {
        std::array<double, 3> cost = {};  ///< as at most 1, 2, 3 subtrees
        uint first =
            0;  ///< primitives below, of which there are `count`; 0: more than a leaf holds
        uint count = 0;
        bool isLeaf = false;  ///< best as one
    };

    Part partOfRef(const Child& child) const
    {
        if (isInner(child.ref)) return parts_[child.ref];
        Part part;
        double tests = 1;
        if ((child.ref & REF_LEAF) != 0) {
            part.first = (child.ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
            part.count = (child.ref & (MAX_LEAF_SIZE - 1)) + 1;
            tests = part.count;
        }
        part.cost.fill(halfArea(child.box) * tests * COST_WIDE_PRIMITIVE);
        return part;
    }

    /// Least cost as `parts` subtrees in all, and how many of them are on the left.
    static std::pair<double, uint> bestDivision(const Part& left, const Part& right, uint parts)
    {
        std::pair<double, uint> best = {INFINITY, 0};
        for (uint k = 1; k < parts; k++) {
            if (k > 3 || parts - k > 3) continue;
            const double cost = left.cost[k - 1] + right.cost[parts - k - 1];
            if (cost < best.first) best = {cost, k};
        }
        return best;
    }

    Part partOf(uint index) const
    {
        const auto two = childrenOf(nodes_[index]);
        const Part left = partOfRef(two[0]), right = partOfRef(two[1]);
        Box box = two[0].box;
        grow(box, two[1].box);
        const double area = halfArea(box);
        Part part;
        part.first = left.first;
        const bool together = left.count > 0 && right.count > 0 &&
                              left.count + right.count <= MAX_LEAF_SIZE &&
                              left.first + left.count == right.first;
        part.count = together ? left.count + right.count : 0;
        const double asNode = bestDivision(left, right, 4).first + area * COST_WIDE_NODE;
        const double asLeaf = together ? area * part.count * COST_WIDE_PRIMITIVE : INFINITY;
        part.isLeaf = asLeaf <= asNode;
        part.cost[0] = std::min(asLeaf, asNode);
        part.cost[1] = std::min(part.cost[0], bestDivision(left, right, 2).first);
        part.cost[2] = std::min(part.cost[1], bestDivision(left, right, 3).first);
        return part;
    }

    void divide(uint ref, uint parts, std::vector<Child>& children) const
    {
        const auto two = childrenOf(nodes_[ref]);
        const uint k = bestDivision(partOfRef(two[0]), partOfRef(two[1]), parts).second;
        add(two[0], k, children);
        add(two[1], parts - k, children);
    }

    /// A subtree as at most `parts` children.
    void add(const Child& child, uint parts, std::vector<Child>& children) const
    {
        if (isInner(child.ref)) {
            const Part& part = parts_[child.ref];
            while (parts > 1 && part.cost[parts - 2] <= part.cost[parts - 1]) parts--;
            if (parts > 1) return divide(child.ref, parts, children);
            if (part.isLeaf) {
                const uint leaf = REF_LEAF | (part.first << LEAF_COUNT_BITS) | (part.count - 1);
                children.push_back({leaf, child.box});
                return;
            }
        }
        children.push_back(child);
    }

    std::span<const BvhNode> nodes_;
    std::vector<Part> parts_;
};

class Widening {
public:
    Widening(std::span<const BvhNode> nodes, std::span<const ObjectInstance> instances,
             WideTrees& result)
        : nodes_(nodes), instances_(instances), collapse_(nodes), result_(result)
    {
    }

    struct Tree {
        uint ref = REF_NONE;
        Grid grid;
        uint pending = 0;
        uint groups = 0;
    };

    /// Nothing where no grid fits. Objects first: their trees are asked for by those with
    /// instances.
    std::optional<Tree> addTree(uint rootRef, double reach)
    {
        Tree tree = {rootRef, {}, 0, 0};
        if (isInner(rootRef)) {
            Box box;
            for (const Child& child : childrenOf(nodes_[rootRef])) grow(box, child.box);
            for (int i = 0; i < 3; i++) {
                const auto axis = axisOver(box.lo[i], box.hi[i], reach);
                if (!axis) return std::nullopt;
                tree.grid[static_cast<size_t>(i)] = *axis;
            }
        }
        const Place root = add(rootRef, tree.grid);
        tree.ref = root.ref;
        tree.pending = root.pending;
        tree.groups = root.groups;
        return tree;
    }

    /// Largest coordinate of the surfaces on which rays may start [m].
    double reachOfWorld(uint rootRef) const
    {
        Box box;
        if (isInner(rootRef)) {
            for (const Child& child : childrenOf(nodes_[rootRef])) grow(box, child.box);
        } else if (isInstance(rootRef)) {
            const ObjectInstance& instance = instances_[rootRef & ~REF_INSTANCE];
            box = {instance.lo, instance.hi};
        } else {
            return 0;
        }
        double largest = 0;
        for (int i = 0; i < 3; i++)
            largest = std::max({largest, std::abs(double{box.lo[i]}), std::abs(double{box.hi[i]})});
        return largest;
    }

    std::map<uint, Tree> objects;  ///< by rootRef of the binary tree

private:
    struct Place {
        uint ref = REF_NONE;
        uint pending = 0;  ///< that wait at most, of those below
        uint groups = 0;
    };

    /// Recursion is as deep as the binary tree: at most MAX_STACK_SIZE.
    Place add(uint ref, const Grid& grid)
    {
        if (isInstance(ref)) return {ref, 1 + objectOf(ref).pending, 1 + objectOf(ref).groups};
        if (!isInner(ref)) return {ref, 0, 0};
        const std::vector<Child> children = collapse_.childrenOfWide(ref);
        const auto index = static_cast<uint>(result_.nodes.size());
        result_.nodes.emplace_back();
        WideNode node = {uvec4(0), uvec4(0), uvec4(0), uvec4(REF_NONE)};
        uint deepest = 0, groups = 0;
        for (int i = 0; i < static_cast<int>(children.size()); i++) {
            const Child& child = children[static_cast<size_t>(i)];
            node.x[i] = planesOf(grid[0], child.box.lo.x, child.box.hi.x);
            node.y[i] = planesOf(grid[1], child.box.lo.y, child.box.hi.y);
            node.z[i] = planesOf(grid[2], child.box.lo.z, child.box.hi.z);
            const Place place = add(child.ref, grid);
            node.refs[i] = place.ref;
            deepest = std::max(deepest, place.pending);
            groups = std::max(groups, place.groups);
        }
        result_.nodes[index] = node;
        return {index | static_cast<uint>(children.size() - 1) << WIDE_CHILDREN_SHIFT, deepest + static_cast<uint>(children.size()) - 1, groups + (children.size() > 1 ? 1 : 0)};
    }

    static bool isInstance(uint ref) { return (ref & REF_NOT_INNER) == REF_INSTANCE; }

    const Tree& objectOf(uint ref) const
    {
        return objects.at(instances_[ref & ~REF_INSTANCE].rootRef);
    }

    std::span<const BvhNode> nodes_;
    std::span<const ObjectInstance> instances_;
    Collapse collapse_;
    WideTrees& result_;
};

vec3 gridAtOf(const Grid& grid)
{
    return {static_cast<float>(grid[0].at), static_cast<float>(grid[1].at),
            static_cast<float>(grid[2].at)};
}

uint gridScaleOf(const Grid& grid)
{
    const auto byte = [&](size_t i) {
        return static_cast<uint>(grid[i].step + static_cast<int>(GRID_BIAS));
    };
    return byte(0) | byte(1) << 8 | byte(2) << 16;
}

/// No ray that has been moved into the space of the object starts at a coordinate beyond it.
double reachInside(const ObjectInstance& instance, double reach)
{
    const glm::dvec3 r = glm::abs(glm::dvec3(instance.translation)) + reach;
    double largest = 0;
    for (const vec3& row : {instance.toObject0, instance.toObject1, instance.toObject2})
        largest = std::max(largest, glm::dot(glm::abs(glm::dvec3(row)), r));
    return 1.001 * largest;  // rounding
}

}  // namespace

WideTrees widen(std::span<const BvhNode> nodes, std::span<const ObjectInstance> instances,
                uint rootRef, double reach)
{
    WideTrees result;
    Widening widening(nodes, instances, result);
    result.nodes.reserve(nodes.size() / 2 + 1);
    reach = std::max(reach, widening.reachOfWorld(rootRef));
    std::map<uint, double> reaches;
    for (const ObjectInstance& instance : instances) {
        double& largest = reaches[instance.rootRef];
        largest = std::max(largest, reachInside(instance, reach));
    }
    for (const auto& [ref, objectReach] : reaches) {
        const auto tree = widening.addTree(ref, objectReach);
        if (!tree) return {};
        widening.objects[ref] = *tree;
    }
    const auto world = widening.addTree(rootRef, reach);
    if (!world || result.nodes.size() > WIDE_INDEX) return {};
    result.rootRef = world->ref;
    result.worstPending = world->pending;
    result.worstGroups = world->groups;
    result.gridAt = gridAtOf(world->grid);
    result.gridScale = gridScaleOf(world->grid);
    result.instances.assign(instances.begin(), instances.end());
    for (ObjectInstance& instance : result.instances) {
        const auto& object = widening.objects.at(instance.rootRef);
        instance.rootRef = object.ref;
        const vec3 at = gridAtOf(object.grid);
        instance.gridX = at.x;
        instance.gridY = at.y;
        instance.gridZ = at.z;
        instance.gridScale = gridScaleOf(object.grid);
    }
    return result;
}

}  // namespace sahl
