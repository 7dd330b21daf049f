// Trees by Embree's builder of high quality, as nodes of ours.
#include "app/bench/embree.h"
#include "app/bench/embree_library.h"
#include "bvh/box.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>

namespace sahl {

namespace {

struct BuiltNode {
    std::array<BuiltNode*, 2> children = {};  ///< null in leaves
    std::array<Box, 2> boxes;
    const uint* primitives = nullptr;  ///< of a leaf
    uint count = 0;
};

Box boxOf(const RTCBounds& bounds)
{
    return {{bounds.lower_x, bounds.lower_y, bounds.lower_z}, {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

RTCBounds boundsOf(const Box& box)
{
    return {box.lo.x, box.lo.y, box.lo.z, 0, box.hi.x, box.hi.y, box.hi.z, 0};
}

struct BuildInput {
    const EmbreeLibrary& library;
    std::span<const Primitive> primitives;
};

template <class T>
T* allocate(const EmbreeLibrary& library, RTCThreadLocalAllocator allocator, size_t count)
{
    return static_cast<T*>(library.threadLocalAlloc(allocator, count * sizeof(T), 16));
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void* user)
{
    return new (allocate<BuiltNode>(static_cast<BuildInput*>(user)->library, allocator, 1)) BuiltNode();
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void* user)
{
    const EmbreeLibrary& library = static_cast<BuildInput*>(user)->library;
    auto* node = new (allocate<BuiltNode>(library, allocator, 1)) BuiltNode();
    uint* numbers = allocate<uint>(library, allocator, count);
    for (size_t i = 0; i < count; i++) numbers[i] = primitives[i].primID;
    node->primitives = numbers;
    node->count = static_cast<uint>(count);
    return node;
}

void setChildren(void* node, void** children, unsigned count, void*)
{
    for (unsigned i = 0; i < count; i++)
        static_cast<BuiltNode*>(node)->children[i] = static_cast<BuiltNode*>(children[i]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*)
{
    for (unsigned i = 0; i < count; i++) static_cast<BuiltNode*>(node)->boxes[i] = boxOf(*bounds[i]);
}

Box intersection(const Box& a, const Box& b)
{
    return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

/// The boxes of a triangle's parts on both sides of a plane.
void splitPrimitive(const RTCBuildPrimitive* part, unsigned axis, float position, RTCBounds* left,
                    RTCBounds* right, void* user)
{
    const Primitive& shape = static_cast<BuildInput*>(user)->primitives[part->primID];
    const std::array<vec3, 3> corners = {shape.p0, shape.p1, shape.p2};
    Box lower, upper;
    for (size_t i = 0; i < 3; i++) {
        const vec3 a = corners[i], b = corners[(i + 1) % 3];
        if (a[axis] <= position) grow(lower, a, a);
        if (a[axis] >= position) grow(upper, a, a);
        if ((a[axis] < position) == (b[axis] < position)) continue;
        vec3 crossing = a + (b - a) * ((position - a[axis]) / (b[axis] - a[axis]));
        crossing[axis] = position;
        grow(lower, crossing, crossing);
        grow(upper, crossing, crossing);
    }
    const Box whole = {{part->lower_x, part->lower_y, part->lower_z}, {part->upper_x, part->upper_y, part->upper_z}};
    *left = boundsOf(intersection(lower, whole));
    *right = boundsOf(intersection(upper, whole));
}

uint appendNode(const BuiltNode& built, std::span<const Primitive> primitives, uint depth, Bvh& bvh)
{
    if (built.children[0] == nullptr) {
        const auto first = static_cast<uint>(bvh.primitives.size());
        for (uint i = 0; i < built.count; i++) bvh.primitives.push_back(primitives[built.primitives[i]]);
        bvh.statistics.leaves++;
        return REF_LEAF | (first << LEAF_COUNT_BITS) | (built.count - 1);
    }
    const auto index = static_cast<uint>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    bvh.statistics.depth = std::max(bvh.statistics.depth, depth + 1);
    const uint ref0 = appendNode(*built.children[0], primitives, depth + 1, bvh);
    const uint ref1 = appendNode(*built.children[1], primitives, depth + 1, bvh);
    const auto& [box0, box1] = built.boxes;
    bvh.nodes[index] = {box0.lo, ref0, box0.hi, ref1, box1.lo, 0, box1.hi, 0};
    return index;
}

}  // namespace

Bvh embreeTree(std::span<const Primitive> primitives, unsigned threads)
{
    const EmbreeLibrary* const library = embreeLibrary();
    Bvh bvh;
    if (library == nullptr || primitives.empty()) return bvh;
    RTCDevice device = library->newDevice(fmt::format("threads={}", threads).c_str());
    RTCBVH tree = library->newBvh(device);
    std::vector<RTCBuildPrimitive> parts(2 * primitives.size());  // room for those that are split
    for (size_t i = 0; i < primitives.size(); i++) {
        const Box box = sahl::boxOf(primitives[i]);
        parts[i] = {box.lo.x, box.lo.y, box.lo.z, 0, box.hi.x, box.hi.y, box.hi.z, static_cast<uint>(i)};
    }
    BuildInput input = {*library, primitives};
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
    arguments.maxDepth = MAX_STACK_SIZE - 8;  // Embree goes a little beyond
    arguments.maxLeafSize = MAX_LEAF_SIZE;
    arguments.bvh = tree;
    arguments.primitives = parts.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = parts.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    arguments.splitPrimitive = splitPrimitive;
    arguments.userPtr = &input;
    const auto* root = static_cast<const BuiltNode*>(library->buildBvh(&arguments));
    bvh.rootRef = appendNode(*root, primitives, 0, bvh);
    bvh.statistics.innerNodes = bvh.nodes.size();
    bvh.statistics.primitivesSeen = primitives.size();
    library->releaseBvh(tree);
    library->releaseDevice(device);
    return bvh;
}

}  // namespace sahl
