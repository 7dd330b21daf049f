#include "render/outline.h"

#include "device/scene_features.h"
#include "scene/probe_weights.h"
#include "shared/features.h"

namespace sahl {

SceneOutline outlineOf(const Scene& scene)
{
    DeviceScene view;
    view.primitives = scene.primitives;
    view.materials = scene.materials;
    view.textures = scene.textures;
    view.lights = scene.lights;
    view.frame.probe = scene.probe;
    view.frame.background = scene.background.value_or(scene.probe);
    view.frame.integrator = scene.settings.integrator;
    view.frame.samplerKind = scene.settings.samplerKind;
    if (scene.settings.lightSampling != LIGHTS_BSDF_ONLY) {
        view.frame.lightPerPower = 1;
        view.frame.probeMean = scene.probe.height > 0 && !isConstant(scene.probe, scene.probeTexels) ? 1.0f : 0.0f;
    }
    const uint32_t instances = scene.instances.empty() ? 0 : FEATURE_INSTANCES;
    return {featuresOf(view) | instances, scene.primitives.size(), scene.triangleCorners.size()};
}

}  // namespace sahl
