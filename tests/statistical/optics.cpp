// Closed forms of optics: a glass ball under white light, a thick plate, the apparent depth of what
// lies under water, the blur of a thin lens.

#include "support/render_scenes.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl::testing {
namespace {

/// Sum of the green channel and number of samples of a pixel (all pictures here are grey).
struct PixelSum {
    double sum = 0, samples = 0;
};

std::vector<PixelSum> renderSums(Scene scene, uint32_t spp)
{
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    const Film film = renderFilm(*makeCpuDevice({}), prepared, 0, spp);
    EXPECT_EQ(film.counters.badSamples, 0u);
    std::vector<PixelSum> sums(film.half[0].size());
    for (const auto& half : film.half) {
        for (size_t i = 0; i < sums.size(); i++) {
            sums[i].sum += half[i].sum[1].toDouble();
            sums[i].samples += half[i].samples;
        }
    }
    return sums;
}

/// Fresnel's reflectance for unpolarised light from vacuum into index n, by the sines and tangents
/// of Fresnel's own memoir; Born and Wolf, "Principles of Optics", Sec. 1.5.2, Eq. 21.
double fresnel(double thetaI, double n)
{
    if (thetaI < 1e-6) return (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    const double thetaT = std::asin(std::sin(thetaI) / n);
    const double s = std::sin(thetaI - thetaT) / std::sin(thetaI + thetaT);
    const double t = std::tan(thetaI - thetaT) / std::tan(thetaI + thetaT);
    return (s * s + t * t) / 2;
}

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180;
}

constexpr double GLASS = 1.5;
constexpr uint32_t BALL_SIZE = 32;  // [pixels]

/// What the picture of the ball shows, in radii of the ball: the square around (x, 0).
struct View {
    double x, half;
};

/// A ball of glass in white light, seen by parallel rays.
Scene whiteBall(View view, uint32_t maxBounces)
{
    Scene scene = emptyScene(BALL_SIZE, BALL_SIZE, maxBounces);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), float(GLASS));
    addSphere(scene, {0, 0, 0}, 1);
    scene.probe = addHalves(scene, vec3(1), vec3(1));
    lookParallel(scene, {view.x, 0, 4}, {view.x, 0, 0}, view.half);
    return scene;
}

/// What a pixel of the ball loses, averaged over the pixel.
///
/// A path that meets the ball at angle theta is reflected with R(theta), which ends in the light,
/// or goes in with T = 1 - R. Inside it meets the surface at the angle at which it went in, over
/// and over, so each time it stays with the same R. After N scatterings T R^(N-1) of all paths are
/// still inside and see no light; the others bring 1 (the factors 1/eta^2 and eta^2 cancel).
double expectedLoss(View view, uint32_t x, uint32_t y, uint32_t bounces)
{
    constexpr int GRID = 64;
    double sum = 0;
    for (int j = 0; j < GRID; j++) {
        for (int i = 0; i < GRID; i++) {
            const double px = (x + (i + 0.5) / GRID) * 2 / BALL_SIZE - 1;
            const double py = (y + (j + 0.5) / GRID) * 2 / BALL_SIZE - 1;
            const double sine = std::hypot(view.x + px * view.half, py * view.half);
            if (sine >= 1) continue;
            const double r = fresnel(std::asin(sine), GLASS);
            sum += (1 - r) * std::pow(r, bounces - 1);
        }
    }
    return sum / (GRID * GRID);
}

/// Losses of a pixel or of several together.
struct Losses {
    double expected = 0, found = 0;
};

