// The work that the film holds for each pixel, against recounts by recursions of the test's own.
#include "reference/kernel.h"
#include "render/render.h"
#include "support/render_scenes.h"
#include "support/small_scenes.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <limits>

namespace sahl::testing {
namespace {

using reference::Kernel;

struct Recount {
    uint64_t nodes = 0, primitives = 0;
};

/// The same walk as a recursion: the nearer child first, the other one too when the ray met its box
/// before the nearer one was looked into. Boxes and primitives are tested by the text.
class Walk {
public:
    Walk(Kernel<>& kernel, vec3 org, vec3 dir, bool anyHit, Recount& count)
        : kernel_(kernel), anyHit_(anyHit), ray_(kernel.makeWalkRay(org, dir, 0, 0)), count_(count)
    {
    }

    void visit(uint ref, Traversal& walk)
    {
        if (ref == REF_NONE || (anyHit_ && walk.slot != NO_HIT)) return;
        if ((ref & REF_LEAF) != 0) {
            visitLeaf(ref, walk);
            return;
        }
        count_.nodes++;
        const BvhNode& node = kernel_.nodes[ref];
        float entry0 = 0, entry1 = 0;
        const bool met0 = kernel_.intersectBox(ray_.boxes, node.lo0, node.hi0, walk.tHit, entry0);
        const bool met1 = kernel_.intersectBox(ray_.boxes, node.lo1, node.hi1, walk.tHit, entry1);
        const bool oneFirst = met0 && met1 && entry1 < entry0;
        if (oneFirst) visit(node.ref1, walk);
        if (met0) visit(node.ref0, walk);
        if (met1 && !oneFirst) visit(node.ref1, walk);
    }

private:
    void visitLeaf(uint ref, Traversal& walk)
    {
        const uint first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
        const uint size = (ref & (MAX_LEAF_SIZE - 1)) + 1;
        for (uint slot = first; slot < first + size; slot++) {
            kernel_.visitPrimitive(ray_, slot, walk);
            count_.primitives++;
        }
    }

    Kernel<>& kernel_;
    bool anyHit_;
    Kernel<>::WalkRay ray_;
    Recount& count_;
};

/// All rays of one sample: the text decides where they go, the test walks them.
void recountSample(Kernel<>& kernel, uint x, uint y, uint index, Recount& count)
{
    PathState path = kernel.beginPath(x, y, index);
    while (path.phase != PHASE_ENDED) {
        const bool shadow = kernel.inShadowPhase(path);
        Traversal walk = kernel.beginPathTraversal(path);
        const vec3 org = shadow ? path.shadowOrg : path.org,
                   dir = shadow ? path.shadowDir : path.dir;
        Walk(kernel, org, dir, shadow, count).visit(kernel.frame.rootRef, walk);
        if (shadow) {
            kernel.finishShadow(walk, path);
        } else {
            kernel.shadePath(walk, path);
        }
    }
}

std::unique_ptr<Device> binaryDevice()
{
    DeviceOptions options;
    options.nodeWidth = 2;
    return makeCpuDevice(options);
}

Kernel<> kernelOf(const PreparedScene& prepared)
{
    const DeviceScene scene = prepared.deviceScene();
    Kernel<> kernel = {};
    kernel.nodes = scene.nodes;
    kernel.primitives = scene.primitives;
    kernel.triangleCorners = scene.triangleCorners;
    kernel.materials = scene.materials;
    kernel.lights = scene.lights;
    kernel.aliasEntries = scene.aliasEntries;
    kernel.textures = scene.textures;
    kernel.textureTexels = scene.textureTexels;
    kernel.probeTexels = scene.probeTexels;
    kernel.frame = scene.frame;
    return kernel;
}

TEST(WorkCounts, ofEveryPixelAreThoseOfARecountOfAllItsRays)
{
    const uint32_t spp = 11;  // two blocks
    const PreparedScene prepared =
        prepareScene(builtInScene(smallPicture(24, 18, spp)), BvhBuild::automatic, 1);
    const Film film = renderFilm(*binaryDevice(), prepared, 0, spp, 7);
    ASSERT_GT(film.counters.shadowRays, 100u);
    ASSERT_GT(film.counters.indirectRays, 100u);

    Kernel<> kernel = kernelOf(prepared);
    Recount total;
    for (uint pixel = 0; pixel < film.work.size(); pixel++) {
        Recount count;
        for (uint i = 0; i < spp; i++) recountSample(kernel, pixel % 24, pixel / 24, i, count);
        EXPECT_EQ(film.work[pixel].boxTests, 2 * count.nodes) << pixel;
        EXPECT_EQ(film.work[pixel].primitiveTests, count.primitives) << pixel;
        total.nodes += count.nodes;
        total.primitives += count.primitives;
    }
    EXPECT_EQ(film.counters.boxTests, 2 * total.nodes);
    EXPECT_EQ(film.counters.primitiveTests, total.primitives);
}

/// The walk in double precision, with a slab test and a ray-triangle test (Moeller and Trumbore
/// 1997) of the test's own.
class DoubleWalk {
public:
    DoubleWalk(const Bvh& tree, vec3 org, vec3 dir) : tree_(tree), org_(org), dir_(dir) {}

