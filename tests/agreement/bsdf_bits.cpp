// Every BSDF sampled and evaluated on the device and in C++: the same bits. So what is shown of
// samples and densities on the CPU (tests/statistical/bsdf_*.cpp) holds on the device.

#include "agreement/agreement_spirv.h"
#include "agreement/bsdf_query.h"
#include "device/exact_math.h"
#include "shared/bindings.h"
#include "shared/features.h"
#include "support/bsdf_cases.h"
#include "support/device_test.h"
#include "vulkan/fold_constants.h"
#include "vulkan/run_compute.h"

namespace sahl::testing {
namespace {

class BsdfBits : public DeviceTest {};

std::vector<Material> allMaterials()
{
    std::vector<Material> all;
    for (uint type = MATERIAL_LAMBERT; type <= MATERIAL_METALLIC_ROUGHNESS; type++) {
        for (double alpha : {0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.4, 1.0}) {
            Material m = roughMaterial(type, alpha);
            m.diffuseWeight = 0.5f;
            m.specularWeight = 0.4f;
            all.push_back(m);
            if (type == MATERIAL_METALLIC_ROUGHNESS) {
                all.push_back(thinWall(alpha, 0.2f, 0.6f));
                all.push_back(thinWall(alpha, 0.9f, 0));
            }
        }
    }
    return all;
}

/// Some 50,000 of them. Half ask about a direction that the material sends light to.
std::vector<BsdfQuery> makeQueries()
{
    Kernel kernel;
    Random random(1);
    std::vector<BsdfQuery> queries;
    for (const Material& material : allMaterials()) {
        for (int i = 0; i < 512; i++) {
            BsdfCase c;
            c.front = i % 2 == 0;
            c.tilt = i % 4 == 3 ? 30 : 0;
            const SurfaceInteraction isect = surfaceOf(c);
            BsdfQuery q = {};
            q.material = material;
            if (i % 16 == 5) q.material.eta = random.uniform(0.5f, 2.5f);
            q.ng = isect.ng;
            q.ns = isect.ns;
            q.front = c.front ? 1 : 0;
            q.mediumEta = i % 32 < 16 ? 1 : 1.5f;
            const double degrees = i % 8 == 7 ? 89.999 : double{random.uniform(0, 90)};
            q.dir = -directionAt(isect.ns, degrees, double{random.uniform()});
            if (!(kernel.dot3(q.dir, q.ng) < 0)) q.dir = -isect.ng;
            q.u = fourNumbers(random);
            q.wi = random.direction();
            if (i % 2 == 0) {
                const BsdfSample bs =
                    kernel.sampleBsdf(q.material, isect, q.dir, 1, fourNumbers(random));
                if (bs.lobe != Kernel::LOBE_NONE) q.wi = bs.wi;
            }
            queries.push_back(q);
        }
    }
    return queries;
}

BsdfAnswer answerOf(Kernel& kernel, const BsdfQuery& q)
{
    SurfaceInteraction isect = {};
    isect.pError = 1e-6f;
    isect.ng = q.ng;
    isect.ns = q.ns;
    isect.nsStored = q.front != 0 ? q.ns : -q.ns;
    isect.front = q.front != 0;
    const BsdfSample bs = kernel.sampleBsdf(q.material, isect, q.dir, q.mediumEta, q.u);
    BsdfAnswer a = {};
    a.wi = bs.wi;
    a.lobe = bs.lobe;
    a.weight = bs.weight;
    a.pdf = bs.pdf;
    a.f = kernel.evalBsdfCos(q.material, isect, -q.dir, q.wi);
    a.pdfAtWi = kernel.pdfBsdf(q.material, isect, -q.dir, q.wi);
    a.mediumEta = bs.mediumEta;
    a.etaScale = bs.etaScale;
    return a;
}

bool isFine(Kernel& kernel, const vec3& v)
{
    return kernel.isFiniteNumber(v.x) && kernel.isFiniteNumber(v.y) && kernel.isFiniteNumber(v.z);
}

TEST_F(BsdfBits, areThoseOfCpp)
{
    std::vector<BsdfQuery> queries = makeQueries();
    std::vector<BsdfAnswer> answers(queries.size());
    auto context = openFirstContext();
    ComputeParameters parameters;
    parameters.name = "bsdf_probe";
    parameters.groups = {static_cast<uint32_t>((queries.size() + 63) / 64), 1, 1};
    std::vector<uint32_t> constants(SPEC_COUNT);
    constants[SPEC_STACK_SIZE] = MAX_STACK_SIZE;
    constants[SPEC_FEATURES] = FEATURES_ALL;
    constants[SPEC_MATH] = chooseMath(*context, DeviceOptions::Math::automatic);
    // Folded as the kernels are: SwiftShader's compiler does not survive all ways to divide at once
    runCompute(
        *context, foldedConstants(testSpirv("bsdf_probe"), constants),
        {std::as_writable_bytes(std::span(queries)), std::as_writable_bytes(std::span(answers))},
        parameters);
    Kernel kernel;
    size_t different = 0, evaluated = 0;
    std::array<size_t, 6> lobes = {};
    for (size_t i = 0; i < queries.size(); i++) {
        const BsdfAnswer expected = answerOf(kernel, queries[i]);
        if (std::memcmp(&expected, &answers[i], sizeof(expected)) != 0) {
            if (different++ == 0) {
                ADD_FAILURE() << "query " << i << ", type " << queries[i].material.type << ", lobe "
                              << expected.lobe << " and " << answers[i].lobe;
            }
        }
        EXPECT_TRUE(isFine(kernel, expected.weight) && isFine(kernel, expected.f) &&
                    isFine(kernel, {expected.pdf, expected.pdfAtWi, expected.etaScale}))
            << "query " << i << ", type " << queries[i].material.type;
        lobes.at(expected.lobe)++;
        evaluated += expected.pdfAtWi > 0 ? 1 : 0;
    }
    EXPECT_EQ(different, 0u) << "of " << queries.size();
    EXPECT_GT(evaluated, queries.size() / 4);
    for (size_t count : lobes) EXPECT_GT(count, 500u);
}

}  // namespace
}  // namespace sahl::testing
