// Rays that the host gives: hits and the work that they took are the same bits on every device.
#include "support/device_test.h"
#include "support/render_scenes.h"
#include "support/soups.h"
#include "support/source_folder.h"

#include <algorithm>

namespace sahl::testing {
namespace {

class TracedRays : public DeviceTest {
protected:
    static PreparedScene fromFile(const char* path)
    {
        return prepareScene(loadScene(sourceFolder() / path, {}), BvhBuild::sweep, 2);
    }
    static const PreparedScene& teapot()
    {
        static const PreparedScene scene =
            prepareScene(builtInScene(smallPicture(8, 8, 8)), BvhBuild::sweep, 2);
        return scene;
    }

    /// From anywhere near the camera's aim in all directions; every fourth ends soon.
    static std::vector<TraceRay> someRays(const PreparedScene& scene, size_t count)
    {
        Random random(51);
        const Camera& camera = scene.scene.camera;
        std::vector<TraceRay> rays;
        for (size_t i = 0; i < count; i++) {
            const float along = random.uniform(0, 8);
            const vec3 org = camera.position + camera.forward * along + random.inCube(1);
            rays.push_back({org, i % 4 == 0 ? random.uniform(0, 2) : 3e38f, random.direction(), 0});
        }
        return rays;
    }

    static std::vector<TraceHit> trace(Device& device, const PreparedScene& scene, size_t count,
                                       bool anyHit)
    {
        device.setScene(scene.deviceScene());
        std::vector<TraceHit> hits(count);
        EXPECT_GE(device.traceRays(someRays(scene, count), anyHit, hits), 0.0);
        return hits;
    }

    static void expectSameBits(Device& device, const PreparedScene& scene, size_t count)
    {
        for (bool anyHit : {false, true}) {
            const auto expected = trace(*makeCpuDevice({}), scene, count, anyHit);
            const auto found = trace(device, scene, count, anyHit);
            EXPECT_EQ(std::memcmp(found.data(), expected.data(), count * sizeof(TraceHit)), 0)
                << anyHit;
            auto isHit = [](const TraceHit& hit) { return hit.number != NO_HIT; };
            const auto hits = std::count_if(expected.begin(), expected.end(), isHit);
            EXPECT_GT(hits, static_cast<std::ptrdiff_t>(count / 20));
            EXPECT_LT(hits, static_cast<std::ptrdiff_t>(count));
        }
        EXPECT_TRUE(trace(device, scene, 0, false).empty());
    }
};

TEST_F(TracedRays, haveTheBitsOfTheReference)
{
    expectSameBits(*openFirstDevice(), teapot(), 5000);
}

TEST_F(TracedRays, haveTheBitsOfTheReferenceOutOfStepsTimeAndAgain)
{
    for (const char* variant : {"texel-8x8-by8", "texel-8x8-by8-registers"}) {
        SCOPED_TRACE(variant);
        DeviceOptions options;
        options.stepBudget = 7;
        options.variant = variant;
        const auto device = openFirstDevice(options);
        expectSameBits(*device, teapot(), 1000);
        expectSameBits(*device, fromFile("tests/scenes/instances.json"), 1000);
    }
}

/// Triangles in a row, each a little larger than the one before: the tree is cut off one by one.
TEST_F(TracedRays, haveTheBitsOfTheReferenceInTreesTooHighForRegisters)
{
    Scene scene = builtInScene(smallPicture(8, 8, 1));
    scene.primitives.clear();
    scene.objectStarts = {0};
    float size = 1e-20f;  // to 3
    for (int i = 0; i < 180; i++, size *= 1.3f) {
        const vec3 at = vec3(size, 0, 0);
        addTriangle(scene.primitives, at, at + vec3(size / 8, size, 0), at + vec3(0, 0, size));
    }
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    ASSERT_GT(prepared.deviceScene().wide.worstGroups, STACK_REGISTERS + 1);
    DeviceOptions options;
    options.variant = "texel-8x8-by8-registers";
    std::vector<TraceHit> expected(1000), found(1000);
    const auto device = openFirstDevice(options);
    const auto cpu = makeCpuDevice({});
    const std::vector<TraceRay> rays = someRays(prepared, expected.size());
    for (Device* each : {device.get(), cpu.get()}) {
        each->setScene(prepared.deviceScene());
        each->traceRays(rays, false, each == cpu.get() ? expected : found);
    }
    EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(TraceHit)), 0);
    const auto isHit = [](const TraceHit& hit) { return hit.number != NO_HIT; };
    EXPECT_GT(std::count_if(expected.begin(), expected.end(), isHit), 10);
}

TEST_F(TracedRays, haveTheBitsOfTheReferenceThroughStorageBuffers)
{
    DeviceOptions options;
    options.buffers = DeviceOptions::Buffers::storage;
    expectSameBits(*openFirstDevice(options), teapot(), 1000);
}

TEST_F(TracedRays, meetSomethingInAnyOrderWhereTheClosestHitIs)
{
    const auto cpu = makeCpuDevice({});
    const auto closest = trace(*cpu, teapot(), 5000, false);
    const auto any = trace(*cpu, teapot(), 5000, true);
    for (size_t i = 0; i < closest.size(); i++) {
        EXPECT_EQ(any[i].number == NO_HIT, closest[i].number == NO_HIT);
        EXPECT_GE(any[i].tHit, closest[i].tHit);
        EXPECT_LE(any[i].boxTests, closest[i].boxTests);
    }
}

}  // namespace
}  // namespace sahl::testing
