#include "oracle/from_scene.h"

#include "oracle/textbook_rough.h"

#include <stdexcept>
#include <utility>

namespace sahl::testing {

namespace {

textbook::Vec vecOf(const vec3& v)
{
    return {v.x, v.y, v.z};
}

textbook::Material materialOf(const Material& material)
{
    textbook::Material out;
    switch (material.type) {
    case MATERIAL_LAMBERT:
        out.kind = textbook::Material::lambert;
        break;
    case MATERIAL_MIRROR:
        out.kind = textbook::Material::mirror;
        break;
    case MATERIAL_DIELECTRIC:
        out.kind = textbook::Material::dielectric;
        break;
    case MATERIAL_CONDUCTOR:
        out.kind = textbook::Material::conductor;
        break;
    case MATERIAL_REPORT:
        out.kind = textbook::Material::report;
        break;
    case MATERIAL_ROUGH_CONDUCTOR:
        out.kind = textbook::Material::roughConductor;
        break;
    case MATERIAL_ROUGH_DIELECTRIC:
        out.kind = textbook::Material::roughDielectric;
        break;
    case MATERIAL_THIN_DIELECTRIC:
        out.kind = textbook::Material::thinPane;
        break;
    case MATERIAL_PLASTIC:
        out.kind = textbook::Material::plastic;
        break;
    case MATERIAL_METALLIC_ROUGHNESS:
        out.kind = textbook::Material::metallicRoughness;
        out.transmission = material.transmission;
        break;
    default:
        throw std::logic_error("a material that the textbook tracer does not know");
    }
    out.baseColor = vecOf(material.baseColor);
    out.emission = vecOf(material.emission);
    out.eta = material.eta;
    out.conductorEta = vecOf(material.conductorEta);
    out.conductorK = vecOf(material.conductorK);
    out.diffuseWeight = material.diffuseWeight;
    out.specularWeight = material.specularWeight;
    out.alpha = double{material.roughness} * double{material.roughness};
    out.metallic = material.metallic;
    const bool coated = out.kind == textbook::Material::plastic ||
                        out.kind == textbook::Material::metallicRoughness;
    if (coated) textbook::finishMaterial(out);
    return out;
}

textbook::Light lightOf(const Light& light)
{
    textbook::Light out;
    switch (light.type) {
    case LIGHT_POINT:
        out.kind = textbook::Light::point;
        break;
    case LIGHT_SPOT:
        out.kind = textbook::Light::spot;
        break;
    case LIGHT_DIRECTIONAL:
        out.kind = textbook::Light::directional;
        break;
    default:
        throw std::logic_error("a light that the textbook tracer does not know");
    }
    out.position = vecOf(light.position);
    out.direction = vecOf(light.direction);
    out.strength = vecOf(light.intensity);
    out.cosOuter = light.cosOuter;
    out.cosInner = light.cosInner;
    return out;
}

textbook::Probe probeOf(const Probe& probe, const std::vector<vec4>& texels)
{
    textbook::Probe out;
    out.width = static_cast<int>(probe.width);
    out.height = static_cast<int>(probe.height);
    out.angular = probe.mapping == PROBE_ANGULAR;
    out.bilinear = probe.filterMode == FILTER_BILINEAR;
    out.axis[0] = vecOf(probe.axisX);
    out.axis[1] = vecOf(probe.axisY);
    out.axis[2] = vecOf(probe.axisZ);
    for (size_t i = 0; i < size_t{probe.width} * probe.height; i++) {
        out.texels.push_back(vecOf(vec3(texels.at(probe.firstTexel + i))));
    }
    return out;
}

textbook::Camera cameraOf(const Camera& camera)
{
    textbook::Camera out;
    const double halfWidth = glm::length(glm::dvec3(camera.right));
    const double halfHeight = glm::length(glm::dvec3(camera.down));
    out.orthographic = camera.type == CAMERA_ORTHOGRAPHIC;
    out.eye = vecOf(camera.position);
    out.forward = vecOf(camera.forward);
    const glm::dvec3 right = glm::dvec3(camera.right) / halfWidth;
    const glm::dvec3 down = glm::dvec3(camera.down) / halfHeight;
    out.right = {right.x, right.y, right.z};
    out.down = {down.x, down.y, down.z};
    out.halfWidth = halfWidth;
    out.halfHeight = halfHeight;
    out.lensRadius = glm::length(glm::dvec3(camera.lensRight));
    out.focusDistance = camera.focusDistance;
    return out;
}

void addPrimitive(textbook::World& world, const Primitive& primitive,
                  const std::vector<TriangleCorners>& normals)
{
    if (primitive.shape == SHAPE_SPHERE) {
        world.spheres.push_back({vecOf(primitive.p0), primitive.p1.x, primitive.material});
        return;
    }
    textbook::Triangle triangle;
    triangle.corner[0] = vecOf(primitive.p0);
    triangle.corner[1] = vecOf(primitive.p1);
    triangle.corner[2] = vecOf(primitive.p2);
    triangle.material = primitive.material;
    triangle.smooth = primitive.shape != SHAPE_FLAT;
    if (triangle.smooth) {
        const TriangleCorners& n = normals.at(primitive.shape);
        triangle.normal[0] = vecOf(n.n0);
        triangle.normal[1] = vecOf(n.n1);
        triangle.normal[2] = vecOf(n.n2);
    }
    world.triangles.push_back(triangle);
}

textbook::Vec placed(const Placement& placement, const textbook::Vec& q)
{
    const glm::dvec3 p = placement.linear * glm::dvec3(q.x, q.y, q.z) + placement.translation;
    return {p.x, p.y, p.z};
}

textbook::Vec placedNormal(const Placement& placement, const textbook::Vec& n)
{
    const glm::dmat3 map = glm::transpose(glm::inverse(placement.linear));
    const glm::dvec3 m = glm::normalize(map * glm::dvec3(n.x, n.y, n.z));
    return {m.x, m.y, m.z};
}

/// Every primitive of the object as it stands in the world, in double precision.
void addInstance(textbook::World& world, const Placement& placement, const Scene& scene)
{
    textbook::World object;
    for (const Primitive& primitive : scene.objects.at(placement.object)) {
        addPrimitive(object, primitive, scene.triangleCorners);
    }
    const bool repainted = placement.material != NO_MATERIAL;
    const bool mirrors = glm::determinant(placement.linear) < 0;
    for (textbook::Triangle triangle : object.triangles) {
        for (textbook::Vec& corner : triangle.corner) corner = placed(placement, corner);
        if (triangle.smooth) {
            for (textbook::Vec& normal : triangle.normal) normal = placedNormal(placement, normal);
        }
        if (mirrors) {
            std::swap(triangle.corner[1], triangle.corner[2]);
            std::swap(triangle.normal[1], triangle.normal[2]);
        }
        if (repainted) triangle.material = placement.material;
        world.triangles.push_back(triangle);
    }
    for (textbook::Sphere sphere : object.spheres) {
        if (repainted) sphere.material = placement.material;
        const glm::dmat3& m = placement.linear;
        world.placedSpheres.push_back({sphere,
                                       {m[0].x, m[0].y, m[0].z},
                                       {m[1].x, m[1].y, m[1].z},
                                       {m[2].x, m[2].y, m[2].z},
                                       placed(placement, {})});
    }
}

}  // namespace

textbook::World textbookWorld(const Scene& scene)
{
    textbook::World world;
    for (const Primitive& primitive : scene.primitives) {
        addPrimitive(world, primitive, scene.triangleCorners);
    }
    for (const Placement& placement : scene.instances) addInstance(world, placement, scene);
    for (const Material& material : scene.materials)
        world.materials.push_back(materialOf(material));
    for (const Light& light : scene.lights) world.lights.push_back(lightOf(light));
    world.environment = probeOf(scene.probe, scene.probeTexels);
    world.background = probeOf(scene.background.value_or(scene.probe), scene.probeTexels);
    world.camera = cameraOf(scene.camera);
    world.width = static_cast<int>(scene.settings.width);
    world.height = static_cast<int>(scene.settings.height);
    world.bounces = static_cast<int>(scene.settings.maxBounces);
    return world;
}

textbook::PhongWorld textbookPhong(const Scene& scene)
{
    textbook::PhongWorld phong;
    phong.world = textbookWorld(scene);
    for (const Material& material : scene.materials) {
        const double share = material.type == MATERIAL_LAMBERT  ? 1
                             : material.type == MATERIAL_REPORT ? double{material.diffuseWeight}
                                                                : 0;
        const textbook::Vec base = vecOf(material.baseColor);
        phong.materials.push_back({vecOf(material.emission),
                                   vecOf(material.ambientColor),
                                   {base.x * share, base.y * share, base.z * share},
                                   vecOf(material.specularColor),
                                   material.shininess});
    }
    phong.ambient = vecOf(scene.settings.ambient);
    phong.ambientTerm = (scene.settings.shading & SHADING_AMBIENT) != 0;
    phong.diffuseTerm = (scene.settings.shading & SHADING_DIFFUSE) != 0;
    phong.specularTerm = (scene.settings.shading & SHADING_SPECULAR) != 0;
    phong.shadows = (scene.settings.shading & SHADING_SHADOWS) != 0;
    phong.flat = (scene.settings.shading & SHADING_FLAT) != 0;
    return phong;
}

}  // namespace sahl::testing
