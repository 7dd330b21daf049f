// Are the rules of adaptive sampling biased? Each decides on millions of synthetic pixels, by the
// text's own functions, whose right value is known.

#include "reference/kernel.h"
#include "render/adaptive_passes.h"
#include "support/adaptive_scenes.h"
#include "util/parallel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sahl::testing {
namespace {

using Kernel = reference::Kernel<>;

constexpr uint32_t SIDE = 100;  // of a picture of alike pixels that do not know of each other
constexpr uint32_t PIXELS = SIDE * SIDE;
constexpr uint32_t PILOTS = 32, MOST = 128;

/// Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators".
struct SplitMix {
    uint64_t state;
    uint32_t next()
    {
        uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<uint32_t>((z ^ (z >> 31)) >> 32);
    }
};

/// A distribution by 4096 equally likely values.
struct Distribution {
    const char* name;
    float target;  // so that some pixels meet it and others do not
    std::vector<float> values;

    double mean() const
    {
        double sum = 0;
        for (float value : values) sum += value;
        return sum / double(values.size());
    }
};

/// Uniform in [0, 1], and with a probability of 1/100 (41 of 4096) a bright spot on top.
Distribution rareBrightSpots()
{
    Distribution result = {"Bernoulli plus uniform", 0.15f, {}};
    for (uint32_t i = 0; i < 4096; i++) {
        const float uniform = (static_cast<float>(i * 1663 % 4096) + 0.5f) / 4096;
        result.values.push_back(uniform + (i < 41 ? 50.0f : 0.0f));
    }
    return result;
}

/// exp of a normal variable of standard deviation 1.5, by its quantiles.
Distribution lognormal()
{
    Distribution result = {"lognormal", 0.4f, {}};
    for (uint32_t i = 0; i < 4096; i++) {
        const double p = (i + 0.5) / 4096;
        double low = -5, high = 5;
        while (high - low > 1e-9) {
            const double middle = (low + high) / 2;
            (std::erfc(-middle / std::sqrt(2.0)) / 2 < p ? low : high) = middle;
        }
        result.values.push_back(static_cast<float>(std::exp(1.5 * low)));
    }
    return result;
}

/// The picture number `picture`; its samples are a function of pixel and block.
class SyntheticPicture {
public:
    SyntheticPicture(const Distribution& distribution, uint32_t picture)
        : distribution_(distribution), picture_(picture), films_(PIXELS)
    {
    }

    float sample(SplitMix& random) const { return distribution_.values[random.next() >> 20]; }

    SplitMix blockOf(uint32_t pixel, uint32_t block) const
    {
        SplitMix mix = {
            (uint64_t{picture_} << 40 | uint64_t{pixel} << 20 | block) * 0xd1342543de82ef95u + 1};
        mix.state = uint64_t{mix.next()} << 32 | mix.next();
        return mix;
    }

    void addBlock(uint32_t pixel, uint32_t number)
    {
        PixelBlock block = {};
        SplitMix random = blockOf(pixel, number);
        for (block.samplesDone = 0; block.samplesDone < BLOCK_SIZE; block.samplesDone++) {
            const vec3 L(sample(random));
            block.sum = block.sum + L;
            const float y = kernel.luminance(L);
            block.sumY2 = block.sumY2 + y * y;
        }
        kernel.addBlock(block, number * BLOCK_SIZE, films_[pixel]);
    }

    void addBlocks(uint32_t first, uint32_t end)
    {
        for (uint32_t pixel = 0; pixel < PIXELS; pixel++)
            for (uint32_t number = first; number < end; number++) addBlock(pixel, number);
    }

    /// As kernels/adaptive_decide.comp does it.
    void estimate(const AdaptiveRule& rule)
    {
        estimates_.resize(PIXELS);
        for (uint32_t pixel = 0; pixel < PIXELS; pixel++)
            estimates_[pixel] = kernel.estimateOf(rule, films_[pixel]);
        kernel.estimates = estimates_;
        kernel.pictureWidth = SIDE;
    }

    AdaptiveFloors floors() const { return floorsOf(estimates_); }

    double meanOfHalf(uint32_t pixel, bool ofA) const
    {
        const FilmPixel& film = films_[pixel];
        return kernelRed(ofA ? film.sumsA : film.sumsB) / (ofA ? film.samplesA : film.samplesB);
    }

    double pooledMean(uint32_t pixel) const
    {
        const FilmPixel& film = films_[pixel];
        return (kernelRed(film.sumsA) + kernelRed(film.sumsB)) / (film.samplesA + film.samplesB);
    }

    uint32_t samples(uint32_t pixel) const
    {
        return films_[pixel].samplesA + films_[pixel].samplesB;
    }

    Kernel kernel = {};

private:
    static double kernelRed(const FilmSums& sums)
    {
        return double(sums.red.w) * 0x1p32 + double(sums.red.z) + double(sums.red.y) * 0x1p-32;
    }

