// How a material of a glTF file looks: the one place that decides which of Sahl's it becomes.
#include "scene/gltf_scene.h"
#include "scene/numbers.h"
#include "scene/phong.h"

namespace sahl {

uint32_t addGltfMaterial(Scene& scene, const GltfModel&, const GltfMaterial& material)
{
    Material result = {};
    result.baseColor = toFloat(material.baseColor);
    result.emission = toFloat(material.emission);
    result.eta = toFloat(material.eta);
    result.type = MATERIAL_LAMBERT;
    if (material.transmission > 0.5) result.type = MATERIAL_DIELECTRIC;
    if (material.metallic > 0.5 && material.roughness < 0.5) result.type = MATERIAL_MIRROR;
    setPhongDefaults(result);
    return addMaterial(scene, material.name, result);
}

}  // namespace sahl
