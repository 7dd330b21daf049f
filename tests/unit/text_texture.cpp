// What a lookup of a texture gives, against texels counted by hand and a filter in double
// precision.
#include "reference/kernel.h"
#include "scene/texture.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace sahl {
namespace {

/// A kernel with one scene's textures.
struct TextureKernel : reference::Kernel<ORDER_NEAR_FIRST, true, true> {
    Scene scene;

    /// Number of a texture with these texels, top row first.
    uint32_t add(uint32_t width, uint32_t height, const std::vector<uint32_t>& rgba,
                 const TextureLook& look = {})
    {
        const StoredPicture picture = storePicture(scene, {width, height, rgba}, "test");
        const uint32_t number = addTexture(scene, picture, look);
        textures = scene.textures;
        textureTexels = scene.textureTexels;
        return number;
    }
};

constexpr float STEP = 1.0f / 255;

uint32_t grey(uint32_t value)
{
    return packTexel(value, value, value, value);
}

TextureLook lookOf(bool clamps, bool nearest)
{
    TextureLook look;
    look.clampS = look.clampT = clamps;
    look.nearest = nearest;
    return look;
}

/// 2 x 2 texels: 40 and 80 below, 120 and 240 above.
const std::vector<uint32_t> FOUR = {grey(120), grey(240), grey(40), grey(80)};

/// A triangle over the picture's lower left half: u is b1, v is b2.
TEST(Texture, withAlphaBelowTheCutoffLeavesAHole)
{
    TextureKernel kernel;
    Material material = {};
    material.alphaCutoff = 100.0f / 255;
    material.baseColorTexture = kernel.add(2, 2, FOUR, lookOf(true, true));
    const std::vector<Material> materials = {material};
    TriangleCorners corners = {};
    corners.u1 = corners.v2 = 1;
    const std::vector<TriangleCorners> triangleCorners = {corners};
    kernel.materials = materials;
    kernel.triangleCorners = triangleCorners;
    const Primitive triangle = {};
    EXPECT_TRUE(kernel.isCutOut(triangle, NO_MATERIAL, 0.25f, 0.25f));  // 40
    EXPECT_TRUE(kernel.isCutOut(triangle, NO_MATERIAL, 0.6f, 0.25f));   // 80
    EXPECT_FALSE(kernel.isCutOut(triangle, NO_MATERIAL, 0.25f, 0.6f));  // 120
}

TEST(Texture, ofEmissionIsTimesTheMaterialsOwn)
{
    TextureKernel kernel;
    Material material = {};
    material.emission = vec3(2, 3, 40);
    EXPECT_EQ(kernel.emittedAt(material, 0.25f, 0.25f), material.emission);
    material.emissionTexture = kernel.add(2, 2, FOUR, lookOf(true, true));
    const vec3 emitted = kernel.emittedAt(material, 0.25f, 0.25f);
    EXPECT_NEAR(emitted.x, 2 * 40 * STEP, 1e-6);
    EXPECT_NEAR(emitted.z, 40 * 40 * STEP, 1e-5);
}

TEST(Texture, ofFourTexels_isWhatOneCountsByHand)
{
    TextureKernel kernel;
    const uint32_t repeat = kernel.add(2, 2, FOUR),
                   clamp = kernel.add(2, 2, FOUR, lookOf(true, false));
    auto at = [&](uint32_t number, float u, float v) {
        return kernel.lookUpColor(number, u, v).x * 255;
    };
    // The centres of the texels, wherever the picture is repeated to
    for (const float shift : {0.0f, 1.0f, -1.0f, -7.0f, 1000.0f}) {
        EXPECT_NEAR(at(repeat, 0.25f + shift, 0.25f), 40, 1e-4);
        EXPECT_NEAR(at(repeat, 0.75f, 0.25f + shift), 80, 1e-4);
        EXPECT_NEAR(at(repeat, 0.25f + shift, 0.75f + shift), 120, 1e-4);
        EXPECT_NEAR(at(repeat, 0.75f, 0.75f), 240, 1e-4);
    }
    EXPECT_NEAR(at(repeat, 0.5f, 0.25f), 60, 1e-4);
    EXPECT_NEAR(at(repeat, 0.375f, 0.25f), 50, 1e-4);
    EXPECT_NEAR(at(repeat, 0.5f, 0.5f), 120, 1e-4);
    // On the picture's border: half of it is the other side, or the texel beside it is this one
    // again
    for (const float border : {0.0f, 1.0f, -1.0f, 5.0f})
        EXPECT_NEAR(at(repeat, border, 0.25f), 60, 1e-4);
    EXPECT_NEAR(at(clamp, 0, 0.25f), 40, 1e-4);
    EXPECT_NEAR(at(clamp, 1, 0.25f), 80, 1e-4);
    EXPECT_NEAR(at(clamp, -3.5f, 9), 120, 1e-4);
    EXPECT_NEAR(at(clamp, 1e30f, -1e30f), 80, 1e-4);
}

TEST(Texture, ofTheNearestTexel_hasThatOfEachHalfOpenSquare)
{
    TextureKernel kernel;
    const uint32_t repeat = kernel.add(2, 2, FOUR, lookOf(false, true)),
                   clamp = kernel.add(2, 2, FOUR, lookOf(true, true));
    auto at = [&](uint32_t number, float u, float v) {
        return kernel.lookUpColor(number, u, v).x * 255;
    };
    EXPECT_NEAR(at(repeat, 0, 0), 40, 1e-4);
    EXPECT_NEAR(at(repeat, 0.49f, 0.49f), 40, 1e-4);
    EXPECT_NEAR(at(repeat, 0.5f, 0), 80, 1e-4);
    EXPECT_NEAR(at(repeat, 0, 0.5f), 120, 1e-4);
    EXPECT_NEAR(at(repeat, 1, 1), 40, 1e-4);
    EXPECT_NEAR(at(repeat, -0.25f, 0.25f), 80, 1e-4);
    EXPECT_NEAR(at(clamp, 1, 1), 240, 1e-4);
    EXPECT_NEAR(at(clamp, -1, 2), 120, 1e-4);
}

/// The same filter as people write it down: every texel has a place on the repeated plane.
double filtered(const std::vector<uint32_t>& rgba, int width, int height, double u, double v,
                bool clamps, bool nearest)
{
    auto place = [&](double i, int size) {
        if (clamps) return static_cast<int>(std::fmin(std::fmax(i, 0), size - 1));
        return static_cast<int>(i - std::floor(i / size) * size);
    };
    auto texel = [&](double x, double y) {
        const int row = height - 1 - place(y, height);
        return double(rgba[static_cast<size_t>(row * width + place(x, width))] & 255) / 255;
    };
    if (clamps) {
        u = std::fmin(std::fmax(u, 0), 1);
        v = std::fmin(std::fmax(v, 0), 1);
    }
    const double x = u * width, y = v * height;
    if (nearest) return texel(std::floor(x), std::floor(y));
    const double left = std::floor(x - 0.5), low = std::floor(y - 0.5);
    const double fx = x - 0.5 - left, fy = y - 0.5 - low;
    return (texel(left, low) * (1 - fx) + texel(left + 1, low) * fx) * (1 - fy) +
           (texel(left, low + 1) * (1 - fx) + texel(left + 1, low + 1) * fx) * fy;
}

/// A coordinate below 8 is known to 2^-22 of a period, a place among 64 texels hence to 2^-16 of a
/// texel; texels differ by 1 at most.
TEST(Texture, equalsTheFilterInDoublePrecision)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(-8, 8);
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(7, 1), std::pair(5, 3), std::pair(64, 33)}) {
        std::vector<uint32_t> rgba;
        for (int i = 0; i < width * height; i++) rgba.push_back(grey(random() & 255));
        for (const bool clamps : {false, true}) {
            TextureKernel kernel;
            const uint32_t number =
                kernel.add(uint32_t(width), uint32_t(height), rgba, lookOf(clamps, false));
            for (int i = 0; i < 2000; i++) {
                const float u = coordinate(random), v = coordinate(random);
                EXPECT_NEAR(kernel.lookUpColor(number, u, v).x,
                            filtered(rgba, width, height, u, v, clamps, false), 1e-4)
                    << width << " x " << height << " at " << u << ", " << v;
                EXPECT_EQ(kernel.lookUpAlpha(number, u, v), kernel.lookUpColor(number, u, v).x);
            }
        }
    }
}

