#include "device/scene_features.h"

#include "shared/features.h"

namespace sahl {

namespace {

uint32_t featureIf(bool has, uint32_t feature)
{
    return has ? feature : 0;
}

uint32_t featuresOf(const Material& material)
{
    // Rough ones of a small roughness act as smooth ones.
    bool smooth = material.type > MATERIAL_LAMBERT && material.type <= MATERIAL_ROUGH_DIELECTRIC;
    return featureIf(smooth, FEATURE_SMOOTH) |
           featureIf(material.type >= MATERIAL_ROUGH_CONDUCTOR, FEATURE_GLOSSY) |
           featureIf(material.alphaCutoff > 0, FEATURE_CUTOUTS);
}

uint32_t featuresOf(const Probe& probe)
{
    if (probe.height == 0) return 0;
    return (probe.mapping == PROBE_ANGULAR ? FEATURE_ANGULAR : FEATURE_LATLONG) |
           featureIf(probe.width > 1 || probe.height > 1, FEATURE_MANY_TEXELS);
}

uint32_t featuresOf(const Frame& frame)
{
    return featureIf(frame.integrator == INTEGRATOR_PHONG, FEATURE_PHONG) |
           featureIf(frame.integrator != INTEGRATOR_PHONG, FEATURE_PATHS) |
           featureIf(frame.samplerKind == SAMPLER_INDEPENDENT, FEATURE_INDEPENDENT) |
           featureIf(frame.samplerKind == SAMPLER_SOBOL, FEATURE_SOBOL) |
           featureIf(frame.samplerKind == SAMPLER_SOBOL64, FEATURE_SOBOL64) |
           featureIf(frame.probeMean > 0, FEATURE_PROBE_LIGHT) | featuresOf(frame.probe) |
           featuresOf(frame.background);
}

}  // namespace

bool shines(const Material& material)
{
    return material.emission != vec3(0);
}

uint32_t featuresOf(const DeviceScene& scene)
{
    uint32_t features =
        featureIf(!scene.instances.empty(), FEATURE_INSTANCES) | featuresOf(scene.frame);
    for (const Material& material : scene.materials) {
        features |= featuresOf(material);
        features |=
            featureIf(shines(material) && scene.frame.lightPerPower > 0, FEATURE_SHAPE_LIGHTS);
    }
    features = scene.textures.empty() ? features & ~FEATURE_CUTOUTS : features | FEATURE_TEXTURES;
    for (const Light& light : scene.lights)
        features |= light.type < LIGHT_TRIANGLE ? FEATURE_FAR_LIGHTS : FEATURE_SHAPE_LIGHTS;
    for (const Primitive& primitive : scene.primitives)
        if (primitive.shape == SHAPE_SPHERE) return features | FEATURE_SPHERES;
    return features;
}

}  // namespace sahl
