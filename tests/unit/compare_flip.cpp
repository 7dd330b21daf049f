// FLIP: closed forms for constant pictures, and a second implementation, plain loops over
// two-dimensional kernels in double precision, for all others.
#include "compare/flip.h"
#include "compare/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace sahl {
namespace {

using Rgb = std::array<double, 3>;
using std::numbers::pi;

Image constant(uint32_t width, uint32_t height, const Rgb& rgb)
{
    Image image = {width, height, {}};
    for (uint32_t i = 0; i < width * height; i++) {
        for (double value : rgb) image.rgb.push_back(static_cast<float>(value));
    }
    return image;
}

Image noise(uint32_t width, uint32_t height, uint32_t seed, float scale = 1)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, scale);
    Image image = {width, height, {}};
    for (uint32_t i = 0; i < 3 * width * height; i++) image.rgb.push_back(uniform(random));
    return image;
}

// The witness. sRGB's matrix as IEC 61966-2-1 prints it, to four digits.

constexpr double XYZ[3][3] = {
    {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
constexpr double RGB[3][3] = {
    {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
constexpr double WHITE[3] = {0.9505, 1.0, 1.0890};

Rgb multiplied(const double (&m)[3][3], const Rgb& v)
{
    Rgb result = {};
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) result[i] += m[i][j] * v[j];
    }
    return result;
}

Rgb labOf(const Rgb& rgb)
{
    Rgb t = multiplied(XYZ, rgb);
    for (size_t c = 0; c < 3; c++) {
        t[c] /= WHITE[c];
        t[c] = t[c] > 216.0 / 24389 ? std::cbrt(t[c]) : (24389.0 / 27 * t[c] + 16) / 116;
    }
    const double lightness = 116 * t[1] - 16;
    return {lightness, lightness / 100 * 500 * (t[0] - t[1]),
            lightness / 100 * 200 * (t[1] - t[2])};
}

double hyab(const Rgb& a, const Rgb& b)
{
    return std::fabs(a[0] - b[0]) + std::sqrt(std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

double redistribute(double distance)
{
    const double most = std::pow(hyab(labOf({0, 1, 0}), labOf({0, 0, 1})), 0.7);
    const double error = std::pow(distance, 0.7);
    if (error < 0.4 * most) return 0.95 * error / (0.4 * most);
    return 0.95 + 0.05 * (error - 0.4 * most) / (0.6 * most);
}

/// What constant pictures have: no features, nothing for the filters to change.
double closedForm(const Rgb& a, const Rgb& b)
{
    return redistribute(hyab(labOf(a), labOf(b)));
}

using Kernel = std::vector<double>;  // (2 r + 1)^2 weights

double filtered(const Image& image, int x, int y, const Kernel& kernel, int radius,
                const std::function<double(const Rgb&)>& value)
{
    double sum = 0;
    for (int j = -radius; j <= radius; j++) {
        for (int i = -radius; i <= radius; i++) {
            const int px = std::clamp(x + i, 0, int(image.width) - 1);
            const int py = std::clamp(y + j, 0, int(image.height) - 1);
            const float* rgb = image.rgb.data() + 3 * (py * int(image.width) + px);
            const double weight = kernel[size_t((j + radius) * (2 * radius + 1) + i + radius)];
            sum += weight * value({rgb[0], rgb[1], rgb[2]});
        }
    }
    return sum;
}

Kernel kernelOf(int radius, const std::function<double(double, double)>& value)
{
    Kernel kernel;
    for (int j = -radius; j <= radius; j++) {
        for (int i = -radius; i <= radius; i++) kernel.push_back(value(i, j));
    }
    double positive = 0, negative = 0;
    for (double w : kernel) (w > 0 ? positive : negative) += std::fabs(w);
    for (double& w : kernel) w /= w > 0 ? positive : negative;
    return kernel;
}

Rgb opponentOf(const Rgb& rgb)
{
    Rgb t = multiplied(XYZ, rgb);
    for (size_t c = 0; c < 3; c++) t[c] /= WHITE[c];
    return {116 * t[1] - 16, 500 * (t[0] - t[1]), 200 * (t[1] - t[2])};
}

/// LDR-FLIP of one pixel.
double witness(const Image& reference, const Image& test, int x, int y, double ppd)
{
    const double a[3] = {1, 1, 34.1}, b[3] = {0.0047, 0.0053, 0.04};
    const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    Rgb labs[2];
    double edges[2], points[2];
    for (int which = 0; which < 2; which++) {
        const Image& image = which == 0 ? reference : test;
        Rgb opponent;
        for (size_t c = 0; c < 3; c++) {
            const Kernel kernel = kernelOf(radius, [&](double i, double j) {
                const double d2 = (i * i + j * j) / (ppd * ppd);
                double w = a[c] * std::sqrt(pi / b[c]) * std::exp(-pi * pi * d2 / b[c]);
                if (c == 2) w += 13.5 * std::sqrt(pi / 0.025) * std::exp(-pi * pi * d2 / 0.025);
                return w;
            });
            opponent[c] = filtered(image, x, y, kernel, radius,
                                   [c](const Rgb& rgb) { return opponentOf(rgb)[c]; });
        }
        const double ty = (opponent[0] + 16) / 116;
        Rgb rgb = multiplied(
            RGB, {(ty + opponent[1] / 500) * WHITE[0], ty, (ty - opponent[2] / 200) * WHITE[2]});
        for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
        labs[which] = labOf(rgb);

        const double sigma = 0.5 * 0.082 * ppd;
        const int featureRadius = int(std::ceil(3 * sigma));
        auto lightness = [](const Rgb& at) { return (opponentOf(at)[0] + 16) / 116; };
        auto response = [&](bool second, bool vertical) {
            const Kernel kernel = kernelOf(featureRadius, [&](double i, double j) {
                const double along = vertical ? j : i;
                const double gauss = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
                return second ? (along * along / (sigma * sigma) - 1) * gauss : -along * gauss;
            });
            return filtered(image, x, y, kernel, featureRadius, lightness);
        };
        edges[which] = std::hypot(response(false, false), response(false, true));
        points[which] = std::hypot(response(true, false), response(true, true));
    }
    const double feature =
        std::sqrt(std::max(std::fabs(edges[0] - edges[1]), std::fabs(points[0] - points[1])) /
                  std::sqrt(2.0));
    return std::pow(redistribute(hyab(labs[0], labs[1])), 1 - feature);
}

TEST(CompareFlip, constantPictures_followTheClosedForm)
{
    const Rgb colors[] = {{0, 0, 0}, {1, 1, 1},       {0.5, 0.5, 0.5},
                          {1, 0, 0}, {0.2, 0.4, 0.9}, {0, 0.01, 0}};
    for (const Rgb& a : colors) {
        for (const Rgb& b : colors) {
            for (float value : ldrFlipMap(constant(30, 20, a), constant(30, 20, b), 67, 1)) {
                EXPECT_NEAR(value, closedForm(a, b), 2e-3);  // the witness' matrix has 4 digits
            }
        }
    }
}

TEST(CompareFlip, blackAndWhite_haveTheKnownError)
{
    // L* differs by 100 and nothing else: 100^0.7 = 25.119. Green and blue are 203.305 apart, and
    // 203.305^0.7 = 41.277, of which 40 % are the knee: 0.95 + 0.05 (25.119 - 16.511) / 24.766.
    const std::vector<float> map =
        ldrFlipMap(constant(9, 9, {0, 0, 0}), constant(9, 9, {1, 1, 1}), 67, 1);
    for (float value : map) EXPECT_NEAR(value, 0.96738, 1e-5);
}

TEST(CompareFlip, greenAndBlue_haveTheLargestErrorThatThereIs)
{
    for (float value : ldrFlipMap(constant(9, 9, {0, 1, 0}), constant(9, 9, {0, 0, 1}), 67, 1)) {
        EXPECT_NEAR(value, 1, 1e-6);
    }
}

TEST(CompareFlip, equalPictures_haveNoError_andTheOrderDoesNotMatter)
{
    const Image a = noise(40, 30, 1), b = noise(40, 30, 2);
    for (float value : ldrFlipMap(a, a, 67, 2)) EXPECT_EQ(value, 0);
    EXPECT_EQ(ldrFlipMap(a, b, 67, 1), ldrFlipMap(b, a, 67, 2));
}

TEST(CompareFlip, error_growsWithTheDifferenceAndStaysInRange)
{
    double last = 0;
    for (double value : {0.11, 0.12, 0.15, 0.2, 0.4, 0.7, 1.0}) {
        const float flip = ldrFlipMap(constant(5, 5, {0.1, 0.1, 0.1}),
                                      constant(5, 5, {value, value, value}), 67, 1)[12];
        EXPECT_GT(flip, last);
        EXPECT_LE(flip, 1);
        last = flip;
    }
}

TEST(CompareFlip, map_equalsThePlainLoops)
{
    struct Case {
        Image reference, test;
        double ppd;
    };
    Image edge = constant(33, 27, {0.2, 0.3, 0.4}), spot = edge;
    for (size_t i = 0; i < edge.rgb.size(); i++) {
        if (i / 3 % 33 > 16) edge.rgb[i] = 0.9f;
    }
    for (size_t c = 0; c < 3; c++) spot.rgb[3 * (13 * 33 + 16) + c] = 1;
    const Case cases[] = {{noise(33, 27, 7), noise(33, 27, 8), FLIP_PIXELS_PER_DEGREE},
                          {edge, spot, FLIP_PIXELS_PER_DEGREE},
                          {noise(20, 9, 9), constant(20, 9, {0.5, 0.5, 0.5}), 30}};
    for (const Case& c : cases) {
        const std::vector<float> map = ldrFlipMap(c.reference, c.test, c.ppd, 2);
        const int width = int(c.reference.width), height = int(c.reference.height);
        for (int y = 0; y < height; y += 4) {
            for (int x = 0; x < width; x += 4) {
                EXPECT_NEAR(map[size_t(y * width + x)], witness(c.reference, c.test, x, y, c.ppd),
                            3e-3)
                    << x << " " << y;
            }
        }
    }
}

TEST(CompareFlip, exposures_runFromTheBrightestPixelToTheMedian)
{
    // ACES without its exposure: t(x) = 0.85 at x = 1.70; so 0.85 is at 1.70 / max and 1.70 /
    // median.
    const double a = 0.36 * 2.51 - 0.85 * 0.36 * 2.43, b = 0.6 * 0.03 - 0.85 * 0.6 * 0.59;
    const double bright = (-b + std::sqrt(b * b + 4 * a * 0.85 * 0.14)) / (2 * a);
    Image reference = constant(3, 1, {1, 1, 1});
    for (size_t i = 0; i < 3; i++) reference.rgb[i] = 1024;
    const std::vector<double> exposures = hdrFlipExposures(reference);
    ASSERT_EQ(exposures.size(), 10u);
    EXPECT_NEAR(exposures.front(), std::log2(bright / 1024), 1e-9);
    EXPECT_NEAR(exposures.back(), std::log2(bright), 1e-9);
    EXPECT_NEAR(exposures[1] - exposures[0], 10.0 / 9, 1e-9);
    EXPECT_EQ(hdrFlipExposures(constant(3, 3, {2, 2, 2})).size(), 2u);
    EXPECT_EQ(hdrFlipExposures(constant(3, 3, {0, 0, 0})), std::vector<double>{0});
    Image dark = constant(5, 1, {0, 0, 0});
    dark.rgb[0] = dark.rgb[1] = dark.rgb[2] = 4;
    EXPECT_NEAR(hdrFlipExposures(dark).back(), std::log2(bright / 4), 1e-9);
}

TEST(CompareFlip, hdrFlip_doesNotDependOnTheUnitOfRadiance)
{
    const Image a = noise(24, 20, 3, 10), b = noise(24, 20, 4, 10);
    Image a8 = a, b8 = b;
    for (float& value : a8.rgb) value *= 8;
    for (float& value : b8.rgb) value *= 8;
    const std::vector<float> map = hdrFlipMap(a, b, hdrFlipExposures(a), 67, 1);
    const std::vector<float> map8 = hdrFlipMap(a8, b8, hdrFlipExposures(a8), 67, 2);
    for (size_t i = 0; i < map.size(); i++) EXPECT_NEAR(map[i], map8[i], 1e-5);
}

TEST(CompareFlip, hdrFlip_isTheLargestOverItsExposures)
{
    // Constant pictures: the closed form of the tone mapped values, at every exposure.
    const Image a = constant(4, 4, {3, 3, 3}), b = constant(4, 4, {0.5, 2, 3});
    double largest = 0;
    for (double stops : hdrFlipExposures(a)) {
        auto toned = [&](double v) {
            const double x = v * std::exp2(stops);
            return std::clamp((0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14),
                              0.0, 1.0);
        };
        largest = std::max(
            largest, closedForm({toned(3), toned(3), toned(3)}, {toned(0.5), toned(2), toned(3)}));
    }
    for (float value : hdrFlipMap(a, b, hdrFlipExposures(a), 67, 1))
        EXPECT_NEAR(value, largest, 2e-3);
}

TEST(CompareFlip, hdrFlip_takesBrightAndNegativeValues)
{
    Image a = noise(16, 12, 5), b = a;
    a.rgb[0] = 3e38f;
    b.rgb[4] = -3e38f;
    for (float value : hdrFlipMap(a, b, hdrFlipExposures(a), 67, 1)) {
        EXPECT_TRUE(value >= 0 && value <= 1);
    }
}

}  // namespace
}  // namespace sahl