TEST(Texture, ofTheNearestTexel_equalsThatInDoublePrecision_awayFromBorders)
{
    std::mt19937 random(6);
    const int width = 13, height = 9;
    std::vector<uint32_t> rgba;
    for (int i = 0; i < width * height; i++) rgba.push_back(grey(random() & 255));
    std::uniform_int_distribution<int> texel(-60, 60);
    for (const bool clamps : {false, true}) {
        TextureKernel kernel;
        const uint32_t number = kernel.add(width, height, rgba, lookOf(clamps, true));
        for (int i = 0; i < 2000; i++) {
            const float u = (float(texel(random)) + 0.3f) / width,
                        v = (float(texel(random)) + 0.7f) / height;
            EXPECT_NEAR(kernel.lookUpColor(number, u, v).x,
                        filtered(rgba, width, height, u, v, clamps, true), 1e-6);
        }
    }
}

TEST(Texture, ofOneTexel_isThatEverywhere_andNothingLeavesThePicture)
{
    TextureKernel kernel;
    const float inf = std::numeric_limits<float>::infinity(),
                nan = std::numeric_limits<float>::quiet_NaN();
    for (const bool clamps : {false, true}) {
        for (const bool nearest : {false, true}) {
            const uint32_t one = kernel.add(1, 1, {grey(51)}, lookOf(clamps, nearest));
            for (const float u : {0.0f, 0.5f, 1.0f, -1e-30f, 1e-40f, -1e-40f, 0.99999994f, -3e7f,
                                  3e38f, inf, -inf, nan}) {
                for (const float v : {0.0f, 1.0f, -1e-9f, nan})
                    EXPECT_FLOAT_EQ(kernel.lookUpColor(one, u, v).x, 0.2f) << u << " " << v;
            }
        }
    }
}