/// Chi-squared of binomial losses against their expectation. Pixels in which fewer than 10 are
/// expected are taken together until they have as many, in the order of their expectation.
void expectBinomial(std::vector<Losses> pixels, double samples)
{
    std::sort(pixels.begin(), pixels.end(),
              [](const Losses& a, const Losses& b) { return a.expected < b.expected; });
    double chiSquared = 0;
    int cells = 0;
    Losses total, cell;
    double cellSamples = 0;
    for (const Losses& pixel : pixels) {
        total.expected += pixel.expected;
        total.found += pixel.found;
        cell.expected += pixel.expected;
        cell.found += pixel.found;
        cellSamples += samples;
        if (cell.expected < 10) continue;
        const double difference = cell.found - cell.expected;
        chiSquared += difference * difference / (cell.expected * (1 - cell.expected / cellSamples));
        cells++;
        cell = {};
        cellSamples = 0;
    }
    std::printf("lost %.0f, expected %.1f; chi-squared %.1f over %d cells\n", total.found,
                total.expected, chiSquared, cells);
    EXPECT_NEAR(total.found, total.expected, 4 * std::sqrt(total.expected));
    // 99.9 % of a chi-squared distribution of so many degrees lie within 3.3 standard deviations.
    EXPECT_NEAR(chiSquared, cells, 3.3 * std::sqrt(2.0 * cells));
}

/// More than two bounces are made only by paths that come in near the rim, so the view for N = 8 is
/// narrow. For N = 64 the whole ball loses one path in four millions: of the last ten-thousandth of
/// its radius, where an angle depends on the last bits of float and on the offset of a ray's
/// origin.
TEST(GlassBall, underWhiteLightLosesWhatIsStillInsideAfterTheLastBounce)
{
    constexpr uint32_t SPP = 4096;
    const std::pair<uint32_t, View> cases[] = {
        {1, {0, 1.1}}, {2, {0, 1.1}}, {8, {0.97, 0.04}}, {64, {0, 1.1}}};
    for (const auto& [bounces, view] : cases) {
        const std::vector<PixelSum> sums = renderSums(whiteBall(view, bounces), SPP);
        std::vector<Losses> pixels;
        for (uint32_t y = 0; y < BALL_SIZE; y++) {
            for (uint32_t x = 0; x < BALL_SIZE; x++) {
                const double found = SPP - sums[y * BALL_SIZE + x].sum;
                const double expected = expectedLoss(view, x, y, bounces) * SPP;
                // Every sample is 1 or 0 but for the rounding of 1/eta^2 times eta^2.
                EXPECT_NEAR(found, std::round(found), 1e-6 * SPP);
                if (expected > 0) {
                    pixels.push_back({expected, found});
                } else {
                    EXPECT_NEAR(found, 0, 1e-6 * SPP);
                }
            }
        }
        std::printf("N = %2u: ", bounces);
        expectBinomial(pixels, SPP);
    }
}

/// A plate of glass between the levels 0 and -1, so wide that no path reaches its edge, seen from
/// above at an angle by parallel rays. Light comes from one half of the sky.
Scene plate(double degrees, bool lightAbove)
{
    Scene scene = emptyScene(16, 16, 64);
    scene.settings.seed = static_cast<uint32_t>(2 * degrees) + (lightAbove ? 1 : 0);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), float(GLASS));
    addLevel(scene, 0, 500, true);
    addLevel(scene, -1, 500, false);
    scene.probe = addHalves(scene, vec3(lightAbove ? 1.0f : 0.0f), vec3(lightAbove ? 0.0f : 1.0f));
    const double angle = radians(degrees);
    lookParallel(scene, {3 * std::sin(angle), 3 * std::cos(angle), 0}, {0, 0, 0}, 0.1, {0, 0, 1});
    return scene;
}

struct Share {
    double value, standardError;
};

/// Mean of samples that are 0 or 1.
Share shareOfLight(const Scene& scene, uint32_t spp)
{
    double sum = 0, samples = 0;
    for (const PixelSum& pixel : renderSums(scene, spp)) {
        sum += pixel.sum;
        samples += pixel.samples;
    }
    const double p = sum / samples;
    return {p, std::sqrt(std::max(0.0, p * (1 - p)) / samples)};
}

/// Light goes to and fro between the two faces: a geometric series.
TEST(Plate, reflectsAndTransmitsTheSumsOfAllItsReflections)
{
    constexpr uint32_t SPP = 2048;  // half a million samples: a standard error of 0.0007 at most
    for (double degrees : {0.0, 20.0, 40.0, 60.0, 75.0, 85.0}) {
        const double r = fresnel(radians(degrees), GLASS), t = 1 - r;
        const double reflected = r + t * t * r / (1 - r * r);
        const double transmitted = t * t / (1 - r * r);
        ASSERT_NEAR(reflected + transmitted, 1, 1e-12);
        const Share above = shareOfLight(plate(degrees, true), SPP);
        const Share below = shareOfLight(plate(degrees, false), SPP);
        std::printf("%2.0f degrees: R' %.5f, expected %.5f; T' %.5f, expected %.5f\n", degrees,
                    above.value, reflected, below.value, transmitted);
        EXPECT_NEAR(above.value, reflected, 4 * above.standardError + 1e-6);
        EXPECT_NEAR(below.value, transmitted, 4 * below.standardError + 1e-6);
    }
}