    const Distribution& distribution_;
    uint32_t picture_;
    std::vector<FilmPixel> films_;
    std::vector<PixelEstimate> estimates_;
};

/// Means of a picture by each way, in the order of WAYS.
enum Way { CROSSED, POOLED, JOINT, REPORT, WAYS };
constexpr const char* NAMES[] = {"crossed", "crossed, pooled by count", "joint", "report"};

struct PictureMeans {
    std::array<double, WAYS> mean = {}, samples = {};
};

void runCrossed(const Distribution& distribution, uint32_t number, PictureMeans& means)
{
    const AdaptiveRule rule = targetRule(ADAPTIVE_CROSSED, distribution.target, PILOTS, MOST);
    SyntheticPicture picture(distribution, number);
    picture.addBlocks(0, PILOTS / BLOCK_SIZE);
    picture.estimate(rule);
    const AdaptiveFloors floors = picture.floors();
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        const uvec2 wanted =
            picture.kernel.wantedByCrossed(rule, floors, pixel % SIDE, pixel / SIDE);
        for (uint32_t pass = PILOTS / BLOCK_SIZE; pass < MOST / BLOCK_SIZE; pass++) {
            const bool takes = pass % 2 == 0 ? picture.kernel.lacksInA(rule, wanted.x, pass)
                                             : picture.kernel.lacksInB(rule, wanted.y, pass);
            if (takes) picture.addBlock(pixel, pass);
        }
        means.mean[CROSSED] +=
            (picture.meanOfHalf(pixel, true) + picture.meanOfHalf(pixel, false)) / 2 / PIXELS;
        means.mean[POOLED] += picture.pooledMean(pixel) / PIXELS;
        means.samples[CROSSED] += double(picture.samples(pixel)) / PIXELS;
    }
    means.samples[POOLED] = means.samples[CROSSED];
}

void runJoint(const Distribution& distribution, uint32_t number, PictureMeans& means)
{
    const AdaptiveRule rule = targetRule(ADAPTIVE_JOINT, distribution.target, PILOTS, MOST);
    SyntheticPicture picture(distribution, number);
    uint32_t passes = PILOTS / BLOCK_SIZE;
    picture.addBlocks(0, passes);
    picture.estimate(rule);
    const AdaptiveFloors floors = picture.floors();
    std::vector<uint32_t> states(PIXELS, PIXEL_ACTIVE);
    for (bool active = true; active; passes++) {
        for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
            if (states[pixel] != PIXEL_ACTIVE) continue;
            states[pixel] = picture.kernel.stateByJoint(rule, floors, pixel % SIDE, pixel / SIDE,
                                                        picture.samples(pixel));
        }
        active = false;
        for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
            if (states[pixel] != PIXEL_ACTIVE) continue;
            picture.addBlock(pixel, passes);
            active = true;
        }
        picture.estimate(rule);
    }
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        means.mean[JOINT] += picture.pooledMean(pixel) / PIXELS;
        means.samples[JOINT] += double(picture.samples(pixel)) / PIXELS;
    }
}

void runReport(const Distribution& distribution, uint32_t number, PictureMeans& means)
{
    const AdaptiveRule rule = reportRule(0.01f, PILOTS, MOST);
    SyntheticPicture picture(distribution, number);
    for (uint32_t pixel = 0; pixel < PIXELS; pixel++) {
        SplitMix random = picture.blockOf(pixel, 0);
        double sum = 0;
        uint32_t n = 0, state = PIXEL_ACTIVE;
        vec3 mean(0);
        while (state == PIXEL_ACTIVE) {
            const float value = picture.sample(random);
            sum += value;
            state = picture.kernel.stateAfter(rule, vec3(value), ++n, mean);
        }
        means.mean[REPORT] += sum / n / PIXELS;
        means.samples[REPORT] += double(n) / PIXELS;
    }
}

struct Bias {
    double bias = 0, standardError = 0;  // relative to the right mean
};

/// Over all pictures; the standard error by the spread between these, so that it holds whatever
/// pixels of one picture have to do with each other.
std::array<Bias, WAYS> biases(const Distribution& distribution, uint32_t pictures)
{
    std::vector<PictureMeans> all(pictures);
    parallelFor(pictures, defaultThreadCount(), [&](size_t i) {
        const auto number = static_cast<uint32_t>(i);
        runCrossed(distribution, number, all[i]);
        runJoint(distribution, number, all[i]);
        runReport(distribution, number, all[i]);
    });
    std::array<Bias, WAYS> result;
    std::printf("%s, %u pixels\n", distribution.name, pictures * PIXELS);
    for (int way = 0; way < WAYS; way++) {
        double sum = 0, squares = 0, samples = 0;
        for (const PictureMeans& means : all) {
            const double relative = means.mean[way] / distribution.mean() - 1;
            sum += relative;
            squares += relative * relative;
            samples += means.samples[way];
        }
        const double n = pictures, bias = sum / n;
        result[way] = {bias, std::sqrt((squares / n - bias * bias) / (n - 1))};
        std::printf("  %-26s %8.3f %% +- %.3f %%, %5.1f samples\n", NAMES[way], 100 * bias,
                    100 * result[way].standardError, samples / n);
    }
    return result;
}

void expectOnlyCrossedIsRight(const Distribution& distribution, uint32_t pictures, double mostBias)
{
    const std::array<Bias, WAYS> result = biases(distribution, pictures);
    EXPECT_LT(std::abs(result[CROSSED].bias), 4 * result[CROSSED].standardError);
    EXPECT_LT(std::abs(result[CROSSED].bias), mostBias);
    for (Way way : {POOLED, JOINT, REPORT}) {
        EXPECT_LT(result[way].bias, -10 * result[way].standardError) << NAMES[way];
        EXPECT_LT(result[way].bias, -0.005) << NAMES[way];
    }
}

TEST(AdaptiveRules, onlyCrossedIsUnbiased)
{
    expectOnlyCrossedIsRight(rareBrightSpots(), 16, 0.02);
}

TEST(LongAdaptiveRules, onlyCrossedIsUnbiased_rareBrightSpotsOnTenMillionPixels)
{
    expectOnlyCrossedIsRight(rareBrightSpots(), 1000, 0.001);
}

TEST(LongAdaptiveRules, onlyCrossedIsUnbiased_lognormalOnTenMillionPixels)
{
    expectOnlyCrossedIsRight(lognormal(), 1000, 0.001);
}

}  // namespace
}  // namespace sahl::testing
