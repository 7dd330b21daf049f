#include "saved/check.h"

#include "bvh/box.h"
#include "saved/check_trees.h"
#include "saved/container.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sahl {

namespace {

constexpr float UNIT_TOLERANCE = 1e-3f;  ///< of squared lengths and cosines of rounded unit vectors

bool isFinite(float x)
{
    return (std::bit_cast<uint32_t>(x) & 0x7f800000u) != 0x7f800000u;
}

/// Whether all hold, without a branch for each: files have millions of numbers.
template <class... Conditions>
bool allOf(Conditions... conditions)
{
    return (int{conditions} & ...) != 0;
}

bool isFinite(const vec3& v)
{
    return allOf(isFinite(v.x), isFinite(v.y), isFinite(v.z));
}

bool isUnit(const vec3& v)
{
    return std::abs(v.x * v.x + v.y * v.y + v.z * v.z - 1) <= UNIT_TOLERANCE;
}

/// Finite and not negative.
bool isAmount(const vec3& v)
{
    return isFinite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

bool isShare(float x)
{
    return x >= 0 && x <= 1;
}

bool isSoundShape(const Primitive& primitive)
{
    if (primitive.shape != SHAPE_SPHERE) return true;
    const Box box = extentOf(primitive);
    return primitive.p1.x > 0 && isFinite(box.lo) && isFinite(box.hi);
}

/// Zero if all components are finite, else not a number: cheaper than to ask each of them.
float vanishing(const Primitive& p)
{
    const vec3 zero = (p.p0 - p.p0) + (p.p1 - p.p1) + (p.p2 - p.p2);
    return (zero.x + zero.y) + zero.z;
}

/// Whether the texels of the texture are among as many, behind the curve.
bool isWithin(const Texture& texture, uint64_t texels)
{
    constexpr uint MAX_SIDE = 1u << 15;
    const uint64_t end = texture.firstTexel + uint64_t{texture.width} * texture.height;
    return texture.firstTexel >= SRGB_TABLE_SIZE && texture.width >= 1 && texture.width <= MAX_SIDE &&
           texture.height >= 1 && texture.height <= MAX_SIDE && end <= texels;
}

bool isSound(const Texture& texture)
{
    constexpr uint KNOWN = TEXTURE_SRGB | TEXTURE_CLAMP_S | TEXTURE_CLAMP_T | TEXTURE_NEAREST;
    return (texture.flags & ~KNOWN) == 0 && isFinite(texture.rowS) && isFinite(texture.rowT) &&
           isFinite(texture.strength) && isAmount(texture.mean);
}

void checkTextures(const std::string& file, const DeviceScene& scene)
{
    const std::span<const uint32_t> texels = scene.textureTexels;
    for (size_t i = 0; i < scene.textures.size(); i++) {
        const Texture& texture = scene.textures[i];
        if (isSound(texture) && isWithin(texture, texels.size())) continue;
        throw damaged(file, "textures",
                      fmt::format("number {} has a number out of range, or texels that are not there", i));
    }
    float before = 0;
    for (size_t i = 0; i < std::min<size_t>(SRGB_TABLE_SIZE, texels.size()); i++) {
        const float value = std::bit_cast<float>(texels[i]);
        if (!(value >= before && value <= 1))
            throw damaged(file, "textureTexels", fmt::format("the sRGB curve falls at {}", i));
        before = value;
    }
    for (size_t i = 0; i < scene.materials.size(); i++) {
        const Material& m = scene.materials[i];
        const uint largest =
            std::max({m.baseColorTexture, m.roughnessTexture, m.normalTexture, m.emissionTexture});
        if (largest <= scene.textures.size()) continue;
        throw damaged(file, "materials",
                      fmt::format("number {} has texture {} of {}", i, largest, scene.textures.size()));
    }
}

void checkPrimitives(const std::string& file, const DeviceScene& scene)
{
    auto wrong = [&](size_t i, const std::string& finding) {
        return damaged(file, "primitives", fmt::format("primitive {}: {}", i, finding));
    };
    for (size_t i = 0; i < scene.primitives.size(); i++) {
        const Primitive& primitive = scene.primitives[i];
        if (vanishing(primitive) != 0) throw wrong(i, "a coordinate is not finite");
        if (primitive.material >= scene.materials.size()) {
            throw wrong(
                i, fmt::format("material {} of {}", primitive.material, scene.materials.size()));
        }
        const bool hasNormals = primitive.shape < SHAPE_SPHERE;
        if (hasNormals && primitive.shape >= scene.triangleCorners.size()) {
            throw wrong(
                i, fmt::format("normals {} of {}", primitive.shape, scene.triangleCorners.size()));
        }
        if (!isSoundShape(primitive)) {
            throw wrong(i, "a sphere whose radius is not positive or whose box is not finite");
        }
    }
}

void checkNormals(const std::string& file, std::span<const TriangleCorners> normals)
{
    for (size_t i = 0; i < normals.size(); i++) {
        const TriangleCorners& n = normals[i];
        const bool flat = n.n0 == vec3(0) && n.n1 == vec3(0) && n.n2 == vec3(0);
        if (!isFinite({n.u0, n.u1, n.u2}) || !isFinite({n.v0, n.v1, n.v2})) {
            throw damaged(file, "corners",
                          fmt::format("texture coordinates of number {} are not finite", i));
        }
        if (flat || (isUnit(n.n0) && isUnit(n.n1) && isUnit(n.n2))) continue;
        throw damaged(file, "corners", fmt::format("those of number {} are not unit vectors", i));
    }
}

bool isSound(const Material& material)
{
    return material.type <= MATERIAL_METALLIC_ROUGHNESS && isAmount(material.baseColor) &&
           isAmount(material.emission) && isFinite(material.eta) && material.eta > 0 &&
           isAmount(material.conductorEta) && isAmount(material.conductorK) &&
           isAmount({material.diffuseWeight, material.specularWeight, material.shininess}) &&
           isAmount(material.specularColor) && isAmount(material.ambientColor) &&
           isShare(material.roughness) && isShare(material.metallic) &&
           isShare(material.transmission) &&
           isAmount({material.alphaCutoff, 0, 0});
}

bool isSound(const Light& light)
{
    const bool directed = light.type != LIGHT_POINT;
    return light.type <= LIGHT_DIRECTIONAL && isFinite(light.position) &&
           isAmount(light.intensity) && isFinite(light.direction) &&
           (!directed || isUnit(light.direction)) && isFinite(light.cosOuter) &&
           isFinite(light.cosInner);
}

bool isSound(const vec4& texel)
{
    return allOf(isFinite(texel.x), isFinite(texel.y), isFinite(texel.z), texel.x >= 0,
                 texel.y >= 0, texel.z >= 0);
}

bool isFiniteBox(const vec3& lo, const vec3& hi)
{
    return isFinite(lo) && isFinite(hi) && lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z;
}

void checkInstances(const std::string& file, const DeviceScene& scene)
{
    if (scene.instances.size() > MAX_INSTANCES) {
        throw damaged(
            file, "instances",
            fmt::format("there are {}, more than {}", scene.instances.size(), MAX_INSTANCES));
    }
    for (size_t i = 0; i < scene.instances.size(); i++) {
        const ObjectInstance& o = scene.instances[i];
        const bool finite = isFinite(o.toObject0) && isFinite(o.toObject1) &&
                            isFinite(o.toObject2) && isFinite(o.toWorld0) && isFinite(o.toWorld1) &&
                            isFinite(o.toWorld2) && isFinite(o.translation) &&
                            isFiniteBox(o.lo, o.hi);
        const bool painted = o.material == NO_MATERIAL || o.material < scene.materials.size();
        if (finite && painted) continue;
        throw damaged(file, "instances",
                      fmt::format("number {} has a material or a number out of range", i));
    }
}

template <class Element>
void checkEach(const std::string& file, const char* section, std::span<const Element> elements)
{
    bool sound = true;  // of all, without a branch for each
    for (const Element& element : elements) sound &= isSound(element);
    if (sound) return;
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [](const Element& element) { return !isSound(element); });
    throw damaged(file, section,
                  fmt::format("number {} has an unknown type or a number out of range",
                              found - elements.begin()));
}

void checkObjectStarts(const std::string& file, std::span<const uint32_t> starts,
                       uint64_t primitives)
{
    const bool ascend = std::is_sorted(starts.begin(), starts.end());
    if (ascend && (starts.empty() || starts.back() <= primitives)) return;
    throw damaged(file, "objectStarts",
                  fmt::format("they do not ascend or reach beyond the {} primitives", primitives));
}

void checkProbe(const std::string& file, const Probe& probe, uint64_t texels)
{
    if (probe.height == 0) return;
    const uint64_t end = probe.firstTexel + uint64_t{probe.width} * probe.height;
    constexpr uint MAX_SIDE = 1u << 20;
    if (probe.width == 0 || probe.width > MAX_SIDE || probe.height > MAX_SIDE || end > texels) {
        throw damaged(file, "scene",
                      fmt::format("a probe of {} x {} texels from {} on, of {}", probe.width,
                                  probe.height, probe.firstTexel, texels));
    }
    const vec3 cosines(glm::dot(probe.axisX, probe.axisY), glm::dot(probe.axisY, probe.axisZ),
                       glm::dot(probe.axisZ, probe.axisX));
    const bool upright = std::abs(cosines.x) <= UNIT_TOLERANCE &&
                         std::abs(cosines.y) <= UNIT_TOLERANCE &&
                         std::abs(cosines.z) <= UNIT_TOLERANCE;
    if (!upright || !isUnit(probe.axisX) || !isUnit(probe.axisY) || !isUnit(probe.axisZ)) {
        throw damaged(file, "scene", "a probe's axes are not unit vectors at right angles");
    }
}

}  // namespace