/// A picture of something bright: its weight, the centre of the light and its second moment about a
/// point, in pixels, with standard errors. All bright samples count alike.
struct Blur {
    double hits = 0;             ///< samples that saw the light
    glm::dvec2 centre = {0, 0};  ///< [pixels] from the picture's top left corner
    double spread = 0;           ///< mean squared distance from the centre [pixels^2]
    double spreadError = 0;      ///< one standard error of that
};

Blur measure(const Scene& scene, uint32_t spp, double radiance)
{
    const std::vector<PixelSum> sums = renderSums(scene, spp);
    const uint32_t width = scene.settings.width;
    auto position = [&](size_t i) {
        return glm::dvec2(static_cast<double>(i % width) + 0.5,
                          static_cast<double>(i / width) + 0.5);
    };
    Blur blur;
    for (size_t i = 0; i < sums.size(); i++) {
        blur.hits += sums[i].sum / radiance;
        blur.centre += sums[i].sum / radiance * position(i);
    }
    blur.centre /= blur.hits;
    double fourth = 0;
    for (size_t i = 0; i < sums.size(); i++) {
        const glm::dvec2 arm = position(i) - blur.centre;
        const double r2 = glm::dot(arm, arm);
        blur.spread += sums[i].sum / radiance * r2;
        fourth += sums[i].sum / radiance * r2 * r2;
    }
    blur.spread /= blur.hits;
    blur.spreadError = std::sqrt((fourth / blur.hits - blur.spread * blur.spread) / blur.hits);
    // Sheppard: a sample lies anywhere in its pixel, with a variance of 1/12 on either axis.
    blur.spread += 2.0 / 12;
    return blur;
}

constexpr double WATER = 1.333;
constexpr double DEPTH = 2;       // [m]
constexpr double EYE_HEIGHT = 3;  // [m]

/// Where on the surface a ray goes through that joins the eye at height EYE_HEIGHT over the origin
/// with a point DEPTH below the surface, `away` to the side: the root of Snell's law, by bisection.
double crossingOf(double away)
{
    double lo = 0, hi = away;
    for (int i = 0; i < 100; i++) {
        const double middle = (lo + hi) / 2;
        const double sinI = middle / std::hypot(middle, EYE_HEIGHT);
        const double sinT = (away - middle) / std::hypot(away - middle, DEPTH);
        (sinI < WATER * sinT ? lo : hi) = middle;
    }
    return (lo + hi) / 2;
}

/// A small lamp under water, seen from above where Snell's law puts it. The picture is square
/// around the straight line to that point, so that the lamp must come to lie in its middle.
TEST(Water, showsALampWhereSnellPutsIt)
{
    constexpr uint32_t SIZE = 64, SPP = 256;
    constexpr double LAMP = 0.02;  // radius [m]
    for (double away : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0}) {
        Scene scene = emptyScene(SIZE, SIZE, 4);
        addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), float(WATER));
        addLevel(scene, 0, 50);
        addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(1);
        addSphere(scene, {float(away), float(-DEPTH), 0}, float(LAMP));
        const double crossing = crossingOf(away);
        // Twice as wide as the lamp without water.
        const double distance = std::hypot(away, EYE_HEIGHT + DEPTH);
        const double fovDeg = 4 * LAMP / distance * 180 / std::numbers::pi;
        lookFrom(scene, {0, EYE_HEIGHT, 0}, {crossing, 0, 0}, fovDeg, {0, 0, 1});
        const Blur seen = measure(scene, SPP, 1 / (WATER * WATER));
        const glm::dvec2 off = seen.centre - glm::dvec2(SIZE / 2.0);
        std::printf("%.1f m away: crosses at %.4f m, seen (%.3f, %.3f) pixels beside\n", away,
                    crossing, off.x, off.y);
        EXPECT_GT(seen.hits, 10000);
        // The lamp's picture is an ellipse whose middle Snell's curvature moves by less than a
        // hundredth of its size; the rest is noise, at most 0.05 pixels for so many hits.
        EXPECT_NEAR(off.x, 0, 0.3);
        EXPECT_NEAR(off.y, 0, 0.3);
    }
}

