// Every BSDF's samples against its density, by Pearson's chi-squared test: on the CPU. The device
// computes the same bits (tests/agreement/bsdf_bits.cpp), so what holds here holds there.

#include "support/bsdf_cases.h"
#include "support/chi_squared.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace sahl::testing {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr double FAMILY_LEVEL = 0.01;

/// Integral of f over a rectangle by Gauss' rule of 3 x 3 points, refined where quarters disagree,
/// and where some corners are zero and others not: there an edge of f passes, maybe between all
/// points.
double integrate(const std::function<double(double, double)>& f, double x0, double x1, double y0,
                 double y1, double tolerance, int depth = 0)
{
    static constexpr double NODE[] = {-0.7745966692414834, 0, 0.7745966692414834};
    static constexpr double WEIGHT[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    auto gauss = [&](double a0, double a1, double b0, double b1) {
        double sum = 0;
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                sum += WEIGHT[i] * WEIGHT[j] *
                       f((a0 + a1 + (a1 - a0) * NODE[i]) / 2, (b0 + b1 + (b1 - b0) * NODE[j]) / 2);
            }
        }
        return sum * (a1 - a0) * (b1 - b0);
    };
    const double x = (x0 + x1) / 2, y = (y0 + y1) / 2;
    const double fine =
        gauss(x0, x, y0, y) + gauss(x, x1, y0, y) + gauss(x0, x, y, y1) + gauss(x, x1, y, y1);
    const int filled = (f(x0, y0) > 0 ? 1 : 0) + (f(x0, y1) > 0 ? 1 : 0) + (f(x1, y0) > 0 ? 1 : 0) +
                       (f(x1, y1) > 0 ? 1 : 0);
    const bool cut = filled != 0 && filled != 4 && (x1 - x0) * (y1 - y0) > 50 * tolerance;
    if (depth >= 9 || (!cut && std::abs(fine - gauss(x0, x1, y0, y1)) < tolerance)) return fine;
    return integrate(f, x0, x, y0, y, tolerance, depth + 1) +
           integrate(f, x, x1, y0, y, tolerance, depth + 1) +
           integrate(f, x0, x, y, y1, tolerance, depth + 1) +
           integrate(f, x, x1, y, y1, tolerance, depth + 1);
}

/// Cells on one side of the surface: rings around an axis, cut into sectors.
struct Cells {
    static constexpr int RINGS = 12, SECTORS = 8;
    dvec3 axis, t, b;
    std::vector<double> border = {0, pi};  ///< of the rings: angles with the axis

    explicit Cells(const vec3& around) : axis(glm::normalize(dvec3(around)))
    {
        t = glm::normalize(glm::cross(axis, dvec3(0.2, 0.5, 0.1)));
        b = glm::cross(axis, t);
    }

    /// Angle with the axis and angle around it in [0, 2 pi).
    glm::dvec2 anglesOf(const dvec3& d) const
    {
        const double across = glm::length(glm::cross(axis, d));
        const double around = std::atan2(glm::dot(d, b), glm::dot(d, t));
        return {std::atan2(across, glm::dot(axis, d)), around < 0 ? around + 2 * pi : around};
    }

    dvec3 directionOf(double theta, double phi) const
    {
        return axis * std::cos(theta) + (t * std::cos(phi) + b * std::sin(phi)) * std::sin(theta);
    }

    /// Rings that a few samples fill evenly, so that narrow lobes are resolved.
    void divide(std::vector<double> angles)
    {
        if (angles.size() < 200) return;
        std::sort(angles.begin(), angles.end());
        border = {0};
        for (int i = 1; i < RINGS; i++) {
            const double angle = angles[angles.size() * static_cast<size_t>(i) / RINGS];
            if (angle > border.back()) border.push_back(angle);
        }
        border.push_back(pi);
    }

    size_t count() const { return (border.size() - 1) * SECTORS; }