TEST(Texture, isScaledAndMovedByItsRows)
{
    TextureKernel kernel;
    TextureLook look;
    look.rowS = {0, 2, 0.125};
    look.rowT = {-1, 0, 1};
    const uint32_t moved = kernel.add(2, 2, FOUR, look), plain = kernel.add(2, 2, FOUR);
    for (const auto& [u, v] :
         {std::pair(0.3f, 0.2f), std::pair(-0.75f, 0.5f), std::pair(0.0f, 0.0f)})
        EXPECT_NEAR(kernel.lookUpColor(moved, u, v).y,
                    kernel.lookUpColor(plain, 2 * v + 0.125f, 1 - u).y, 1e-6);
}

/// IEC 61966-2-1, rounded once to float: within half of its last place, for which 0.500001 of one
/// allow.
TEST(Texture, ofSrgbValues_hasTheCurveAtAll256)
{
    TextureKernel kernel;
    TextureLook look;
    look.srgb = true;
    EXPECT_EQ(std::bit_cast<float>(srgbTable()[0]), 0.0f);
    EXPECT_EQ(std::bit_cast<float>(srgbTable()[255]), 1.0f);
    for (uint32_t i = 0; i < 256; i++) {
        const uint32_t number = kernel.add(1, 1, {packTexel(i, 255 - i, 0, 77)}, look);
        const vec3 color = kernel.lookUpColor(number, 0.5f, 0.5f);
        const long double c = static_cast<long double>(i) / 255;
        const long double exact =
            c <= 0.04045L ? c / 12.92L : std::pow((c + 0.055L) / 1.055L, 2.4L);
        const float next = std::nextafter(color.x, 2.0f) - color.x;
        EXPECT_LE(std::abs(color.x - exact), 0.500001L * next) << i;
        EXPECT_EQ(color.y, std::bit_cast<float>(srgbTable()[255 - i]));
        EXPECT_NEAR(kernel.lookUpAlpha(number, 0.5f, 0.5f), 77 * STEP, 1e-7);
    }
}

TEST(Texture, ofNumbers_hasExactEnds)
{
    TextureKernel kernel;
    const uint32_t number = kernel.add(1, 1, {packTexel(0, 255, 128, 0)});
    EXPECT_EQ(kernel.lookUpColor(number, 0, 0).x, 0.0f);
    EXPECT_EQ(kernel.lookUpColor(number, 0, 0).y, 1.0f);
    EXPECT_FLOAT_EQ(kernel.lookUpColor(number, 0, 0).z, 128 * STEP);
}

TEST(Texture, knowsItsMean)
{
    TextureKernel kernel;
    TextureLook srgb;
    srgb.srgb = true;
    kernel.add(2, 1, {packTexel(0, 51, 255, 0), packTexel(255, 102, 255, 0)});
    EXPECT_FLOAT_EQ(kernel.textures[0].mean.x, 0.5f);
    EXPECT_FLOAT_EQ(kernel.textures[0].mean.y, 0.3f);
    EXPECT_FLOAT_EQ(kernel.textures[0].mean.z, 1.0f);
    kernel.add(2, 1, {packTexel(188, 0, 0, 0), packTexel(188, 255, 0, 0)}, srgb);
    EXPECT_NEAR(kernel.textures[1].mean.x, 0.5029f, 1e-4f);
    EXPECT_FLOAT_EQ(kernel.textures[1].mean.y, 0.5f);
}