BvhStatistics checkArrays(const std::string& file, const DeviceScene& scene, uint rootRef,
                          std::span<const uint32_t> objectStarts)
{
    if (scene.primitives.size() > MAX_PRIMITIVES) {
        throw damaged(
            file, "primitives",
            fmt::format("there are {}, more than {}", scene.primitives.size(), MAX_PRIMITIVES));
    }
    checkPrimitives(file, scene);
    checkNormals(file, scene.triangleCorners);
    checkEach(file, "materials", scene.materials);
    checkTextures(file, scene);
    checkEach(file, "lights", scene.lights);
    checkEach(file, "texels", scene.probeTexels);
    checkInstances(file, scene);
    const BvhStatistics statistics = checkTrees(file, scene, rootRef);
    checkObjectStarts(file, objectStarts, statistics.primitivesSeen);
    return statistics;
}

void checkFrame(const std::string& file, const Frame& frame, uint64_t texelCount)
{
    const Camera& camera = frame.camera;
    const bool finite = isFinite(camera.position) && isFinite(camera.right) &&
                        isFinite(camera.down) && isUnit(camera.forward) &&
                        isFinite(camera.lensRight) && isFinite(camera.lensDown) &&
                        isFinite(camera.focusDistance) && isAmount(frame.ambient);
    if (!finite) throw damaged(file, "scene", "the camera reaches beyond the range of numbers");
    checkProbe(file, frame.probe, texelCount);
    checkProbe(file, frame.background, texelCount);
}

}  // namespace sahl
