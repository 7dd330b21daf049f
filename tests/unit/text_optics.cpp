// Mirrors, glass, metal, lenses and spots of the path tracer's text against formulas in
// double precision or better.

#include "reference/kernel.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

namespace sahl {
namespace {

using glm::dvec3;
using reference::Kernel;
using testing::Random;

constexpr double EPSILON = 0x1p-24;  // half a unit in the last place of a float just above 1

/// From grazing to normal incidence, denser at both ends.
std::vector<float> cosines()
{
    std::vector<float> all = {0, 1e-30f, 1e-10f, 1e-6f, 1e-4f, 1};
    for (int i = 1; i < 1000; i++) {
        const double x = i / 1000.0;
        all.push_back(static_cast<float>(x));
        all.push_back(static_cast<float>(x * x * x * x));
        all.push_back(static_cast<float>(1 - x * x * x * x * 0.01));
    }
    return all;
}

/// Fresnel's equations as in Born and Wolf; 1 under total internal reflection.
double reflectance(double cosI, double eta)
{
    const double sin2 = (1 - cosI) * (1 + cosI) / (eta * eta);
    if (sin2 >= 1) return 1;
    const double cosT = std::sqrt(1 - sin2);
    const double s = (cosI - eta * cosT) / (cosI + eta * cosT);
    const double p = (eta * cosI - cosT) / (eta * cosI + cosT);
    return cosI == 0 ? 1 : (s * s + p * p) / 2;
}

TEST(FresnelDielectric, agreesWithDoublePrecision)
{
    Kernel<> kernel;
    for (float eta :
         {0.05f, 0.4f, 0.6666667f, 0.75f, 0.9999f, 1.0001f, 1.33f, 1.5f, 2.42f, 30.0f}) {
        for (float cosI : cosines()) {
            float cosT;
            const float found = kernel.fresnelDielectric(cosI, eta, cosT);
            const double exact = reflectance(double{cosI}, double{eta});
            ASSERT_GE(found, 0.0f);
            ASSERT_LE(found, 1.0f);
            // cosT^2 is off by a few roundings of its terms; near the critical angle its root, and
            // the reflectance that falls steeply there, are off by much more.
            const double n = double{eta}, c = double{cosI};
            const double slack = 4 * EPSILON * (std::abs(n * n - 1) + c * c) / (n * n);
            const double cosT2 = 1 - (1 - c) * (1 + c) / (n * n);
            const double cosTSlack =
                cosT2 > slack ? slack / std::sqrt(cosT2) : std::sqrt(2 * slack);
            const double slope =
                4 / std::min({c + n * std::sqrt(std::max(0.0, cosT2)) + 1e-12, 1.0});
            ASSERT_NEAR(found, exact, 1e-6 + slope * (1 + n) * cosTSlack) << eta << " " << cosI;
        }
    }
}

TEST(FresnelDielectric, knownAnswers)
{
    Kernel<> kernel;
    float cosT;
    EXPECT_NEAR(kernel.fresnelDielectric(1, 1.5f, cosT), 0.04, 1e-7);
    EXPECT_EQ(cosT, 1.0f);
    EXPECT_NEAR(kernel.fresnelDielectric(1, 1 / 1.5f, cosT), 0.04, 1e-7);
    EXPECT_NEAR(kernel.fresnelDielectric(1, 1.33f, cosT), 0.0200593, 1e-7);
    EXPECT_EQ(kernel.fresnelDielectric(0, 1.5f, cosT), 1.0f);
    // Brewster's angle, tan = eta: only the perpendicular part is reflected, ((1 - n^2)/(1 +
    // n^2))^2 / 2.
    const float brewster = 1 / std::sqrt(1 + 1.5f * 1.5f);
    EXPECT_NEAR(kernel.fresnelDielectric(brewster, 1.5f, cosT), 0.5 * std::pow(1.25 / 3.25, 2),
                1e-7);
    // Beyond the critical angle of 41.8 degrees
    EXPECT_EQ(kernel.fresnelDielectric(0.7f, 1 / 1.5f, cosT), 1.0f);
    EXPECT_EQ(cosT, 0.0f);
    EXPECT_LT(kernel.fresnelDielectric(0.76f, 1 / 1.5f, cosT), 1.0f);
}

TEST(FresnelDielectric, equalIndicesReflectNothing)
{
    Kernel<> kernel;
    for (float cosI : cosines()) {
        if (cosI < 1e-10f) continue;
        float cosT;
        EXPECT_LT(kernel.fresnelDielectric(cosI, 1, cosT), 1e-13f) << cosI;
        EXPECT_NEAR(cosT, cosI, 1e-7f * cosI);
    }
}

TEST(FresnelDielectric, extremeIndicesAreMirrorsAndNeverNan)
{
    Kernel<> kernel;
    for (float eta :
         {0.0f, 1e-38f, 1e-30f, 1e-19f, 1e-10f, 1e-5f, 1e10f, 1e15f, 1e20f, 3e38f, INFINITY}) {
        for (float cosI : {0.0f, 1e-20f, 1e-3f, 0.5f, 0.99999994f, 1.0f}) {
            float cosT;
            const float found = kernel.fresnelDielectric(cosI, eta, cosT);
            ASSERT_TRUE(kernel.isFiniteNumber(found) && kernel.isFiniteNumber(cosT))
                << eta << " " << cosI;
            EXPECT_GE(cosT, 0.0f);
            EXPECT_LE(cosT, 1.0f);
            EXPECT_GT(found, 0.9999f) << eta << " " << cosI;
            EXPECT_LE(found, 1.0f);
        }
    }
}

TEST(Refracted, obeysSnellsLaw)
{
    Kernel<> kernel;
    Random random(1);
    int refractions = 0;
    for (int i = 0; i < 20000; i++) {
        const vec3 n = random.direction();
        vec3 dir = random.direction();
        if (kernel.dot3(dir, n) > 0) dir = -dir;
        const float eta = random.uniform(0.4f, 2.5f);
        const float cosI = kernel.min2(1, -kernel.dot3(dir, n));
        float cosT;
        if (kernel.fresnelDielectric(cosI, eta, cosT) == 1.0f || cosT < 0.02f) continue;
        const vec3 t = kernel.refracted(dir, n, cosI, cosT, eta);
        const dvec3 N(n), D(dir), T(t);
        refractions++;
        ASSERT_NEAR(glm::length(T), 1, 2e-7);
        // eta sinT = sinI as vectors: the same plane, the same side, the same size
        const dvec3 sinI = D - N * glm::dot(D, N), sinT = T - N * glm::dot(T, N);
        ASSERT_LT(glm::length(sinT * double{eta} - sinI), 2e-6);
        ASSERT_LT(glm::dot(T, N), 0);
    }
    EXPECT_GT(refractions, 10000);
}

TEST(Reflected, mirrorsTheDirection)
{
    Kernel<> kernel;
    Random random(2);
    for (int i = 0; i < 10000; i++) {
        const vec3 n = random.direction(), dir = random.direction();
        const dvec3 N(n), D(dir);
        const dvec3 exact = D - N * (2 * glm::dot(D, N));
        const vec3 found = kernel.reflected(dir, n);
        ASSERT_LT(glm::length(dvec3(found) - exact), 1e-6);
        ASSERT_NEAR(glm::length(dvec3(found)), 1, 2e-7);
    }
}

double conductorReflectance(double cosI, std::complex<double> index)
{
    const double sin2 = (1 - cosI) * (1 + cosI);
    const std::complex<double> m2 = index * index, root = std::sqrt(m2 - sin2);
    if (cosI == 0) return 1;
    const double s = std::norm((cosI - root) / (cosI + root));
    const double p = std::norm((m2 * cosI - root) / (m2 * cosI + root));
    return (s + p) / 2;
}

TEST(FresnelConductor, agreesWithComplexArithmetic)
{
    Kernel<> kernel;
    const float indices[][2] = {{0.21f, 3.272f},   {1.38f, 1.914f}, {0.04f, 2.657f},
                                {1.366f, 7.4052f}, {3.1f, 3.3f},    {1.5f, 0},
                                {1, 0.001f},       {30, 60}};
    for (const auto& [eta, k] : indices) {
        for (float cosI : cosines()) {
            const float found = kernel.fresnelConductor(cosI, eta, k);
            ASSERT_GE(found, 0.0f);
            ASSERT_LE(found, 1.0f);
            ASSERT_NEAR(found, conductorReflectance(double{cosI}, {double{eta}, double{k}}), 1e-5)
                << eta << " " << k << " " << cosI;
        }
    }
}

TEST(FresnelConductor, isNeverNan)
{
    Kernel<> kernel;
    for (float eta : {0.0f, 1e-10f, 1.0f, 1e6f}) {
        for (float k : {0.0f, 1e-10f, 1.0f, 1e6f}) {
            for (float cosI : {0.0f, 1e-20f, 1e-3f, 0.5f, 1.0f}) {
                const float found = kernel.fresnelConductor(cosI, eta, k);
                ASSERT_TRUE(found >= 0 && found <= 1)
                    << eta << " " << k << " " << cosI << " " << found;
            }
        }
    }
}

TEST(SpotFalloff, isSmoothBetweenTheAngles)
{
    Kernel<> kernel;
    Light light = {};
    light.cosOuter = 0.5f;
    light.cosInner = 0.75f;
    EXPECT_EQ(kernel.spotFalloff(light, -1), 0.0f);
    EXPECT_EQ(kernel.spotFalloff(light, 0.5f), 0.0f);
    EXPECT_EQ(kernel.spotFalloff(light, 0.5625f), 0.15625f);  // 3/16 - 2/64
    EXPECT_EQ(kernel.spotFalloff(light, 0.625f), 0.5f);
    EXPECT_EQ(kernel.spotFalloff(light, 0.75f), 1.0f);
    EXPECT_EQ(kernel.spotFalloff(light, 1), 1.0f);
    light.cosInner = light.cosOuter;
    EXPECT_EQ(kernel.spotFalloff(light, 0.5f), 0.0f);
    EXPECT_EQ(kernel.spotFalloff(light, 0.50001f), 1.0f);
}

/// 64 cells of equal area; the sum of squared deviations is distributed as chi-squared with 63
/// degrees of freedom, which exceeds 113 with probability 1e-4.
TEST(SampleDisk, isUniform)
{
    Kernel<> kernel;
    constexpr uint SAMPLES = 1u << 18, RINGS = 8, SECTORS = 8;
    std::vector<double> counts(RINGS * SECTORS);
    for (uint i = 0; i < SAMPLES; i++) {
        const vec4 u = kernel.random4(i, 1, 2);
        const vec2 p = kernel.sampleDisk(u.x, u.y);
        const double r2 = double{p.x} * double{p.x} + double{p.y} * double{p.y};
        ASSERT_LE(r2, 1 + 1e-6);
        const double turn = std::atan2(double{p.y}, double{p.x}) / (2 * std::numbers::pi) + 0.5;
        const uint ring = std::min(RINGS - 1, static_cast<uint>(r2 * RINGS));
        const uint sector = std::min(SECTORS - 1, static_cast<uint>(turn * SECTORS));
        counts[ring * SECTORS + sector]++;
    }
    const double expected = double(SAMPLES) / (RINGS * SECTORS);
    double chi2 = 0;
    for (double count : counts) chi2 += (count - expected) * (count - expected) / expected;
    EXPECT_LT(chi2, 113);
}

Frame lensFrame()
{
    Frame frame = {};
    frame.width = 64;
    frame.height = 48;
    frame.camera.position = {1, 2, 3};
    frame.camera.forward = {0, 0.6f, -0.8f};
    frame.camera.right = {0.5f, 0, 0};
    frame.camera.down = {0, -0.3f, -0.225f};
    frame.camera.focusDistance = 7;
    return frame;
}

TEST(CameraRay, lensRaysMeetInThePlaneOfFocus)
{
    Kernel<> pinhole, lens;
    pinhole.frame = lens.frame = lensFrame();
    lens.frame.camera.lensRight = {0.25f, 0, 0};
    lens.frame.camera.lensDown = {0, -0.2f, -0.15f};
    Random random(6);
    auto inFocus = [&](const Kernel<>::Ray& ray) {
        const dvec3 forward(lens.frame.camera.forward), org(ray.org), dir(ray.dir);
        const double depth = glm::dot(org - dvec3(lens.frame.camera.position), forward);
        return org + dir * ((7 - depth) / glm::dot(dir, forward));
    };
    double widest = 0;
    for (int i = 0; i < 2000; i++) {
        const float x = random.uniform(0, 64), y = random.uniform(0, 48);
        const auto through = lens.cameraRay(x, y, random.uniform(), random.uniform());
        const auto straight = pinhole.cameraRay(x, y, 0.5f, 0.5f);
        EXPECT_EQ(straight.org, vec3(1, 2, 3));
        ASSERT_LT(glm::length(inFocus(through) - inFocus(straight)), 1e-5);
        const dvec3 onLens = dvec3(through.org) - dvec3(1, 2, 3);
        ASSERT_LE(glm::length(onLens), 0.25 * (1 + 1e-5));
        ASSERT_NEAR(glm::dot(onLens, dvec3(lens.frame.camera.forward)), 0, 1e-6);
        widest = std::max(widest, glm::length(onLens));
    }
    EXPECT_GT(widest, 0.24);
}

TEST(CameraRay, orthographicRaysAreParallel)
{
    Kernel<> kernel;
    kernel.frame = lensFrame();
    kernel.frame.camera.type = CAMERA_ORTHOGRAPHIC;
    const auto ray = kernel.cameraRay(64, 24, 0.3f, 0.6f);
    EXPECT_EQ(ray.dir, vec3(0, 0.6f, -0.8f));
    EXPECT_EQ(ray.org, vec3(1.5f, 2, 3));
}

}  // namespace
}  // namespace sahl
