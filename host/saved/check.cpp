#include "saved/check.h"

#include "bvh/box.h"
#include "saved/container.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace sahl {

namespace {

constexpr float UNIT_TOLERANCE = 1e-3f;  ///< of squared lengths and cosines of rounded unit vectors

bool isFinite(float x)
{
    return (std::bit_cast<uint32_t>(x) & 0x7f800000u) != 0x7f800000u;
}

/// Whether all hold, without a branch for each: files have millions of numbers.
template <class... Conditions>
bool allOf(Conditions... conditions)
{
    return (int{conditions} & ...) != 0;
}

bool isFinite(const vec3& v)
{
    return allOf(isFinite(v.x), isFinite(v.y), isFinite(v.z));
}

bool isUnit(const vec3& v)
{
    return std::abs(v.x * v.x + v.y * v.y + v.z * v.z - 1) <= UNIT_TOLERANCE;
}

/// Finite and not negative.
bool isAmount(const vec3& v)
{
    return isFinite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

bool sameBits(const vec3& a, const vec3& b)
{
    return std::bit_cast<std::array<uint32_t, 3>>(a) == std::bit_cast<std::array<uint32_t, 3>>(b);
}

/// Numbers of which each is to be met once, all below their count.
class NumberCheck {
public:
    explicit NumberCheck(uint64_t count) : count_(count), seen_((count + 63) / 64) {}

    bool isNew(uint number)
    {
        if (number >= count_) return false;
        const uint64_t bit = uint64_t{1} << (number % 64);
        const bool fresh = (seen_[number / 64] & bit) == 0;
        seen_[number / 64] |= bit;
        return fresh;
    }

private:
    uint64_t count_;
    std::vector<uint64_t> seen_;
};

/// Walks down the tree without recursion, left before right. In a tree that the builder laid out,
/// nodes and primitives then come one after another, so each is met once and nothing can go round
/// in circles.
class TreeCheck {
public:
    TreeCheck(const std::string& file, const DeviceScene& scene) : file_(file), scene_(scene) {}

    /// The tree behind `root`, which owns the nodes and primitives from where the last one ended.
    /// Returns the number of its primitives.
    uint64_t walk(uint root)
    {
        const uint64_t before = primitives_;
        Box below;
        bool arrived = enter(root, below);
        while (!open_.empty()) {
            if (arrived) arrived = leaveChild(below);
            if (open_.empty()) break;
            if (!arrived) {
                const BvhNode& node = scene_.nodes[open_.back().node];
                arrived = enter(open_.back().second ? node.ref1 : node.ref0, below);
            }
        }
        return primitives_ - before;
    }

    /// From now on the trees are those of objects, in which no instances may be.
    void endWorld()
    {
        worldDepth_ = statistics.depth;
        inObjects_ = true;
    }

    /// How a root would be referred to that lies where the last tree ended.
    uint nextNode() const { return static_cast<uint>(nodes_); }
    uint nextPrimitive() const { return static_cast<uint>(primitives_); }

    void requireAllVisited() const
    {
        if (instancesSeen_ != scene_.instances.size()) {
            throw damaged(
                file_, "instances",
                fmt::format("the tree has {} of {}", instancesSeen_, scene_.instances.size()));
        }
        if (nodes_ == scene_.nodes.size() && primitives_ == scene_.primitives.size()) return;
        throw damaged(file_, "nodes",
                      fmt::format("the tree has {} nodes and {} primitives, the file {} and {}",
                                  nodes_, primitives_, scene_.nodes.size(),
                                  scene_.primitives.size()));
    }

    BvhStatistics statistics;

private:
    /// An inner node whose children are being visited.
    struct Open {
        uint node = 0;
        bool second = false;  ///< child 1 is next or under way
        Box box;              ///< of the children done
    };

    Error wrong(const std::string& finding) const
    {
        if (open_.empty()) return damaged(file_, "nodes", "the root: " + finding);
        return damaged(file_, "nodes",
                       fmt::format("child {} of node {}: {}", open_.back().second ? 1 : 0,
                                   open_.back().node, finding));
    }

    /// Visits what a reference names. Returns whether its box is known: that of a leaf.
    bool enter(uint ref, Box& box)
    {
        if (ref == REF_NONE) throw wrong("there is nothing");
        if ((ref & REF_LEAF) != 0) {
            box = leafBox(ref);
            return true;
        }
        if ((ref & REF_INSTANCE) != 0) {
            box = instanceBox(ref & ~REF_INSTANCE);
            return true;
        }
        if (ref != nodes_ || ref >= scene_.nodes.size()) {
            throw wrong(fmt::format("it refers to node {}; {} of {} is expected", ref, nodes_,
                                    scene_.nodes.size()));
        }
        const size_t above = inObjects_ ? worldDepth_ + 1 : 0;  // of the world, and the way back
        if (above + open_.size() >= MAX_STACK_SIZE) {
            throw wrong(fmt::format("the tree is deeper than {} nodes", MAX_STACK_SIZE));
        }
        nodes_++;
        open_.push_back({ref, false, {}});
        statistics.innerNodes = nodes_;
        statistics.depth = std::max(statistics.depth, static_cast<uint32_t>(above + open_.size()));
        return false;
    }

    /// Goes on from a child whose box is `below`. Returns whether that ended the node itself; its
    /// box is then in `below`.
    bool leaveChild(Box& below)
    {
        Open& open = open_.back();
        const BvhNode& node = scene_.nodes[open.node];
        const bool same = open.second
                              ? sameBits(below.lo, node.lo1) && sameBits(below.hi, node.hi1)
                              : sameBits(below.lo, node.lo0) && sameBits(below.hi, node.hi0);
        if (!same) throw wrong("its box is not that of what is below it");
        grow(open.box, below);
        if (!open.second) {
            open.second = true;
            return false;
        }
        below = open.box;
        open_.pop_back();
        return true;
    }

    Box instanceBox(uint index)
    {
        if (inObjects_) throw wrong("an instance inside the object of another");
        if (!instances_.isNew(index)) {
            throw wrong(fmt::format("instance {}; there are {}, and each is met once", index,
                                    scene_.instances.size()));
        }
        instancesSeen_++;
        return {scene_.instances[index].lo, scene_.instances[index].hi};
    }

    Box leafBox(uint ref)
    {
        const uint64_t first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
        const uint count = (ref & (MAX_LEAF_SIZE - 1)) + 1;
        if (first != primitives_ || first + count > scene_.primitives.size()) {
            throw wrong(
                fmt::format("a leaf of {} primitives from {} on; they should begin at {} and "
                            "there are {}",
                            count, first, primitives_, scene_.primitives.size()));
        }
        primitives_ += count;
        statistics.leaves++;
        statistics.largestLeaf = std::max(statistics.largestLeaf, count);
        Box box;
        for (const Primitive& primitive : scene_.primitives.subspan(first, count)) {
            grow(box, boxOf(primitive));
        }
        return box;
    }

    const std::string& file_;
    const DeviceScene& scene_;
    NumberCheck instances_{scene_.instances.size()};
    uint64_t instancesSeen_ = 0;
    bool inObjects_ = false;
    uint32_t worldDepth_ = 0;
    std::vector<Open> open_;  ///< from the root down
    uint64_t nodes_ = 0;      ///< visited, which is the number of the next one
    uint64_t primitives_ = 0;
};

/// The trees of a scene: how many primitives each has, in the order in which they lie in the file.
struct CheckedTrees {
    BvhStatistics statistics;
    uint64_t world = 0;
    std::map<uint, uint64_t> objects;  ///< by reference to their roots
    std::vector<uint64_t> inOrder;     ///< the objects', as they lie in the file
};

/// The object's tree that begins where the last one ended, which one of `roots` must name.
uint nextRoot(const std::string& file, const TreeCheck& check, const std::set<uint>& roots)
{
    const uint leaf = REF_LEAF | check.nextPrimitive() << LEAF_COUNT_BITS;
    const auto found = roots.lower_bound(leaf);
    if (found != roots.end() && *found < leaf + MAX_LEAF_SIZE) return *found;
    if (roots.contains(check.nextNode())) return check.nextNode();
    throw damaged(file, "instances",
                  fmt::format("none has its object's tree at node {}, primitive {}, where the one "
                              "before ends",
                              check.nextNode(), check.nextPrimitive()));
}

CheckedTrees checkTrees(const std::string& file, const DeviceScene& scene, uint rootRef)
{
    TreeCheck check(file, scene);
    if (scene.primitives.empty() != (rootRef == REF_NONE)) {
        throw damaged(file, "nodes", "there are primitives without a tree, or a tree without any");
    }
    CheckedTrees trees;
    if (rootRef != REF_NONE) trees.world = check.walk(rootRef);
    check.endWorld();
    std::set<uint> roots;
    for (const ObjectInstance& instance : scene.instances) roots.insert(instance.rootRef);
    if (!roots.empty()) check.statistics.depth++;
    while (!roots.empty()) {
        const uint root = nextRoot(file, check, roots);
        roots.erase(root);
        const uint64_t count = check.walk(root);
        trees.objects[root] = count;
        trees.inOrder.push_back(count);
    }
    check.requireAllVisited();
    trees.statistics = check.statistics;
    return trees;
}

/// Every primitive has a number of its own below the count of its tree's: it names hits and decides
/// ties, together with the numbers at which the instances begin.
void checkNumbers(const std::string& file, std::span<const Primitive> primitives, size_t first)
{
    NumberCheck numbers(primitives.size());
    for (size_t i = 0; i < primitives.size(); i++) {
        if (numbers.isNew(primitives[i].number)) continue;
        throw damaged(
            file, "primitives",
            fmt::format("primitive {}: its number {} is not below {} or is another one's, "
                        "too",
                        first + i, primitives[i].number, primitives.size()));
    }
}

/// Returns the number of primitives that rays see.
uint64_t checkNumbers(const std::string& file, const DeviceScene& scene, const CheckedTrees& trees)
{
    checkNumbers(file, scene.primitives.first(trees.world), 0);
    uint64_t first = trees.world;
    for (uint64_t count : trees.inOrder) {
        checkNumbers(file, scene.primitives.subspan(first, count), first);
        first += count;
    }
    uint64_t seen = trees.world;
    for (size_t i = 0; i < scene.instances.size(); i++) {
        if (scene.instances[i].firstNumber != seen) {
            throw damaged(file, "instances",
                          fmt::format("number {} counts its primitives from {}, not from {}", i,
                                      scene.instances[i].firstNumber, seen));
        }
        seen += trees.objects.at(scene.instances[i].rootRef);
        if (seen >= NO_HIT) throw damaged(file, "instances", "they show too many primitives");
    }
    return seen;
}

bool isSoundShape(const Primitive& primitive)
{
    if (primitive.shape != SHAPE_SPHERE) return true;
    const Box box = extentOf(primitive);
    return primitive.p1.x > 0 && isFinite(box.lo) && isFinite(box.hi);
}

/// Zero if all components are finite, else not a number: cheaper than to ask each of them.
float vanishing(const Primitive& p)
{
    const vec3 zero = (p.p0 - p.p0) + (p.p1 - p.p1) + (p.p2 - p.p2);
    return (zero.x + zero.y) + zero.z;
}

void checkPrimitives(const std::string& file, const DeviceScene& scene)
{
    auto wrong = [&](size_t i, const std::string& finding) {
        return damaged(file, "primitives", fmt::format("primitive {}: {}", i, finding));
    };
    for (size_t i = 0; i < scene.primitives.size(); i++) {
        const Primitive& primitive = scene.primitives[i];
        if (vanishing(primitive) != 0) throw wrong(i, "a coordinate is not finite");
        if (primitive.material >= scene.materials.size()) {
            throw wrong(
                i, fmt::format("material {} of {}", primitive.material, scene.materials.size()));
        }
        const bool hasNormals = primitive.shape < SHAPE_SPHERE;
        if (hasNormals && primitive.shape >= scene.triangleNormals.size()) {
            throw wrong(
                i, fmt::format("normals {} of {}", primitive.shape, scene.triangleNormals.size()));
        }
        if (!isSoundShape(primitive)) {
            throw wrong(i, "a sphere whose radius is not positive or whose box is not finite");
        }
    }
}

void checkNormals(const std::string& file, std::span<const TriangleNormals> normals)
{
    for (size_t i = 0; i < normals.size(); i++) {
        const TriangleNormals& n = normals[i];
        if (isUnit(n.n0) && isUnit(n.n1) && isUnit(n.n2)) continue;
        throw damaged(file, "normals", fmt::format("those of number {} are not unit vectors", i));
    }
}

bool isSound(const Material& material)
{
    return material.type <= MATERIAL_REPORT && isAmount(material.baseColor) &&
           isAmount(material.emission) && isFinite(material.eta) && material.eta > 0 &&
           isAmount(material.conductorEta) && isAmount(material.conductorK) &&
           isAmount({material.diffuseWeight, material.specularWeight, material.shininess}) &&
           isAmount(material.specularColor) && isAmount(material.ambientColor);
}

bool isSound(const Light& light)
{
    const bool directed = light.type != LIGHT_POINT;
    return light.type <= LIGHT_DIRECTIONAL && isFinite(light.position) &&
           isAmount(light.intensity) && isFinite(light.direction) &&
           (!directed || isUnit(light.direction)) && isFinite(light.cosOuter) &&
           isFinite(light.cosInner);
}

bool isSound(const vec4& texel)
{
    return allOf(isFinite(texel.x), isFinite(texel.y), isFinite(texel.z), texel.x >= 0,
                 texel.y >= 0, texel.z >= 0);
}

bool isFiniteBox(const vec3& lo, const vec3& hi)
{
    return isFinite(lo) && isFinite(hi) && lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z;
}

void checkInstances(const std::string& file, const DeviceScene& scene)
{
    if (scene.instances.size() > MAX_INSTANCES) {
        throw damaged(
            file, "instances",
            fmt::format("there are {}, more than {}", scene.instances.size(), MAX_INSTANCES));
    }
    for (size_t i = 0; i < scene.instances.size(); i++) {
        const ObjectInstance& o = scene.instances[i];
        const bool finite = isFinite(o.toObject0) && isFinite(o.toObject1) &&
                            isFinite(o.toObject2) && isFinite(o.toWorld0) && isFinite(o.toWorld1) &&
                            isFinite(o.toWorld2) && isFinite(o.translation) &&
                            isFiniteBox(o.lo, o.hi);
        const bool painted = o.material == NO_MATERIAL || o.material < scene.materials.size();
        if (finite && painted) continue;
        throw damaged(file, "instances",
                      fmt::format("number {} has a material or a number out of range", i));
    }
}

template <class Element>
void checkEach(const std::string& file, const char* section, std::span<const Element> elements)
{
    bool sound = true;  // of all, without a branch for each
    for (const Element& element : elements) sound &= isSound(element);
    if (sound) return;
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [](const Element& element) { return !isSound(element); });
    throw damaged(file, section,
                  fmt::format("number {} has an unknown type or a number out of range",
                              found - elements.begin()));
}

void checkObjectStarts(const std::string& file, std::span<const uint32_t> starts,
                       uint64_t primitives)
{
    const bool ascend = std::is_sorted(starts.begin(), starts.end());
    if (ascend && (starts.empty() || starts.back() <= primitives)) return;
    throw damaged(file, "objectStarts",
                  fmt::format("they do not ascend or reach beyond the {} primitives", primitives));
}

void checkProbe(const std::string& file, const Probe& probe, uint64_t texels)
{
    if (probe.height == 0) return;
    const uint64_t end = probe.firstTexel + uint64_t{probe.width} * probe.height;
    constexpr uint MAX_SIDE = 1u << 20;
    if (probe.width == 0 || probe.width > MAX_SIDE || probe.height > MAX_SIDE || end > texels) {
        throw damaged(file, "scene",
                      fmt::format("a probe of {} x {} texels from {} on, of {}", probe.width,
                                  probe.height, probe.firstTexel, texels));
    }
    const vec3 cosines(glm::dot(probe.axisX, probe.axisY), glm::dot(probe.axisY, probe.axisZ),
                       glm::dot(probe.axisZ, probe.axisX));
    const bool upright = std::abs(cosines.x) <= UNIT_TOLERANCE &&
                         std::abs(cosines.y) <= UNIT_TOLERANCE &&
                         std::abs(cosines.z) <= UNIT_TOLERANCE;
    if (!upright || !isUnit(probe.axisX) || !isUnit(probe.axisY) || !isUnit(probe.axisZ)) {
        throw damaged(file, "scene", "a probe's axes are not unit vectors at right angles");
    }
}

}  // namespace

