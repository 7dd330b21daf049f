// What BSDFs do with light: no more leaves than arrives, it may go either way, and rough surfaces lose
// what the theory of single scattering says.

#include "oracle/microfacet_albedo.h"
#include "support/bsdf_cases.h"

#include <gtest/gtest.h>

#include <complex>
#include <vector>

namespace sahl::testing {
namespace {

/// Mean and standard error of one channel.
struct Albedo {
    glm::dvec3 mean, error;
};

/// Mean weight of the samples. Radiance that was compressed into a denser medium is expanded again.
Albedo albedoOf(const BsdfCase& c, int samples, uint64_t seed)
{
    Kernel kernel;
    const SurfaceInteraction isect = surfaceOf(c);
    const vec3 wo = viewerOf(c, isect);
    Random random(seed);
    glm::dvec3 sum(0), squares(0);
    for (int i = 0; i < samples; i++) {
        const BsdfSample bs = kernel.sampleBsdf(c.material, isect, -wo, 1, fourNumbers(random));
        if (bs.lobe == Kernel::LOBE_NONE) continue;
        const glm::dvec3 weight = glm::dvec3(bs.weight) * double{bs.etaScale};
        sum += weight;
        squares += weight * weight;
    }
    const glm::dvec3 mean = sum / double(samples);
    return {mean, glm::sqrt(glm::max(squares / double(samples) - mean * mean, glm::dvec3(0)) /
                            double(samples))};
}

Material white(Material m)
{
    m.baseColor = vec3(1);
    m.conductorEta = vec3(0);  // without absorption: reflects everything
    m.conductorK = vec3(1);
    return m;
}

constexpr int SAMPLES = 8'000;

TEST(BsdfEnergy, isNeverMade)
{
    int cases = 0;
    for (double alpha : {1e-6, 1e-3, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0}) {
        for (const NamedMaterial& m : finiteMaterials(alpha)) {
            for (double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9}) {
                for (double tilt : {0.0, 20.0}) {
                    const BsdfCase c = {m.name, white(m.material), m.front, degrees, tilt};
                    const Albedo albedo = albedoOf(c, SAMPLES, ++cases);
                    for (int k = 0; k < 3; k++) {
                        ASSERT_LT(albedo.mean[k], 1 + 5 * albedo.error[k] + 1e-5)
                            << m.name << ", alpha " << alpha << ", " << degrees << " degrees";
                    }
                }
            }
        }
    }
    EXPECT_GT(cases, 600);
}

/// Whites that keep their energy but for the margin of the coat's fit.
TEST(BsdfEnergy, isKeptByWhitePlasticAndPaintUnderASmoothCoat)
{
    for (double degrees : {0.0, 45.0, 75.0, 85.0}) {
        for (const char* name : {"plastic", "paint", "thinWall"}) {
            for (const NamedMaterial& m : finiteMaterials(1e-6)) {
                if (m.name != name) continue;
                const Albedo albedo = albedoOf({name, white(m.material), true, degrees}, 100'000, 7);
                EXPECT_NEAR(albedo.mean.x, 1, 4 * albedo.error.x + 1e-5) << name << degrees;
            }
        }
    }
}

/// By how much the coat's albedo is overestimated.
struct Overestimate {
    double mean = 0, most = 0;
};

/// Looks at all combinations; nowhere may the albedo be underestimated.
Overestimate overestimateOfCoats(const std::vector<double>& roughnesses,
                                 const std::vector<float>& etas, const std::vector<double>& cosines)
{
    Kernel kernel;
    Overestimate found;
    for (double roughness : roughnesses) {
        const double alpha = roughness * roughness;
        for (float eta : etas) {
            Material m = roughMaterial(MATERIAL_PLASTIC, alpha);
            m.eta = eta;
            for (double cosine : cosines) {
                auto fresnel = [&](double c) {
                    float cosT;
                    return double{kernel.fresnelDielectric(float(c), eta, cosT)};
                };
                const double exact = textbook::microfacetAlbedo(cosine, alpha, fresnel);
                const double over =
                    double{kernel.plasticCoat(m, static_cast<float>(cosine))} - exact;
                EXPECT_GT(over, -1e-5) << roughness << " " << eta << " " << cosine;
                found.most = std::max(found.most, over);
                found.mean += over;
            }
        }
    }
    found.mean /= double(roughnesses.size() * etas.size() * cosines.size());
    std::printf("the coat's albedo is overestimated by %.4f on average, %.4f at most\n", found.mean,
                found.most);
    return found;
}

TEST(BsdfEnergy, ofTheCoatIsBoundedFromAboveByTwoPercentOnAverage)
{
    const Overestimate found = overestimateOfCoats({0.02, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0},
                                                   {1.2f, 1.5f, 2.0f}, {0.02, 0.1, 0.3, 0.6, 1.0});
    EXPECT_LT(found.mean, 0.025);
    EXPECT_LT(found.most, 0.125);
}

TEST(BsdfEnergy, ofTheCoatIsBoundedFromAboveWhereverItWasNotFitted)
{
    const Overestimate found =
        overestimateOfCoats({0.05, 0.15, 0.25, 0.4}, {1.1f, 1.2f, 1.5f, 2.0f},
                            {0.02, 0.05, 0.1, 0.2, 0.5, 0.7, 0.8, 0.9, 0.95});
    EXPECT_LT(found.most, 0.19);
}

/// The margin that makes sure of the bound must not darken what lies under a nearly smooth coat.
TEST(BsdfEnergy, ofANearlySmoothCoatIsKnownWell)
{
    const Overestimate found =
        overestimateOfCoats({0.02, 0.05, 0.1}, {1.1f, 1.5f, 2.0f}, {0.3, 0.5, 0.6, 0.9, 1.0});
    EXPECT_LT(found.most, 0.0015);
}

/// Rough metal without absorption in white light: what is missing met more than one microfacet.
TEST(WhiteFurnace, losesWhatSingleScatteringLoses)
{
    double worst = 0;
    for (double alpha : {1e-3, 0.01, 0.1, 0.25, 0.5, 1.0}) {
        for (double degrees : {0.0, 30.0, 60.0, 85.0}) {
            const BsdfCase c = {"white metal",
                                white(roughMaterial(MATERIAL_ROUGH_CONDUCTOR, alpha)), true,
                                degrees};
            const double cosine = std::cos(degrees * std::numbers::pi / 180);
            const double exact = textbook::microfacetAlbedo(cosine, alpha, [](double) { return 1.0; });
            const Albedo albedo = albedoOf(c, 200'000, 11);
            const double z = (albedo.mean.x - exact) / (albedo.error.x + 2e-5);
            worst = std::max(worst, std::abs(z));
            EXPECT_LT(std::abs(z), 4.5) << alpha << " " << degrees << ": " << albedo.mean.x
                                        << " instead of " << exact;
        }
    }
    std::printf("24 cases, largest |z| %.2f\n", worst);
}

TEST(WhiteFurnace, ofGoldLosesWhatItsFresnelAbsorbsToo)
{
    auto reflectance = [](std::complex<double> index, double cosI) {
        const std::complex<double> root = std::sqrt(index * index - (1 - cosI * cosI));
        const double s = std::norm((cosI - root) / (cosI + root));
        const double p =
            std::norm((index * index * cosI - root) / (index * index * cosI + root));
        return (s + p) / 2;
    };
    const Material gold = roughMaterial(MATERIAL_ROUGH_CONDUCTOR, 0.3);
    const Albedo albedo = albedoOf({"gold", gold, true, 60}, 200'000, 12);
    for (int k = 0; k < 3; k++) {
        const std::complex<double> index(double{gold.conductorEta[k]}, double{gold.conductorK[k]});
        const double exact = textbook::microfacetAlbedo(
            0.5, double{gold.roughness} * double{gold.roughness},
            [&](double cosI) { return reflectance(index, cosI); });
        EXPECT_NEAR(albedo.mean[k], exact, 4 * albedo.error[k] + 1e-5);
    }
}

/// BSDF without the cosine.
glm::dvec3 bsdfOf(Kernel& kernel, const Material& m, const SurfaceInteraction& isect, vec3 wo,
                  vec3 wi)
{
    const glm::dvec3 f(kernel.evalBsdfCos(m, isect, wo, wi));
    return f / std::abs(glm::dot(glm::dvec3(wi), glm::dvec3(isect.ns)));
}

/// The same surface, seen from the other side.
SurfaceInteraction turned(SurfaceInteraction isect)
{
    isect.ng = -isect.ng;
    isect.ns = -isect.ns;
    isect.front = !isect.front;
    return isect;
}

/// f(wo, wi) = f(wi, wo); through a surface f(wo, wi) n_o^2 = f(wi, wo) n_i^2.
TEST(BsdfReciprocity, holdsForEveryMaterial)
{
    Kernel kernel;
    Random random(5);
    int compared = 0, through = 0;
    for (double alpha : {1e-6, 0.01, 0.1, 0.5, 1.0}) {
        for (const NamedMaterial& m : finiteMaterials(alpha)) {
            const BsdfCase c = {m.name, m.material, m.front};
            for (int i = 0; i < 2000; i++) {
                const SurfaceInteraction isect = surfaceOf(c);
                const vec3 wo = directionAt(isect.ns, double{random.uniform(0, 89)},
                                            double{random.uniform()});
                // From the lobes, else narrow ones are never met.
                const BsdfSample bs =
                    kernel.sampleBsdf(m.material, isect, -wo, 1, fourNumbers(random));
                if (bs.lobe == Kernel::LOBE_NONE || kernel.isDeltaLobe(bs.lobe)) continue;
                const bool passes = bs.lobe == Kernel::LOBE_GLOSSY_TRANSMIT;
                const SurfaceInteraction other = passes ? turned(isect) : isect;
                glm::dvec3 there = bsdfOf(kernel, m.material, isect, wo, bs.wi);
                const glm::dvec3 back = bsdfOf(kernel, m.material, other, bs.wi, wo);
                there *= double{bs.etaScale};
                // Half vectors are off by 2^-23 or so, the narrowest lobes vary over alpha.
                const double tolerance = 5e-4 + 1e-5 / std::max(alpha, 1e-3);
                for (int k = 0; k < 3; k++) {
                    ASSERT_NEAR(there[k] / back[k], 1, tolerance) << m.name << " " << alpha;
                }
                compared++;
                through += passes ? 1 : 0;
            }
        }
    }
    EXPECT_GT(compared, 20'000);
    EXPECT_GT(through, 3'000);
}

TEST(BsdfSampling, givesTheBsdfOverTheDensityAsWeight)
{
    Kernel kernel;
    Random random(6);
    int compared = 0;
    for (const BsdfCase& c : bsdfCases({1e-6, 1e-4, 1e-3, 0.1, 1}, {0, 45, 85, 89.9})) {
        const SurfaceInteraction isect = surfaceOf(c);
        const vec3 wo = viewerOf(c, isect);
        for (int i = 0; i < 500; i++) {
            const BsdfSample bs = kernel.sampleBsdf(c.material, isect, -wo, 1, fourNumbers(random));
            if (bs.lobe == Kernel::LOBE_NONE || kernel.isDeltaLobe(bs.lobe)) {
                EXPECT_EQ(bs.pdf, 0.0f);
                continue;
            }
            EXPECT_EQ(bs.pdf, kernel.pdfBsdf(c.material, isect, wo, bs.wi)) << c.name;
            const vec3 f = kernel.evalBsdfCos(c.material, isect, wo, bs.wi);
            for (int k = 0; k < 3; k++) {
                ASSERT_TRUE(kernel.isFiniteNumber(bs.weight[k]));
                ASSERT_NEAR(bs.weight[k] * bs.pdf, f[k], 1e-6f * f[k]) << c.name;
            }
            compared++;
        }
    }
    EXPECT_GT(compared, 20'000);
}

TEST(BsdfSampling, leavesNothingUnderTheSurface)
{
    Kernel kernel;
    Random random(8);
    for (double alpha : {1e-6, 0.1, 1.0}) {
        for (const NamedMaterial& m : finiteMaterials(alpha)) {
            const BsdfCase c = {m.name, m.material, m.front, 70, 35};
            const SurfaceInteraction isect = surfaceOf(c);
            const vec3 wo = viewerOf(c, isect);
            for (int i = 0; i < 2000; i++) {
                const BsdfSample bs =
                    kernel.sampleBsdf(m.material, isect, -wo, 1, fourNumbers(random));
                if (bs.lobe == Kernel::LOBE_NONE) continue;
                const bool through = bs.lobe == Kernel::LOBE_TRANSMIT ||
                                     bs.lobe == Kernel::LOBE_GLOSSY_TRANSMIT;
                EXPECT_EQ(kernel.dot3(bs.wi, isect.ng) < 0, through) << m.name;
            }
            // Light that comes from between the two horizons reaches neither side.
            for (int i = 0; i < 2000; i++) {
                const vec3 wi = random.direction();
                const bool above = kernel.dot3(wi, isect.ng) > 0;
                if (above == (kernel.dot3(wi, isect.ns) > 0)) continue;
                EXPECT_EQ(kernel.evalBsdfCos(m.material, isect, wo, wi), vec3(0)) << m.name;
                EXPECT_EQ(kernel.pdfBsdf(m.material, isect, wo, wi), 0.0f) << m.name;
            }
        }
    }
}

}  // namespace
}  // namespace sahl::testing
