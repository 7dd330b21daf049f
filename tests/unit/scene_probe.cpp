// Light probes: cleaning, angular maps, and the built-in studio.
#include "scene/probe.h"
#include "support/scene_files.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {
namespace {

using namespace sahl::testing;

Image uniformImage(uint32_t width, uint32_t height, float value)
{
    return {width, height, std::vector<float>(size_t{3} * width * height, value)};
}

TEST(ProbeTest, keepsTexelsTopRowFirst)
{
    Scene scene;
    setProbe(scene, {2, 1, {1, 2, 3, 4, 5, 6}}, PROBE_LATLONG, FILTER_NEAREST, "probe");
    EXPECT_EQ(scene.probe.width, 2u);
    EXPECT_EQ(scene.probe.height, 1u);
    EXPECT_EQ(scene.probe.filterMode, FILTER_NEAREST);
    EXPECT_EQ(scene.probeTexels.at(0), vec4(1, 2, 3, 0));
    EXPECT_EQ(scene.probeTexels.at(1), vec4(4, 5, 6, 0));
}

TEST(ProbeTest, badValuesBecomeZeroAndAreCountedOnce)
{
    const float inf = std::numeric_limits<float>::infinity();
    Scene scene;
    const std::string warning = warningsOf([&] {
        setProbe(scene, {2, 1, {-1, inf, 1e-31f, std::nanf(""), 5, -inf}}, PROBE_LATLONG,
                 FILTER_NEAREST, "sky");
    });
    EXPECT_EQ(scene.probeTexels.at(0), vec4(0, 0, 0, 0));
    EXPECT_EQ(scene.probeTexels.at(1), vec4(0, 5, 0, 0));
    EXPECT_CONTAINS(warning, "sky: 4 values that are negative or not finite became 0");
}

TEST(ProbeTest, cornersOfAnAngularMapTakeTheRimsValue)
{
    const uint32_t size = 16;
    Image image = uniformImage(size, size, 1);
    // A mark in the corners, where no direction lies, and another on the rim along the diagonal.
    const auto radius = [&](uint32_t x, uint32_t y) {
        return std::hypot((2.0 * x + 1) / size - 1, (2.0 * y + 1) / size - 1);
    };
    for (uint32_t y = 0; y < size; y++) {
        for (uint32_t x = 0; x < size; x++) {
            if (radius(x, y) > 1) image.rgb[3 * (y * size + x)] = 1000;
        }
    }
    image.rgb[3 * (2 * size + 13)] = 7;
    ASSERT_LT(radius(13, 2), 1);
    ASSERT_GT(radius(14, 1), 1);
    Scene scene;
    setProbe(scene, image, PROBE_ANGULAR, FILTER_BILINEAR, "probe");
    for (const vec4& texel : scene.probeTexels) EXPECT_LT(texel.x, 1000);
    EXPECT_EQ(scene.probeTexels.at(1 * size + 14).x, 7);
    EXPECT_EQ(scene.probeTexels.at(0 * size + 15).x, 7);
    EXPECT_EQ(scene.probeTexels.at(15 * size + 0).x, 1);
}

TEST(ProbeTest, angularMapsOfAnySizeAreFilled)
{
    for (uint32_t size = 1; size <= 40; size++) {
        Image image = uniformImage(size, size, 1);
        for (uint32_t y = 0; y < size; y++) {
            for (uint32_t x = 0; x < size; x++) {
                if (std::hypot((2.0 * x + 1) / size - 1, (2.0 * y + 1) / size - 1) > 1) {
                    image.rgb[3 * (y * size + x)] = 9;
                }
            }
        }
        Scene scene;
        setProbe(scene, image, PROBE_ANGULAR, FILTER_BILINEAR, "probe");
        // In a map of 2 x 2 all centres lie inside the disc, from 3 x 3 on the corners do not.
        for (const vec4& texel : scene.probeTexels) EXPECT_EQ(texel.x, 1) << size;
    }
}

TEST(ProbeTest, shapeOfThePictureMustFitTheMapping)
{
    Scene scene;
    EXPECT_CONTAINS(badInputOf([&] {
                        setProbe(scene, uniformImage(4, 2, 1), PROBE_ANGULAR, FILTER_NEAREST,
                                 "sky");
                    }),
                    "sky: an angular map must be square, this is 4 x 2");
    EXPECT_CONTAINS(warningsOf([&] {
                        setProbe(scene, uniformImage(4, 4, 1), PROBE_LATLONG, FILTER_NEAREST,
                                 "sky");
                    }),
                    "set the mapping to angular");
    EXPECT_EQ(warningsOf([&] {
                  setProbe(scene, uniformImage(1, 1, 1), PROBE_LATLONG, FILTER_NEAREST, "sky");
              }),
              "");
}

TEST(ProbeTest, wordsForMappingAndFilterAreChecked)
{
    EXPECT_EQ(probeMapping("angular"), PROBE_ANGULAR);
    EXPECT_EQ(probeFilter("nearest"), FILTER_NEAREST);
    EXPECT_THROW(probeMapping("octahedral"), Error);
    EXPECT_THROW(probeFilter("cubic"), Error);
}

TEST(ProbeTest, sceneFilesAndOptionsNameThePicture)
{
    SceneFolder files;
    const std::vector<uint8_t> pfm = encodePfm(uniformImage(4, 4, 2));
    files.write("p.pfm", std::string(pfm.begin(), pfm.end()));
    files.write(
        "s.json",
        R"({ "environment": { "file": "p.pfm", "mapping": "angular", "filter": "nearest" } })");
    const Scene scene = files.load("s.json");
    EXPECT_EQ(scene.probe.mapping, PROBE_ANGULAR);
    EXPECT_EQ(scene.probe.filterMode, FILTER_NEAREST);
    EXPECT_EQ(scene.probeTexels.at(5), vec4(2, 2, 2, 0));

    SceneOptions options;
    options.probe = files.folder.path / "p.pfm";
    options.probeMapping = "angular";
    files.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Scene replaced = files.load("a.obj", options);
    EXPECT_EQ(replaced.probe.width, 4u);
    EXPECT_EQ(replaced.probe.mapping, PROBE_ANGULAR);
}

vec3 texel(const Image& image, uint32_t x, uint32_t y)
{
    const float* rgb = &image.rgb[3 * (size_t{y} * image.width + x)];
    return {rgb[0], rgb[1], rgb[2]};
}

TEST(Studio, isSoftSmoothAndLitFromAbove)
{
    const Image studio = makeStudioProbe(STUDIO_WIDTH, STUDIO_HEIGHT);
    double upper = 0, lower = 0;
    for (uint32_t y = 0; y < studio.height; y++) {
        for (uint32_t x = 0; x < studio.width; x++) {
            const vec3 here = texel(studio, x, y);
            const vec3 next = texel(studio, (x + 1) % studio.width, y);
            EXPECT_GT(std::min({here.x, here.y, here.z}), 0.1f);
            EXPECT_LT(std::max({here.x, here.y, here.z}), 3.0f);
            // Also across the seam at the left and right border.
            EXPECT_LT(glm::length(here - next), 0.5f) << x << ", " << y;
            (y < studio.height / 2 ? upper : lower) += here.y;
        }
    }
    EXPECT_GT(upper, 2 * lower);
}

TEST(Studio, keyLightComesFromTheUpperLeftBehindTheCamera)
{
    // Azimuth -114 degrees from -Z towards +X, elevation 46: column 256 * (0.5 - 114/360), row 128
    // * 48/180.
    const Image studio = makeStudioProbe(STUDIO_WIDTH, STUDIO_HEIGHT);
    EXPECT_GT(texel(studio, 46, 31).y, 2);
    EXPECT_LT(texel(studio, 128, 64).y, 1);
}

TEST(Churches, areFiniteLightEverywhereAndCloseAtTheSeam)
{
    for (const char* name : {"cathedral", "basilica"}) {
        const Image church = makeBuiltinProbe(name);
        ASSERT_EQ(church.rgb.size(), size_t{3} * CHURCH_WIDTH * CHURCH_HEIGHT);
        for (float value : church.rgb) {
            ASSERT_GT(value, 0) << name;
            ASSERT_LT(value, 100) << name;
        }
        for (uint32_t y = 0; y < church.height; y++) {
            const vec3 left = texel(church, 0, y), right = texel(church, church.width - 1, y);
            EXPECT_LT(glm::length(left - right), 0.2f * glm::length(left + right)) << name << " row " << y;
        }
    }
}

TEST(Churches, haveWindowsManyTimesBrighterThanTheirWalls)
{
    for (const char* name : {"cathedral", "basilica"}) {
        std::vector<float> values = makeBuiltinProbe(name).rgb;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        EXPECT_GT(*std::max_element(values.begin(), values.end()), 20 * *middle) << name;
    }
}

TEST(ProbeTest, areReadBeforeMeshes_andThreadsMayStartInBetween)
{
    const std::string mesh = R"("shapes": [{ "type": "mesh", "file": "missing.obj" }])";
    SceneFolder files;
    files.write("both.json", R"({ "environment": { "file": "missing.exr" }, )" + mesh + "}");
    files.write("background.json", R"({ "background": { "file": "missing.exr" }, )" + mesh + "}");
    files.write("mesh.json", R"({ "environment": { "radiance": [1, 1, 1] }, )" + mesh + "}");
    files.write("mesh.obj", "no mesh");
    files.write("mesh.gltf", "no JSON");
    struct Case {
        const char* file;
        bool namesProbe;
        const char* failsAt;
        int starts;
    };
    for (const Case& c : {Case{"both.json", false, "missing.exr", 0}, {"background.json", false, "missing.exr", 0},
                          {"mesh.json", false, "missing.obj", 1}, {"mesh.json", true, "probe.exr", 0},
                          {"mesh.obj", false, "mesh.obj", 1}, {"mesh.obj", true, "probe.exr", 0},
                          {"mesh.gltf", false, "mesh.gltf", 1}, {"mesh.gltf", true, "probe.exr", 0}}) {
        int starts = 0;
        SceneOptions options;
        options.onceThreadsMayStart = [&] { starts++; };
        if (c.namesProbe) options.probe = files.folder.path / "probe.exr";
        EXPECT_CONTAINS(errorOfFile(files, c.file, options), c.failsAt) << c.file;
        EXPECT_EQ(starts, c.starts) << c.file << ", " << c.namesProbe;
    }
}

}  // namespace
}  // namespace sahl