    size_t indexOf(const dvec3& d) const
    {
        const glm::dvec2 angles = anglesOf(d);
        const auto above = std::upper_bound(border.begin() + 1, border.end() - 1, angles.x);
        const auto ring = static_cast<size_t>(above - border.begin()) - 1;
        const auto sector = static_cast<size_t>(angles.y / (2 * pi) * SECTORS);
        return ring * SECTORS + std::min<size_t>(sector, SECTORS - 1);
    }

    /// Integral of a density over cell `index`; pieces grow with the distance from the axis to 3
    /// degrees by 11, so that neither a narrow lobe nor what the horizon leaves of a wide one is
    /// overlooked.
    double probability(size_t index, const std::function<double(const dvec3&)>& pdf,
                       double tolerance) const
    {
        const size_t ring = index / SECTORS;
        constexpr int PIECES = 4;
        const double width = 2 * pi / SECTORS / PIECES;
        const double phi = 2 * pi * static_cast<double>(index % SECTORS) / SECTORS;
        auto density = [&](double theta, double around) {
            return pdf(directionOf(theta, around)) * std::sin(theta);
        };
        double sum = 0, from = border[ring];
        while (from < border[ring + 1]) {
            const double length = std::clamp(from, 1e-5, 0.05);
            const double end = std::min(from + length, border[ring + 1]);
            for (int i = 0; i < PIECES; i++) {
                sum += integrate(density, from, end, phi + i * width, phi + (i + 1) * width,
                                 tolerance / PIECES);
            }
            from = end;
        }
        return sum;
    }
};

/// The test of one material from one direction.
class BsdfHistogram {
public:
    /// The density that counts are compared with is that of `claimed`.
    BsdfHistogram(const BsdfCase& c, const Material& claimed)
        : case_(c),
          claimed_(claimed),
          isect_(surfaceOf(c)),
          wo_(viewerOf(c, isect_)),
          cells_{Cells(mirrored()), Cells(straight())}
    {
    }
    explicit BsdfHistogram(const BsdfCase& c) : BsdfHistogram(c, c.material) {}

    ChiSquared test(size_t samples)
    {
        divideCells();
        std::vector<double> found = counts(samples, 2), expected;
        const double count = static_cast<double>(samples);
        double rest = 1;  // mirror directions, and paths that end
        for (size_t side = 0; side < 2; side++) {
            for (size_t i = 0; i < cells_[side].count(); i++) {
                const double p = cells_[side].probability(
                    i, [&](const dvec3& wi) { return pdf(wi, side); }, 0.02 / count);
                expected.push_back(p * count);
                rest -= p;
            }
        }
        EXPECT_GT(rest, -1e-4) << case_.name << ": the density integrates to " << 1 - rest;
        expected.push_back(std::max(0.0, rest) * count);
        return chiSquaredTest(expected, found);
    }

private:
    vec3 mirrored() { return kernel_.reflected(-wo_, isect_.ns); }

    /// Where smooth glass would refract wo to, or straight on.
    vec3 straight()
    {
        if (case_.material.type != MATERIAL_ROUGH_DIELECTRIC) return -wo_;
        const float eta = case_.front ? case_.material.eta : 1 / case_.material.eta;
        const float cosI = kernel_.dot3(wo_, isect_.ns);
        float cosT;
        kernel_.fresnelDielectric(cosI, eta, cosT);
        if (!(cosT > 0)) return -isect_.ns;
        return kernel_.refracted(-wo_, isect_.ns, cosI, cosT, eta);
    }

    size_t sideOf(const dvec3& wi) const { return glm::dot(wi, dvec3(isect_.ns)) > 0 ? 0 : 1; }

    double pdf(const dvec3& wi, size_t side)
    {
        if (sideOf(wi) != side) return 0;
        return double{kernel_.pdfBsdf(claimed_, isect_, wo_, vec3(wi))};
    }

    template <class Take>
    void draw(size_t samples, uint64_t seed, Take take)
    {
        Random random(seed);
        for (size_t i = 0; i < samples; i++) {
            const BsdfSample bs =
                kernel_.sampleBsdf(case_.material, isect_, -wo_, 1, fourNumbers(random));
            take(bs, bs.lobe != Kernel::LOBE_NONE && !kernel_.isDeltaLobe(bs.lobe));
        }
    }

