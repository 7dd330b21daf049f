// Textures as pictures show them, on the CPU: where they are, what they do to light, and holes.
#include "shared/bindings.h"
#include "support/render_scenes.h"
#include "support/texture_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace sahl::testing {
namespace {

PreparedScene prepared(Scene scene)
{
    return prepareScene(std::move(scene), BvhBuild::sweep, 1);
}

std::vector<FirstHits> firstHitsOf(const Scene& scene, uint32_t samples = 1)
{
    const PreparedScene ready = prepared(scene);
    auto device = makeCpuDevice({});
    device->setScene(ready.deviceScene());
    const uint32_t width = scene.settings.width, height = scene.settings.height;
    std::vector<FirstHits> hits(size_t{width} * height);
    device->renderFirstHits({0, 0, width, height, 0, samples}, hits);
    return hits;
}

Film filmOf(const Scene& scene)
{
    return renderFilm(*makeCpuDevice({}), prepared(scene));
}

/// The square |x|, |y| <= 1 in the plane z = 0, which fills the picture.
Scene squareScene(uint32_t pixels)
{
    Scene scene = emptyScene(pixels, pixels, 1);
    scene.settings.spp = 8;
    lookParallel(scene, {0, 0, 3}, {0, 0, 0}, 1);
    return scene;
}

void addSquare(Scene& scene)
{
    addRectangle(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
}

void expectNear(vec3 found, vec3 expected, float tolerance, const std::string& where)
{
    for (int c = 0; c < 3; c++)
        EXPECT_NEAR(found[c], expected[c], tolerance) << where << ", channel " << c;
}

/// Each of 4 x 4 texels fills 2 x 2 pixels of the picture, top row at the top.
TEST(TexturePictures, showEveryTexelInItsPlace_alsoInLight)
{
    Scene scene = squareScene(8);
    const std::vector<uint32_t> texels = patches(4, 4, false);
    addTextured(scene, 4, 4, texels, nearestTexel());
    addSquare(scene);
    scene.probe = addHalves(scene, vec3(1), vec3(1));
    const std::vector<FirstHits> hits = firstHitsOf(scene, 8);
    const Image light = meanImage(filmOf(scene));
    for (size_t y = 0; y < 8; y++) {
        for (size_t x = 0; x < 8; x++) {
            const uint32_t texel = texels[y / 2 * 4 + x / 2];
            const vec3 color = vec3(texel & 255, texel >> 8 & 255, texel >> 16 & 255) / 255.0f;
            const std::string where = fmt::format("pixel {}, {}", x, y);
            expectNear(hits[y * 8 + x].albedo / 8.0f, color, 1e-6f, where);
            const size_t at = 3 * (y * 8 + x);
            expectNear({light.rgb[at], light.rgb[at + 1], light.rgb[at + 2]}, color, 1e-6f, where);
        }
    }
}

TEST(TexturePictures, ofInstances_areThoseOfTheObjectMoved)
{
    Scene plain = squareScene(8);
    addTextured(plain, 4, 4, patches(4, 4, false), nearestTexel());
    addSquare(plain);
    Scene placed = squareScene(8);
    addTextured(placed, 4, 4, patches(4, 4, false), nearestTexel());
    addRectangle(placed, {-3, 2, 0}, {0, 0, 4}, {0, 1, 0});
    placed.objects.push_back(std::move(placed.primitives));
    placed.primitives.clear();
    Placement placement;  // takes z in [0, 4] to x in [-1, 1], and y in [2, 3] to y in [-1, 1]
    placement.linear = glm::dmat3(0, 0, -1, 0, 2, 0, 0.5, 0, 0);
    placement.translation = {-1, -5, -3};
    placed.instances.push_back(placement);
    const std::vector<FirstHits> a = firstHitsOf(plain), b = firstHitsOf(placed);
    for (size_t i = 0; i < a.size(); i++) {
        EXPECT_EQ(b[i].hits, 1u);
        EXPECT_EQ(a[i].albedo, b[i].albedo) << i;
    }
}

TEST(TexturePictures, ofLamps_multiplyTheirLight)
{
    Scene scene = squareScene(8);
    Material& lamp = addTextured(scene, 4, 4, patches(4, 4, false), nearestTexel());
    lamp.emissionTexture = lamp.baseColorTexture;
    lamp.baseColorTexture = NO_TEXTURE;
    lamp.baseColor = vec3(0);
    lamp.emission = {2, 3, 4};
    addSquare(scene);
    const std::vector<uint32_t> texels = patches(4, 4, false);
    const Image light = meanImage(filmOf(scene));
    for (size_t i = 0; i < 64; i++) {
        const uint32_t texel = texels[i / 16 * 4 + i % 8 / 2];
        const vec3 expected =
            vec3(2, 3, 4) * vec3(texel & 255, texel >> 8 & 255, texel >> 16 & 255) / 255.0f;
        expectNear({light.rgb[3 * i], light.rgb[3 * i + 1], light.rgb[3 * i + 2]}, expected, 1e-5f,
                   fmt::format("pixel {}", i));
    }
}

/// A lamp with a picture, one of whose three texels is a hole, and a globe that shines over a
/// floor: whatever finds their light, it is as much. Paths that run into the lamps by chance find
/// it with a noise of 0.5 %.
TEST(TexturePictures, ofLamps_giveTheSameLightHoweverItIsFound)
{
    auto lightBy = [](uint32_t lightSampling) {
        Scene scene = emptyScene(24, 24, 1);
        scene.settings.spp = 256;
        scene.settings.lightSampling = lightSampling;
        addMaterial(scene, "floor", vec3(0.8f));
        addLevel(scene, 0, 2);
        Material& lamp = addTextured(
            scene, 3, 1,
            {packTexel(255, 0, 0, 255), packTexel(0, 255, 0, 10), packTexel(20, 20, 20, 255)},
            nearestTexel());
        lamp.emissionTexture = lamp.baseColorTexture;
        lamp.emission = vec3(8);
        lamp.alphaCutoff = 0.5f;
        addRectangle(scene, {-1.5, 1, -1.5}, {3, 0, 0}, {0, 0, 3});
        Material& globe = addTextured(scene, 4, 4, patches(4, 4, false));
        globe.emissionTexture = globe.baseColorTexture;
        globe.emission = vec3(6);
        addSphere(scene, {1, 0.5f, 1}, 0.3f);
        lookParallel(scene, {0, 0.01, 0}, {0, 0, 0}, 2, {0, 0, -1});
        const Image image = meanImage(filmOf(scene));
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < image.rgb.size(); i++) sum[static_cast<int>(i % 3)] += image.rgb[i];
        return sum / double(24 * 24);
    };
    const glm::dvec3 both = lightBy(LIGHTS_MIS), shadowRays = lightBy(LIGHTS_ONLY),
                     scattered = lightBy(LIGHTS_BSDF_ONLY);
    for (int c = 0; c < 3; c++) {
        EXPECT_NEAR(shadowRays[c] / both[c], 1, 0.01) << c;
        EXPECT_NEAR(scattered[c] / both[c], 1, 0.02) << c;
    }
}

/// Cards over a floor, seen from above; no pixel's centre lies on the border of a hole or of its
/// shadow.
Scene cardScene(bool byTexture)
{
    Scene scene = emptyScene(32, 32, 1);
    scene.settings.spp = 8;
    scene.settings.jitter = false;
    addMaterial(scene, "floor", vec3(0.8f));
    addLevel(scene, 0, 4);
    if (byTexture) {
        addTextured(scene, 2, 1, {packTexel(255, 255, 255, 200), packTexel(255, 255, 255, 90)},
                    nearestTexel())
            .alphaCutoff = 0.5f;
        addRectangle(scene, {-1.01, 1, 1}, {2.02, 0, 0}, {0, 0, -2});
    } else {
        addMaterial(scene, "card", vec3(1));
        addRectangle(scene, {-1.01, 1, 1}, {1.01, 0, 0}, {0, 0, -2});
    }
    addLight(scene, LIGHT_POINT, vec3(30)).position = {1.5f, 4.03f, 0.37f};
    lookParallel(scene, {0, 8, 0}, {0, 0, 0}, 3, {0, 0, -1});
    return scene;
}

TEST(Holes, letCameraAndShadowRaysThrough_asIfCutByHand)
{
    const Scene byTexture = cardScene(true), byHand = cardScene(false);
    const Image a = meanImage(filmOf(byTexture)), b = meanImage(filmOf(byHand));
    const std::vector<FirstHits> hits = firstHitsOf(byTexture), expected = firstHitsOf(byHand);
    size_t cards = 0, shadows = 0;
    for (size_t i = 0; i < hits.size(); i++) {
        EXPECT_EQ(hits[i].material, expected[i].material) << i;
        EXPECT_NEAR(a.rgb[3 * i], b.rgb[3 * i], 1e-5f * b.rgb[3 * i]) << i;
        cards += hits[i].material == 1 ? 1 : 0;
        shadows += b.rgb[3 * i] == 0 ? 1 : 0;
    }
    EXPECT_GT(cards, 40u);
    EXPECT_GT(shadows, 20u);
}

TEST(Holes, thatNoAlphaMakes_changeNoBit)
{
    for (const float cutoff : {0.86f, 0.87f}) {  // of the texels' 220 / 255
        Scene whole = leavesScene(24, 16, 8);
        for (Material& material : whole.materials) material.alphaCutoff = 0;
        Scene cut = whole;
        cut.materials[0].alphaCutoff = cutoff;
        EXPECT_EQ(filmOf(whole).half[0] == filmOf(cut).half[0], cutoff < 0.862f) << cutoff;
    }
}

TEST(Holes, doNotDependOnTheOrderOfTraversal)
{
    const PreparedScene scene = prepared(leavesScene(32, 24, 8));
    const Film expected = renderFilm(*makeCpuDevice({}), scene);
    for (const uint32_t order : {ORDER_LEFT_FIRST, ORDER_RIGHT_FIRST}) {
        DeviceOptions options;
        options.traversalOrder = order;
        const Film film = renderFilm(*makeCpuDevice(options), scene);
        EXPECT_TRUE(film.half[0] == expected.half[0]);
        EXPECT_TRUE(film.half[1] == expected.half[1]);
        EXPECT_EQ(film.digest, expected.digest);
    }
    Scene other = leavesScene(32, 24, 8);
    const Film binned =
        renderFilm(*makeCpuDevice({}), prepareScene(std::move(other), BvhBuild::binned, 1));
    EXPECT_EQ(binned.digest, expected.digest);
}

/// A map whose normal is (3, -3, 5) / sqrt(43) everywhere: 204, 51 and 255 of 255 are 0.6, -0.6
/// and 1.
constexpr uint32_t LEANING = 0xff000000u | 255u << 16 | 51u << 8 | 204u;

Scene bumpyScene(const glm::dvec3& eye)
{
    Scene scene = squareScene(4);
    addTextured(scene, 1, 1, {LEANING});
    std::swap(scene.materials[0].baseColorTexture, scene.materials[0].normalTexture);
    lookParallel(scene, eye, {0, 0, 0}, 0.9);
    return scene;
}

void expectNormal(const Scene& scene, vec3 expected)
{
    for (const FirstHits& hit : firstHitsOf(scene)) {
        ASSERT_EQ(hit.hits, 1u);
        expectNear(hit.ns, glm::normalize(expected), 1e-6f, "normal");
    }
}

TEST(NormalMap, leansTheNormalAlongTheTexture_onBothSides)
{
    Scene front = bumpyScene({0, 0, 3}), back = bumpyScene({0, 0, -3});
    addSquare(front);
    addSquare(back);
    expectNormal(front, {3, -3, 5});
    expectNormal(back, {-3, 3, -5});
}

TEST(NormalMap, followsTurnedMirroredAndLeaningTextures)
{
    auto withUvs = [](const std::vector<vec2>& uvs) {
        Scene scene = bumpyScene({0, 0, 3});
        Mesh mesh = makeRectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        mesh.uvs = uvs;
        appendShape(scene, mesh, {}, 0, "square");
        return scene;
    };
    expectNormal(withUvs({{0, 0}, {0, 1}, {-1, 1}, {-1, 0}}),
                 {-3, -3, 5});  // u down, v to the right
    expectNormal(withUvs({{0, 0}, {0, 1}, {1, 1}, {1, 0}}),
                 {-3, 3, 5});  // mirrored: u up, v to the right
    expectNormal(withUvs({{0, 0}, {-1, 0}, {-1, 1}, {0, 1}}),
                 {-3, -3, 5});                                           // mirrored: u to the left
    expectNormal(withUvs({{5, 5}, {5, 5}, {5, 5}, {5, 5}}), {0, 0, 1});  // no direction at all
}

TEST(NormalMap, ofMirroredInstances_isMirrored)
{
    Scene scene = bumpyScene({0, 0, 3});
    addSquare(scene);
    scene.objects.push_back(std::move(scene.primitives));
    scene.primitives.clear();
    Placement placement;
    placement.linear = glm::dmat3(-2, 0, 0, 0, 2, 0, 0, 0, 1);
    scene.instances.push_back(placement);
    expectNormal(scene, {-3, -3, 5});
}

TEST(NormalMap, hasAStrength_andFlatNormalsHaveNone)
{
    Scene scene = bumpyScene({0, 0, 3});
    addSquare(scene);
    scene.textures[0].strength = 0.5f;
    expectNormal(scene, {3, -3, 10});
    scene.settings.shading |= SHADING_FLAT;
    expectNormal(scene, {0, 0, 1});
}

/// The square with that normal at all its corners, lit by one light from the front.
TEST(NormalMap, ofAPlane_shadesAsThePlaneWithThatNormal)
{
    Scene mapped = bumpyScene({0, 0, 3}), bent = bumpyScene({0, 0, 3});
    addSquare(mapped);
    bent.materials[0].normalTexture = NO_TEXTURE;
    Mesh mesh = makeRectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    mesh.normals = {{3, -3, 5}};
    for (MeshTriangle& triangle : mesh.triangles) triangle.normal = {0, 0, 0};
    appendShape(bent, mesh, {}, 0, "square");
    for (Scene* scene : {&mapped, &bent}) {
        addLight(*scene, LIGHT_DIRECTIONAL, vec3(2)).direction =
            glm::normalize(vec3(-0.2f, 0.5f, -1));
        scene->probe = addHalves(*scene, vec3(1, 0.5f, 0.2f), vec3(0.1f, 0.2f, 0.9f));
    }
    const Image a = meanImage(filmOf(mapped)), b = meanImage(filmOf(bent));
    for (size_t i = 0; i < a.rgb.size(); i++) EXPECT_NEAR(a.rgb[i], b.rgb[i], 1e-5f) << i;
    const float cosine =
        glm::dot(glm::normalize(vec3(3, -3, 5)), glm::normalize(vec3(0.2f, -0.5f, 1)));
    EXPECT_GT(a.rgb[0], 2 * cosine / std::numbers::pi_v<float>);
}

}  // namespace
}  // namespace sahl::testing