/// Straight from above things seem to lie at DEPTH / eta: a lamp of known size has the angular size
/// of one at that depth. The second moment of a disk's picture is half its radius squared.
TEST(Water, seemsShallowerByItsIndex)
{
    constexpr uint32_t SIZE = 64, SPP = 256;
    constexpr double LAMP = 0.05;
    Scene scene = emptyScene(SIZE, SIZE, 4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), float(WATER));
    addLevel(scene, 0, 50);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(1);
    appendShape(scene, makeDisk({0, -DEPTH, 0}, {0, 1, 0}, LAMP, 256), {}, 1, "lamp");
    const double apparent = LAMP / (EYE_HEIGHT + DEPTH / WATER);  // tangent of the lamp's radius
    const double half = 1.5 * apparent;
    lookFrom(scene, {0, EYE_HEIGHT, 0}, {0, 0, 0}, 2 * std::atan(half) * 180 / std::numbers::pi,
             {0, 0, 1});
    const Blur seen = measure(scene, SPP, 1 / (WATER * WATER));
    const double pixels = apparent / half * SIZE / 2;
    // Paraxial: off by half the square of the angle of 0.7 degrees.
    EXPECT_NEAR(seen.spread, pixels * pixels / 2,
                4 * seen.spreadError + 1e-3 * pixels * pixels / 2);
}

/// A ray from the point a of the lens through the point s of the picture (in tangents, so f s in
/// the plane of focus) is at a + (f s - a) d / f in the plane at distance d. It meets a lamp on the
/// axis there when that is 0:
///     s = a (d - f) / (f d).
/// So the lamp is seen as a disk, evenly bright because the lens is evenly covered, of radius
///     c = A |d - f| / (f d)
/// for a lens of radius A: in the plane of focus A |d - f| / d. The lamp is a disk of radius b
/// itself, which in focus would be seen with radius b / d; positions on lamp and lens are
/// independent, so the variances add up: the mean squared distance is (c^2 + (b/d)^2) / 2.
TEST(ThinLens, blursALampToItsCircleOfConfusion)
{
    constexpr uint32_t SIZE = 64, SPP = 512;
    constexpr double LENS = 0.2, FOCUS = 4;  // [m]
    for (double d : {1.0, 2.5, 4.0, 6.0, 20.0}) {
        const double c = LENS * std::abs(d - FOCUS) / (FOCUS * d);
        const double lamp = std::max(0.3 * c, 0.01) * d;
        Scene scene = emptyScene(SIZE, SIZE, 0);
        addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(1);
        appendShape(scene, makeDisk({0, 0, -d}, {0, 0, 1}, lamp, 256), {}, 0, "lamp");
        const double half = 1.1 * (c + lamp / d);
        lookFrom(scene, {0, 0, 0}, {0, 0, -1}, 2 * std::atan(half) * 180 / std::numbers::pi);
        setLens(scene, float(LENS), float(FOCUS));
        const Blur seen = measure(scene, SPP, 1);
        const double pixel = 2 * half / SIZE;
        const double expected = (c * c + lamp * lamp / (d * d)) / 2 / (pixel * pixel);
        std::printf("%4.1f m: c %.5f, mean squared radius %.3f pixels^2, expected %.3f +- %.3f\n",
                    d, c, seen.spread, expected, seen.spreadError);
        EXPECT_GT(seen.hits, 10000);
        // A polygon of 256 corners is smaller than its circle by 2e-4, see the last term.
        EXPECT_NEAR(seen.spread, expected, 4 * seen.spreadError + 2e-4 * expected);
        EXPECT_NEAR(seen.spread, expected, 0.01 * expected);
    }
}

}  // namespace
}  // namespace sahl::testing
