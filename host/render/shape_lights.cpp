#include "render/shape_lights.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace sahl {

namespace {

/// Of the material's emission, on average over its texture.
double emittedLuminance(const Material& material, std::span<const Texture> textures)
{
    glm::dvec3 c(material.emission);
    if (material.emissionTexture != NO_TEXTURE)
        c *= glm::dvec3(textures[material.emissionTexture - 1].mean);
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// Slots of all primitives of a tree, by their numbers. Instances in it are left out.
std::vector<uint> slotsBelow(const DeviceScene& scene, uint root)
{
    std::vector<uint> slots;
    std::vector<uint> open = {root};
    while (!open.empty()) {
        const uint ref = open.back();
        open.pop_back();
        if (ref == REF_NONE) continue;
        if ((ref & REF_LEAF) != 0) {
            const uint first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
            const uint count = (ref & (MAX_LEAF_SIZE - 1)) + 1;
            for (uint i = 0; i < count; i++) slots.push_back(first + i);
        } else if ((ref & REF_INSTANCE) == 0) {
            open.push_back(scene.nodes[ref].ref1);
            open.push_back(scene.nodes[ref].ref0);
        }
    }
    std::sort(slots.begin(), slots.end(), [&](uint a, uint b) {
        return scene.primitives[a].number < scene.primitives[b].number;
    });
    return slots;
}

/// Where primitives stand in the world.
struct Place {
    glm::dmat3 linear = glm::dmat3(1.0);
    double determinant = 1;
    glm::dvec3 translation{0.0};
    double inverseStretch =
        1;  ///< square root of the mean square by which the way back stretches directions
};

Place placeOf(const ObjectInstance& instance)
{
    Place place;
    const glm::dmat3 rows(instance.toWorld0, instance.toWorld1, instance.toWorld2);
    place.linear = glm::transpose(rows);
    place.translation = glm::dvec3(instance.translation);
    place.determinant = std::abs(glm::determinant(rows));
    const glm::dvec3 a(instance.toObject0), b(instance.toObject1), c(instance.toObject2);
    place.inverseStretch = std::sqrt((glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c)) / 3);
    return place;
}

/// Area in the world [m^2]; of an ellipsoid that of a sphere times the root of the mean square by
/// which the map scales areas.
double areaOf(const Primitive& shape, const Place& place)
{
    if (shape.shape == SHAPE_SPHERE) {
        const double radius = shape.p1.x;
        return 4 * std::numbers::pi * radius * radius * place.determinant * place.inverseStretch;
    }
    const glm::dvec3 u = place.linear * (glm::dvec3(shape.p1) - glm::dvec3(shape.p0));
    const glm::dvec3 v = place.linear * (glm::dvec3(shape.p2) - glm::dvec3(shape.p0));
    const glm::dvec3 n = glm::cross(u, v);
    return std::sqrt(glm::dot(n, n)) / 2;
}

/// Of a shape of that weight. What it shows of its area is, on average over all directions, a
/// quarter of a sphere's and half of a triangle's.
FarLight farLightOf(const Primitive& shape, const Place& place, double weight)
{
    FarLight far;
    if (shape.shape == SHAPE_SPHERE) {
        far.centre = place.linear * glm::dvec3(shape.p0) + place.translation;
        far.squaredRadius = double{shape.p1.x} * double{shape.p1.x} *
                            std::cbrt(place.determinant * place.determinant);
        far.strength = weight / 4;
        return far;
    }
    const glm::dvec3 p0(shape.p0), p1(shape.p1), p2(shape.p2);
    const glm::dvec3 middle = (p0 + p1 + p2) / 3.0;
    for (const glm::dvec3& p : {p0, p1, p2}) {
        const glm::dvec3 away = place.linear * (p - middle);
        far.squaredRadius += glm::dot(away, away) / 12;
    }
    far.centre = place.linear * middle + place.translation;
    far.strength = weight / 2;
    return far;
}

/// Collects the shapes that shine, up to a limit.
class Collector {
public:
    Collector(const DeviceScene& scene, size_t limit) : scene_(scene), limit_(limit)
    {
        for (const Material& material : scene.materials)
            luminances_.push_back(emittedLuminance(material, scene.textures));
    }

    bool anythingShines() const
    {
        return std::any_of(luminances_.begin(), luminances_.end(), [](double y) { return y > 0; });
    }

    /// Adds those of a tree.
    ///   material  of all its primitives, or NO_MATERIAL
    void add(uint root, uint instance, uint material, const Place& place)
    {
        if (material != NO_MATERIAL && !(luminances_[material] > 0)) return;
        for (uint slot : material != NO_MATERIAL ? allBelow(root) : shiningBelow(root)) {
            if (isFull()) return;
            const Primitive& shape = scene_.primitives[slot];
            const uint painted = material != NO_MATERIAL ? material : shape.material;
            const double weight = luminances_[painted] * areaOf(shape, place);
            const uint type = shape.shape == SHAPE_SPHERE ? LIGHT_SPHERE : LIGHT_TRIANGLE;
            if (!(weight > 0)) continue;
            lights.push_back({type, slot, instance, weight, farLightOf(shape, place, weight)});
        }
    }

    bool isFull() const { return lights.size() > limit_; }

    std::vector<ShapeLight> lights;

private:
    // Trees are looked through once, however often they are placed.
    const std::vector<uint>& allBelow(uint root)
    {
        const auto [found, isNew] = all_.try_emplace(root);
        if (isNew) found->second = slotsBelow(scene_, root);
        return found->second;
    }

    const std::vector<uint>& shiningBelow(uint root)
    {
        const auto [found, isNew] = shining_.try_emplace(root);
        if (isNew) {
            for (uint slot : slotsBelow(scene_, root)) {
                if (luminances_[scene_.primitives[slot].material] > 0)
                    found->second.push_back(slot);
            }
        }
        return found->second;
    }

    const DeviceScene& scene_;
    size_t limit_;
    std::vector<double> luminances_;             // of materials
    std::map<uint, std::vector<uint>> all_;      // slots by the root of their tree
    std::map<uint, std::vector<uint>> shining_;  // of those whose own material shines
};

}  // namespace

std::optional<std::vector<ShapeLight>> shapeLightsOf(const DeviceScene& scene, size_t limit)
{
    Collector collector(scene, limit);
    if (!collector.anythingShines()) return std::vector<ShapeLight>();
    collector.add(scene.frame.rootRef, NO_INSTANCE, NO_MATERIAL, {});
    for (uint i = 0; i < scene.instances.size() && !collector.isFull(); i++) {
        const ObjectInstance& instance = scene.instances[i];
        collector.add(instance.rootRef, i, instance.material, placeOf(instance));
    }
    if (collector.isFull()) return std::nullopt;
    return std::move(collector.lights);
}

}  // namespace sahl
