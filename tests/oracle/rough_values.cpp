// BSDFs of the rough and layered materials, value by value, against the textbook's.
#include "oracle/from_scene.h"
#include "oracle/textbook_rough.h"
#include "support/bsdf_cases.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

textbook::Vec vecOf(const vec3& v)
{
    return {v.x, v.y, v.z};
}

textbook::Material textbookOf(const Material& material)
{
    Scene scene = emptyScene(1, 1, 1);
    scene.materials.push_back(material);
    lookFrom(scene, {0, 0, 1}, {0, 0, 0}, 30);
    return textbookWorld(scene).materials.at(0);
}

TEST(RoughValues, areThoseOfTheTextbook)
{
    Kernel kernel;
    Random random(1);
    size_t compared = 0;
    for (double alpha : {1e-6, 0.2, 0.6}) {
        for (const NamedMaterial& m : finiteMaterials(alpha)) {
            const BsdfCase c = {m.name, m.material, m.front, 50};
            const SurfaceInteraction isect = surfaceOf(c);
            const vec3 wo = viewerOf(c, isect);
            const textbook::Material book = textbookOf(m.material);
            const double here = m.front ? 1 : book.eta;
            const bool glass = m.material.type == MATERIAL_ROUGH_DIELECTRIC;
            const textbook::RoughSurface surface = {&book, vecOf(isect.ns), vecOf(wo),
                                                    glass ? here : 1,
                                                    glass ? book.eta / here : book.eta};
            for (int i = 0; i < 5000; i++) {
                const vec3 wi = random.direction();
                const textbook::Vec f = textbook::roughBsdf(surface, vecOf(wi));
                const double cosine =
                    std::abs(glm::dot(glm::dvec3(wi), glm::dvec3(isect.ns)));
                const double exact[3] = {f.x * cosine, f.y * cosine, f.z * cosine};
                const vec3 found = kernel.evalBsdfCos(m.material, isect, wo, wi);
                for (int k = 0; k < 3; k++) {
                    // Float's angles at the facet count most near the critical angle.
                    ASSERT_NEAR(found[k], exact[k], 1e-5 + (glass ? 1e-2 : 1e-3) * exact[k])
                        << m.name << ", alpha " << alpha;
                    compared += exact[k] > 1e-5 ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(compared, 50'000u);
}

}  // namespace
}  // namespace sahl::testing
