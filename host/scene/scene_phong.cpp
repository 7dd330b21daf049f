// What scene files say about the phong integrator.
#include "scene/numbers.h"
#include "scene/phong.h"
#include "scene/scene_reading.h"

namespace sahl {

void readShading(const JsonObject& integrator, RenderSettings& settings)
{
    uint32_t shading = 0;
    for (size_t term : integrator.someOf("terms", {"ambient", "diffuse", "specular"})) {
        shading |= phongTerms()[term].bit;
    }
    if (integrator.boolean("shadows", false)) shading |= SHADING_SHADOWS;
    if (integrator.choice("normals", {"interpolated", "flat"}) == "flat") shading |= SHADING_FLAT;
    settings.shading = shading;
    settings.ambient =
        toFloat(integrator.vector("ambient", glm::dvec3(settings.ambient), LIGHT_RANGE));
}

void readPhongMaterial(const JsonObject& object, Material& material)
{
    constexpr Range SHARE = {0, 1};
    setPhongDefaults(material);
    material.specularColor =
        toFloat(object.vector("specularColor", glm::dvec3(material.specularColor), SHARE));
    material.shininess =
        toFloat(object.number("shininess", double{material.shininess}, {0, MAX_SHININESS}));
    material.ambientColor =
        toFloat(object.vector("ambientColor", glm::dvec3(material.ambientColor), SHARE));
}

}  // namespace sahl