    Recount count;

    void visit(uint ref)
    {
        if (ref == REF_NONE) return;
        if ((ref & REF_LEAF) != 0) {
            const uint first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
            for (uint i = 0; i <= (ref & (MAX_LEAF_SIZE - 1)); i++)
                visitTriangle(tree_.primitives[first + i]);
            return;
        }
        count.nodes++;
        const BvhNode& node = tree_.nodes[ref];
        const double entry0 = entryOf(node.lo0, node.hi0), entry1 = entryOf(node.lo1, node.hi1);
        const bool oneFirst = entry1 < entry0;
        if (oneFirst && entry1 < MISS) visit(node.ref1);
        if (entry0 < MISS) visit(node.ref0);
        if (!oneFirst && entry1 < MISS) visit(node.ref1);
    }

private:
    static constexpr double MISS = std::numeric_limits<double>::infinity();

    double entryOf(glm::dvec3 lo, glm::dvec3 hi) const
    {
        double entry = 0, leave = tHit_;
        for (int axis = 0; axis < 3; axis++) {
            const double a = (lo[axis] - org_[axis]) / dir_[axis],
                         b = (hi[axis] - org_[axis]) / dir_[axis];
            entry = std::max(entry, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return entry <= leave ? entry : MISS;
    }

    void visitTriangle(const Primitive& triangle)
    {
        count.primitives++;
        const glm::dvec3 p0(triangle.p0);
        const glm::dvec3 e1 = glm::dvec3(triangle.p1) - p0, e2 = glm::dvec3(triangle.p2) - p0;
        const glm::dvec3 p = glm::cross(dir_, e2);
        const double determinant = glm::dot(e1, p);
        const glm::dvec3 s = (org_ - p0) / determinant;
        const double u = glm::dot(s, p);
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(dir_, q), t = glm::dot(e2, q);
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < tHit_) tHit_ = t;
    }

    const Bvh& tree_;
    glm::dvec3 org_, dir_;
    double tHit_ = MISS;
};

TEST(WorkCounts, ofCameraRaysAreThoseOfARecountInDoublePrecision)
{
    Scene scene = emptyScene(48, 36, 0);
    scene.primitives = torus(60, 24);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f));
    lookFrom(scene, {0.3, 1.7, -2.9}, {0.05, 0.02, 0.01}, 50);
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    const Film film = renderFilm(*binaryDevice(), prepared, 0, 1);
    ASSERT_EQ(film.counters.indirectRays + film.counters.shadowRays, 0u);

    Kernel<> kernel = kernelOf(prepared);
    size_t differing = 0, walked = 0;
    for (uint pixel = 0; pixel < film.work.size(); pixel++) {
        const PathState path = kernel.beginPath(pixel % 48, pixel / 48, 0);
        DoubleWalk walk(prepared.bvh, path.org, path.dir);
        walk.visit(prepared.bvh.rootRef);
        const PixelWork& counted = film.work[pixel];
        differing += counted.boxTests != 2 * walk.count.nodes ||
                     counted.primitiveTests != walk.count.primitives;
        walked += walk.count.primitives > 0;
    }
    EXPECT_GT(walked, film.work.size() / 4) << "hardly any ray met a leaf";
    // The text widens its boxes by some roundings: a ray that passes within them may visit a node
    // more.
    EXPECT_LE(differing, film.work.size() / 200);
    ::testing::Test::RecordProperty("differing", std::to_string(differing));
}

}  // namespace
}  // namespace sahl::testing
