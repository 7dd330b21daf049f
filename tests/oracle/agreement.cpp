// Sahl against the textbook tracer, term by term: both render the same scene with independent
// random numbers, and the means of the frame and of its blocks must agree within their noise. An
// error of one percent put into the term must show.
#include "oracle/from_scene.h"
#include "oracle/terms.h"
#include "support/render_scenes.h"
#include "util/parallel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sahl::testing {
namespace {

constexpr double SHORT_ERROR = 3e-3;  ///< standard error of the frame's mean, relative
constexpr double LONG_ERROR = 5e-4;
constexpr uint32_t BLOCK_SIDE = 8;
constexpr double FAMILY_LEVEL =
    1e-3;  ///< chance that any chi-squared of a suite is out of its range

const std::vector<Term>& allTerms()
{
    static const std::vector<Term> terms = [] {
        std::vector<Term> all = materialTerms();
        for (const Term& term : roughTerms()) all.push_back(term);
        for (const Term& term : lightTerms()) all.push_back(term);
        for (const Term& term : cameraTerms()) all.push_back(term);
        for (const Term& term : instanceTerms()) all.push_back(term);
        return all;
    }();
    return terms;
}

/// A mean luminance and the variance of that mean.
struct Estimate {
    double mean = 0, variance = 0;
};

/// One for every pixel, top row first.
using Picture = std::vector<Estimate>;

/// Paths of a pixel are independent, so the variance of their mean follows from their spread.
Estimate estimateOf(double sumY, double sumY2, double samples)
{
    double mean = sumY / samples;
    double spread = std::max(0.0, sumY2 / samples - mean * mean);
    return {mean, spread / (samples - 1)};
}

Picture pictureOf(const Film& film)
{
    Picture picture;
    for (size_t i = 0; i < film.half[0].size(); i++) {
        textbook::Vec sum;
        double sumY2 = 0, samples = 0;
        for (const auto& half : film.half) {
            sum.x += half[i].sum[0].toDouble();
            sum.y += half[i].sum[1].toDouble();
            sum.z += half[i].sum[2].toDouble();
            sumY2 += half[i].sumY2.toDouble();
            samples += half[i].samples;
        }
        picture.push_back(estimateOf(textbook::luminance(sum), sumY2, samples));
    }
    return picture;
}

Picture pictureOf(const std::vector<textbook::Pixel>& pixels)
{
    Picture picture;
    for (const textbook::Pixel& pixel : pixels) {
        picture.push_back(estimateOf(textbook::luminance(pixel.sum), pixel.sumY2, pixel.samples));
    }
    return picture;
}

/// Mean over a rectangle of pixels.
Estimate meanOver(const Picture& picture, uint32_t pictureWidth, uint32_t x0, uint32_t y0,
                  uint32_t width, uint32_t height)
{
    Estimate mean;
    for (uint32_t y = y0; y < y0 + height; y++) {
        for (uint32_t x = x0; x < x0 + width; x++) {
            const Estimate& pixel = picture[size_t{y} * pictureWidth + x];
            mean.mean += pixel.mean;
            mean.variance += pixel.variance;
        }
    }
    const double count = width * height;
    return {mean.mean / count, mean.variance / (count * count)};
}

Estimate frameMean(const Picture& picture)
{
    const uint32_t count = static_cast<uint32_t>(picture.size());
    return meanOver(picture, count, 0, 0, count, 1);
}

double relativeError(const Estimate& frame)
{
    return std::sqrt(frame.variance) / frame.mean;
}

/// A small error asks for a pilot that has seen what is seldom, too.
constexpr uint32_t pilotSamples(double target)
{
    return target < 1e-3 ? 2048 : 64;
}

constexpr double PILOT_ERROR = 0.2;  ///< relative; more is no picture of the term, but darkness

/// Samples a pixel that bring the frame's standard error to `target` of the mean, with a margin of
/// a tenth for the pilot's own noise. Whole blocks of 8, at least the pilot's; no more where none
/// would do, as in a picture that is black but should not be.
uint32_t samplesFor(const Picture& pilot, double target)
{
    const uint32_t taken = pilotSamples(target);
    EXPECT_GT(frameMean(pilot).mean, 0);
    const double error = relativeError(frameMean(pilot));
    EXPECT_LT(error, PILOT_ERROR) << "hardly any light";
    if (!(error < PILOT_ERROR)) return taken;
    const double ratio = (error / target) * (error / target);
    const double blocks = std::ceil(1.2 * ratio * taken / BLOCK_SIZE);
    return std::max(taken, static_cast<uint32_t>(blocks) * BLOCK_SIZE);
}

/// Sahl's picture, with a standard error of the frame of at most `target` of its mean.
Picture renderSahl(const Scene& scene, double target)
{
    const PreparedScene prepared = prepareScene(scene, BvhBuild::sweep, 1);
    const auto device = makeCpuDevice({});
    const Picture pilot = pictureOf(renderFilm(*device, prepared, 0, pilotSamples(target)));
    // Samples after the pilot's: the choice of their number must not depend on them.
    const Film film = renderFilm(*device, prepared, pilotSamples(target), samplesFor(pilot, target));
    EXPECT_EQ(film.counters.badSamples, 0u);
    return pictureOf(film);
}

Picture renderTextbook(const Scene& scene, double target, uint64_t seed)
{
    const textbook::World world = textbookWorld(scene);
    const unsigned threads = defaultThreadCount();
    const Picture pilot = pictureOf(textbook::render(world, pilotSamples(target), seed, threads));
    const int samples = static_cast<int>(samplesFor(pilot, target));
    return pictureOf(textbook::render(world, samples, seed + 1, threads));
}

/// Difference of two means in standard errors. Sahl adds up blocks in float32: 1e-6 of the mean is
/// granted for that, which counts only where nothing is noisy.
double zScore(const Estimate& a, const Estimate& b)
{
    const double rounding = 1e-6 * (a.mean + b.mean) / 2;
    return (a.mean - b.mean) / std::sqrt(a.variance + b.variance + rounding * rounding + 1e-30);
}

/// Probability that chi-squared with `degrees` of freedom is at most x: the series of the lower
/// incomplete gamma function, Abramowitz and Stegun 6.5.29.
double chiSquaredCdf(double x, int degrees)
{
    const double a = degrees / 2.0, half = x / 2;
    if (half <= 0) return 0;
    if (half > 300 + 10 * a) return 1;  // where the series' terms would underflow
    double term = std::exp(a * std::log(half) - half - std::lgamma(a + 1)), sum = term;
    for (int n = 1; term > 1e-16 * sum; n++) {
        term *= half / (a + n);
        sum += term;
    }
    return std::min(1.0, sum);
}

struct BlockTest {
    double chiSquared = 0;
    int blocks = 0;
};

/// Sum of the squared z-scores of all blocks of 8 x 8 pixels.
BlockTest compareBlocks(const Picture& a, const Picture& b, uint32_t width, uint32_t height)
{
    BlockTest test;
    for (uint32_t y = 0; y < height; y += BLOCK_SIDE) {
        for (uint32_t x = 0; x < width; x += BLOCK_SIDE) {
            const Estimate inA = meanOver(a, width, x, y, BLOCK_SIDE, BLOCK_SIDE);
            const Estimate inB = meanOver(b, width, x, y, BLOCK_SIDE, BLOCK_SIDE);
            if (inA.variance + inB.variance == 0) {
                // Without any noise: all black, or all samples alike.
                EXPECT_NEAR(inA.mean, inB.mean, 1e-5 * inA.mean) << "block at " << x << ", " << y;
                continue;
            }
            const double z = zScore(inA, inB);
            test.chiSquared += z * z;
            test.blocks++;
        }
    }
    return test;
}

/// By Sidak, each of m independent tests at 1 - (1 - level)^(1/m) gives the family its level; half
/// of that lies below the range and half above.
double tailOfRange()
{
    const double m = static_cast<double>(allTerms().size());
    return (1 - std::pow(1 - FAMILY_LEVEL, 1 / m)) / 2;
}

/// Every term has its own random numbers, so that the tests are independent: FNV-1a of its name.
uint32_t seedOf(const Term& term)
{
    uint32_t hash = 2166136261u;
    for (const char* c = term.name; *c; c++) hash = (hash ^ static_cast<uint32_t>(*c)) * 16777619u;
    return hash;
}

/// Both tracers on the term's scene; returns Sahl's picture and prints one line of a table.
Picture expectAgreement(const Term& term, double target)
{
    Scene scene = term.make();
    scene.settings.seed = seedOf(term);
    const Picture sahl = renderSahl(scene, target);
    const Picture book = renderTextbook(scene, target, seedOf(term));
    const Estimate a = frameMean(sahl), b = frameMean(book);
    EXPECT_LE(relativeError(a), target);
    EXPECT_LE(relativeError(b), target);
    EXPECT_LT(std::abs(zScore(a, b)), 4) << "means " << a.mean << " and " << b.mean;
    const BlockTest blocks = compareBlocks(sahl, book, scene.settings.width, scene.settings.height);
    const double p = chiSquaredCdf(blocks.chiSquared, blocks.blocks);
    EXPECT_GT(p, tailOfRange()) << "chi-squared " << blocks.chiSquared << " over " << blocks.blocks;
    EXPECT_LT(p, 1 - tailOfRange())
        << "chi-squared " << blocks.chiSquared << " over " << blocks.blocks;
    std::printf("%-22s mean %8.5f  s.e. %.3f %% and %.3f %%  chi^2 %4.1f of %2d  z %5.2f",
                term.name, a.mean, 100 * relativeError(a), 100 * relativeError(b),
                blocks.chiSquared, blocks.blocks, zScore(a, b));
    return sahl;
}

/// The same, then the textbook tracer with an error of 1 % in the term must differ by more than 4
/// standard errors, or in its blocks where the error only moves light about.
void expectPower(const Term& term)
{
    const Picture sahl = expectAgreement(term, LONG_ERROR);
    Scene wrong = term.make();
    term.disturb(wrong, 0.01f);
    const Picture book = renderTextbook(wrong, LONG_ERROR, seedOf(term) + 2);
    const double z = zScore(frameMean(sahl), frameMean(book));
    const BlockTest blocks = compareBlocks(sahl, book, wrong.settings.width, wrong.settings.height);
    if (term.inBlocks) {
        EXPECT_GT(chiSquaredCdf(blocks.chiSquared, blocks.blocks), 1 - tailOfRange());
    } else {
        EXPECT_GT(std::abs(z), 4) << "an error of 1 % in the " << term.error << " was not seen";
    }
    std::printf("  with 1 %% error: chi^2 %9.1f  z %6.2f  (%s)\n", blocks.chiSquared, z,
                term.error);
}

class Terms : public ::testing::TestWithParam<Term> {};
class LongTerms : public ::testing::TestWithParam<Term> {};

std::string nameOf(const ::testing::TestParamInfo<Term>& info)
{
    return info.param.name;
}

TEST_P(Terms, bothTracersAgree)
{
    expectAgreement(GetParam(), SHORT_ERROR);
    std::printf("\n");
}

TEST_P(LongTerms, bothTracersAgreeAndOnePercentOfErrorIsSeen)
{
    expectPower(GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, Terms, ::testing::ValuesIn(allTerms()), nameOf);
INSTANTIATE_TEST_SUITE_P(Long, LongTerms, ::testing::ValuesIn(allTerms()), nameOf);

/// The terms whose scenes are the least noisy, for every run.
TEST(Power, onePercentOfErrorIsSeenInTheTermsThatConvergeFast)
{
    for (const Term& term : allTerms()) {
        const std::string name = term.name;
        if (name == "lambert" || name == "lampUnderWater" || name == "pointLight" ||
            name == "latLongTurned" || name == "interpolatedLambert") {
            expectPower(term);
        }
    }
}

}  // namespace
}  // namespace sahl::testing