/// A map's normal at texels whose numbers are its own: 51, 102, 204 of 255 are -0.6, -0.2, 0.6.
const uint32_t LEANING = packTexel(51, 102, 204, 255);

TEST(NormalMap, hasNormalsFromMinusOneToOne_asLongAsOne)
{
    TextureKernel kernel;
    auto normal = [&](uint32_t texel, float strength) {
        TextureLook look;
        look.strength = strength;
        return kernel.normalInMap(kernel.add(1, 1, {texel}, look), 0.5f, 0.5f);
    };
    auto expect = [](vec3 found, double x, double y, double z) {
        const double length = std::sqrt(x * x + y * y + z * z);
        EXPECT_NEAR(found.x, x / length, 1e-6);
        EXPECT_NEAR(found.y, y / length, 1e-6);
        EXPECT_NEAR(found.z, z / length, 1e-6);
    };
    expect(normal(LEANING, 1), -0.6, -0.2, 0.6);
    expect(normal(LEANING, 2), -1.2, -0.4, 0.6);
    expect(normal(LEANING, 0), 0, 0, 1);
    expect(normal(packTexel(255, 0, 255, 0), 1), 1, -1, 1);
}

/// The shading normal of a triangle in the plane z = 0 under the map LEANING.
///   corners  its texture coordinates
///   dir      of the ray that arrives
vec3 bumped(const TriangleCorners& corners, vec3 dir)
{
    TextureKernel kernel;
    Material material = {};
    material.normalTexture = kernel.add(1, 1, {LEANING});
    Primitive triangle = {};
    triangle.p1 = vec3(2, 0, 0);
    triangle.p2 = vec3(0, 3, 0);
    const std::vector<Primitive> primitives = {triangle};
    const std::vector<TriangleCorners> triangleCorners = {corners};
    kernel.primitives = primitives;
    kernel.triangleCorners = triangleCorners;
    auto hit = kernel.beginTraversal(1);
    hit.slot = 0;
    hit.instance = NO_INSTANCE;
    hit.b1 = hit.b2 = 0.25f;
    auto isect = kernel.interactionAt(hit, -dir, dir);
    kernel.bumpInteraction(material, hit, isect);
    return isect.ns;
}

/// Red leans the normal along u and green along v, wherever the triangle has them: here along the
/// axes of the world, turned by a right angle, and mirrored.
TEST(NormalMap, leansAlongTheTexturesAxes)
{
    const double length = std::sqrt(0.76);
    auto expect = [&](vec3 found, double x, double y, double z) {
        EXPECT_NEAR(found.x, x / length, 1e-6);
        EXPECT_NEAR(found.y, y / length, 1e-6);
        EXPECT_NEAR(found.z, z / length, 1e-6);
    };
    const vec3 down(0, 0, -1), up(0, 0, 1);
    TriangleCorners plain = {}, turned = {}, mirrored = {};
    plain.u1 = plain.v2 = 1;            // u along x, v along y
    turned.v1 = 1, turned.u2 = -1;      // u along -y, v along x
    mirrored.u1 = -1, mirrored.v2 = 1;  // u along -x, v along y
    expect(bumped(plain, down), -0.6, -0.2, 0.6);
    expect(bumped(turned, down), -0.2, 0.6, 0.6);
    expect(bumped(mirrored, down), 0.6, -0.2, 0.6);
    // From behind a dent is a bump: the same normal on the other side.
    expect(bumped(plain, up), 0.6, 0.2, -0.6);
    expect(bumped(mirrored, up), -0.6, 0.2, -0.6);
}

TEST(SphereUv, isThatOfAGlobe)
{
    reference::Kernel<> kernel;
    auto expect = [&](vec3 n, float u, float v) {
        const vec2 uv = kernel.sphereUv(n);
        EXPECT_NEAR(uv.x, u, 1e-6f);
        EXPECT_NEAR(uv.y, v, 1e-6f);
    };
    expect({0, 0, 1}, 0.5f, 0.5f);
    expect({1, 0, 0}, 0.75f, 0.5f);
    expect({-1, 0, 0}, 0.25f, 0.5f);
    EXPECT_NEAR(kernel.sphereUv({0, 1, 0}).y, 1, 1e-6f);
    EXPECT_NEAR(kernel.sphereUv({0, -1, 0}).y, 0, 1e-6f);
    expect({0, std::sqrt(0.5f), std::sqrt(0.5f)}, 0.5f, 0.75f);
}

}  // namespace
}  // namespace sahl