    void divideCells()
    {
        std::array<std::vector<double>, 2> angles;
        draw(6000, 1, [&](const BsdfSample& bs, bool finite) {
            if (!finite) return;
            const size_t side = sideOf(dvec3(bs.wi));
            angles[side].push_back(cells_[side].anglesOf(glm::normalize(dvec3(bs.wi))).x);
        });
        for (size_t side = 0; side < 2; side++) cells_[side].divide(angles[side]);
    }

    std::vector<double> counts(size_t samples, uint64_t seed)
    {
        const size_t above = cells_[0].count();
        std::vector<double> found(above + cells_[1].count() + 1);
        draw(samples, seed, [&](const BsdfSample& bs, bool finite) {
            if (!finite) {
                found.back()++;
                return;
            }
            const dvec3 wi = glm::normalize(dvec3(bs.wi));
            const size_t side = sideOf(wi);
            found[(side == 0 ? 0 : above) + cells_[side].indexOf(wi)]++;
        });
        return found;
    }

    const BsdfCase& case_;
    const Material& claimed_;
    Kernel kernel_;
    SurfaceInteraction isect_;
    vec3 wo_;
    std::array<Cells, 2> cells_;
};

void expectSamplesFollowTheDensity(const std::vector<BsdfCase>& cases, size_t samples)
{
    const double level = sidakLevel(FAMILY_LEVEL, cases.size());
    double least = 1;
    for (const BsdfCase& c : cases) {
        const ChiSquared test = BsdfHistogram(c).test(samples);
        EXPECT_GT(test.p, level) << c.name << ": chi-squared " << test.value << " of "
                                 << test.degrees << " degrees";
        EXPECT_GT(test.degrees, 8) << c.name;
        least = std::min(least, test.p);
    }
    std::printf("%zu cases, least p %.4g, level %.4g\n", cases.size(), least, level);
}

std::vector<BsdfCase> lambertAndReport()
{
    Material report = roughMaterial(MATERIAL_REPORT, 0);
    report.diffuseWeight = 0.6f;
    report.specularWeight = 0.3f;
    const Material lambert = roughMaterial(MATERIAL_LAMBERT, 0);
    return {{"lambert", lambert, true, 30}, {"report", report, true, 60}};
}

/// Shading normals that lean away from the geometric ones, so that part of a lobe is cut off.
std::vector<BsdfCase> leaningCases(double alpha)
{
    std::vector<BsdfCase> cases;
    for (const NamedMaterial& m : finiteMaterials(alpha)) {
        cases.push_back({m.name + " with a leaning normal", m.material, m.front, 50, 25});
    }
    return cases;
}

void append(std::vector<BsdfCase>& all, const std::vector<BsdfCase>& more)
{
    all.insert(all.end(), more.begin(), more.end());
}

TEST(BsdfChiSquared, samplesFollowTheDensity)
{
    std::vector<BsdfCase> cases = bsdfCases({1e-3, 0.25}, {0, 60, 85});
    append(cases, lambertAndReport());
    append(cases, leaningCases(0.25));
    expectSamplesFollowTheDensity(cases, 100'000);
}

TEST(LongBsdfChiSquared, samplesFollowTheDensityForAMillionSamples)
{
    std::vector<BsdfCase> cases = bsdfCases({1e-6, 1e-3, 1e-2, 0.1, 0.5, 1}, {0, 30, 60, 85});
    append(cases, lambertAndReport());
    append(cases, leaningCases(0.01));
    append(cases, leaningCases(0.5));
    expectSamplesFollowTheDensity(cases, 1'000'000);
}

TEST(BsdfChiSquared, seesALobeThatIsWiderByAFifth)
{
    for (const NamedMaterial& m : finiteMaterials(0.1)) {
        const BsdfCase right = {m.name, m.material, m.front, 30};
        Material wider = m.material;
        wider.roughness *= std::sqrt(1.2f);
        EXPECT_LT(BsdfHistogram(right, wider).test(100'000).p, 1e-4) << m.name;
    }
}

}  // namespace
}  // namespace sahl::testing
