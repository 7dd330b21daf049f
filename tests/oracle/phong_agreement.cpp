// The phong integrator against the textbook's, pixel by pixel: with rays through the pixels'
// centres neither has any noise. An error of one percent put into a term must show.
#include "oracle/from_scene.h"
#include "oracle/terms.h"
#include "oracle/textbook_phong.h"
#include "support/render_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sahl::testing {
namespace {

/// float32 knows r.v to about 3e-7, which an exponent of 40 makes 1.2e-5; positions and normals
/// that are known to 1e-6 make about as much. Relative to the pixel, with a floor for dark ones.
constexpr double TOLERANCE = 5e-5;
constexpr double FLOOR = 1e-2;  ///< of the brightest channel

std::vector<textbook::Vec> renderSahl(const Scene& scene)
{
    const PreparedScene prepared = prepareScene(scene, BvhBuild::sweep, 1);
    const Film film = renderFilm(*makeCpuDevice({}), prepared, 0, 1);
    EXPECT_EQ(film.counters.badSamples, 0u);
    std::vector<textbook::Vec> picture;
    for (const HalfPixel& pixel : film.half[0]) {
        picture.push_back(
            {pixel.sum[0].toDouble(), pixel.sum[1].toDouble(), pixel.sum[2].toDouble()});
    }
    return picture;
}

/// What two pictures have in common.
struct Comparison {
    size_t litPixels = 0;
    size_t beyondTolerance = 0;  ///< pixels
    double worst = 0;            ///< relative difference of a channel
};

Comparison compare(const std::vector<textbook::Vec>& a, const std::vector<textbook::Vec>& b)
{
    double brightest = 0;
    for (const textbook::Vec& v : b) brightest = std::max({brightest, v.x, v.y, v.z});
    Comparison result;
    for (size_t i = 0; i < a.size(); i++) {
        double difference = 0;
        for (auto [x, y] : {std::pair{a[i].x, b[i].x}, {a[i].y, b[i].y}, {a[i].z, b[i].z}}) {
            difference = std::max(difference, std::abs(x - y) / (y + FLOOR * brightest));
        }
        result.litPixels += b[i].x + b[i].y + b[i].z > 0;
        result.beyondTolerance += difference > TOLERANCE;
        result.worst = std::max(result.worst, difference);
    }
    return result;
}

class PhongTerms : public ::testing::TestWithParam<Term> {};

TEST_P(PhongTerms, bothAgreeInEveryPixelAndOnePercentOfErrorIsSeen)
{
    const Term& term = GetParam();
    const std::vector<textbook::Vec> sahl = renderSahl(term.make());
    const Comparison right = compare(sahl, textbook::renderPhong(textbookPhong(term.make())));
    EXPECT_GT(right.litPixels, sahl.size() / 8);
    EXPECT_EQ(right.beyondTolerance, 0u) << "worst " << right.worst;

    Scene wrong = term.make();
    term.disturb(wrong, 0.01f);
    const Comparison seen = compare(sahl, textbook::renderPhong(textbookPhong(wrong)));
    EXPECT_GT(seen.beyondTolerance, right.litPixels / 100)
        << "an error of 1 % in the " << term.error << " was not seen";
    EXPECT_GT(seen.worst, 1e-3);
    std::printf("%-20s %4zu pixels lit, worst %.1e; with 1 %% error %4zu differ, worst %.1e (%s)\n",
                term.name, right.litPixels, right.worst, seen.beyondTolerance, seen.worst,
                term.error);
}

INSTANTIATE_TEST_SUITE_P(, PhongTerms, ::testing::ValuesIn(phongTerms()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace sahl::testing