BvhStatistics checkArrays(const std::string& file, const DeviceScene& scene, uint rootRef,
                          std::span<const uint32_t> objectStarts)
{
    if (scene.primitives.size() > MAX_PRIMITIVES) {
        throw damaged(
            file, "primitives",
            fmt::format("there are {}, more than {}", scene.primitives.size(), MAX_PRIMITIVES));
    }
    checkPrimitives(file, scene);
    checkNormals(file, scene.triangleNormals);
    checkEach(file, "materials", scene.materials);
    checkEach(file, "lights", scene.lights);
    checkEach(file, "texels", scene.probeTexels);
    checkInstances(file, scene);
    CheckedTrees trees = checkTrees(file, scene, rootRef);
    trees.statistics.primitivesSeen = checkNumbers(file, scene, trees);
    checkObjectStarts(file, objectStarts, trees.statistics.primitivesSeen);
    return trees.statistics;
}

void checkFrame(const std::string& file, const Frame& frame, uint64_t texelCount)
{
    const Camera& camera = frame.camera;
    const bool finite = isFinite(camera.position) && isFinite(camera.right) &&
                        isFinite(camera.down) && isUnit(camera.forward) &&
                        isFinite(camera.lensRight) && isFinite(camera.lensDown) &&
                        isFinite(camera.focusDistance) && isAmount(frame.ambient);
    if (!finite) throw damaged(file, "scene", "the camera reaches beyond the range of numbers");
    checkProbe(file, frame.probe, texelCount);
    checkProbe(file, frame.background, texelCount);
}

}  // namespace sahl
