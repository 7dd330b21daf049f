#include "render/light_table.h"

#include "bvh/box.h"
#include "render/shape_lights.h"
#include "scene/alias_table.h"
#include "scene/probe_weights.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

// The probe's power rests on the size of the scene, which says little of how much a surface gets
// from it: neither the probe nor the lights are left with less than this chance.
constexpr double SMALLEST_SHARE = 0.25;

double luminance(const vec3& c)
{
    return 0.2126 * double{c.x} + 0.7152 * double{c.y} + 0.0722 * double{c.z};
}

/// Box of everything that the tree holds.
Box boxOfTree(const DeviceScene& scene)
{
    const uint root = scene.frame.rootRef;
    Box box;
    if ((root & REF_NOT_INNER) == 0) {
        const BvhNode& node = scene.nodes[root];
        grow(box, node.lo0, node.hi0);
        grow(box, node.lo1, node.hi1);
    } else if ((root & REF_LEAF) != 0) {
        for (const Primitive& primitive : scene.primitives) grow(box, extentOf(primitive));
    } else {
        for (const ObjectInstance& instance : scene.instances) grow(box, instance.lo, instance.hi);
    }
    return box;
}

/// Squared radius of a sphere about everything [m^2].
double squaredRadius(const DeviceScene& scene)
{
    if (scene.frame.rootRef == REF_NONE) return 0;
    const Box box = boxOfTree(scene);
    const glm::dvec3 diagonal = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    return 0.25 * glm::dot(diagonal, diagonal);
}

/// Power of a point, spot or directional light over 2 pi, which for a shape that shines on both
/// sides is its radiance times its area. As pbrt has them (Pharr, Jakob, Humphreys 2023, Sec. 12.1
/// to 12.3).
///   radius2  squared radius of the scene [m^2]
double weightOf(const Light& light, double radius2)
{
    const double intensity = luminance(light.intensity);
    if (light.type == LIGHT_DIRECTIONAL) return intensity * radius2 / 2;
    if (light.type == LIGHT_POINT) return intensity * 2;
    const double inner = light.cosInner, outer = light.cosOuter;
    return intensity * ((1 - inner) + (inner - outer) / 2);
}

/// Sum over all lights of their weights.
double sumOf(const std::vector<double>& weights)
{
    double sum = 0;
    for (double weight : weights) sum += weight;
    return sum;
}

/// Adds shapes that shine to the lights and their weights. Returns whether they are chosen among.
bool addShapes(const DeviceScene& scene, LightTable& table, std::vector<double>& weights)
{
    const std::optional<std::vector<ShapeLight>> shapes = shapeLightsOf(scene, MAX_SHAPE_LIGHTS);
    if (!shapes) {
        warn(fmt::format(
            "more than {} shapes shine: light sampling leaves all of them out, and paths find "
            "them by chance alone",
            MAX_SHAPE_LIGHTS));
        return false;
    }
    for (const ShapeLight& shape : *shapes) {
        Light light = {};
        light.type = shape.type;
        light.slot = shape.slot;
        light.instance = shape.instance;
        table.lights.push_back(light);
        weights.push_back(shape.weight);
    }
    return true;
}

/// Chances of the lights, `share` for all of them together.
void chooseByWeight(const std::vector<double>& weights, double share, LightTable& table)
{
    const double sum = sumOf(weights);
    if (!(sum > 0)) return;
    const std::vector<uint64_t> masses = massesOf(weights);
    const double total = static_cast<double>(masses.size()) * 0x1p32;
    for (size_t i = 0; i < masses.size(); i++) {
        table.lights[i].chance = static_cast<float>(share * static_cast<double>(masses[i]) / total);
    }
    table.entries = makeAliasTable(masses);
    table.choiceCount = static_cast<uint>(masses.size());
}

/// What the probe's chance is, given its power and the lights' in the same unit: a multiple of
/// 2^-24, as are the random numbers that it is compared with.
double probeShare(double probe, double lights)
{
    if (!(probe > 0)) return 0;
    if (!(lights > 0)) return 1;
    const double share = std::clamp(probe / (probe + lights), SMALLEST_SHARE, 1 - SMALLEST_SHARE);
    return std::floor(share * 0x1p24 + 0.5) * 0x1p-24;
}

/// Powers of the probe's texels; none where the probe is the same everywhere: scattered rays find
/// such light as well, and need no shadow ray for it.
std::vector<double> powersOfProbe(const DeviceScene& scene)
{
    const Probe& probe = scene.frame.probe;
    if (probe.height == 0 || isConstant(probe, scene.probeTexels)) return {};
    return texelPowers(probe, scene.probeTexels);
}

}  // namespace

LightTable makeLightTable(const DeviceScene& scene)
{
    const double radius2 = squaredRadius(scene);
    const bool bsdfOnly = scene.frame.lightSampling == LIGHTS_BSDF_ONLY;
    LightTable table;
    std::vector<double> weights;
    for (const Light& light : scene.lights) {
        table.lights.push_back(light);
        weights.push_back(weightOf(light, radius2));
    }
    const bool shapesAreSampled = !bsdfOnly && addShapes(scene, table, weights);

    const std::vector<double> powers = powersOfProbe(scene);
    const bool probeShines = sumOf(powers) > 0;
    if (probeShines) table.texelMasses = massesOf(powers);
    // Radiant power through the scene's cross section, over 2 pi like the lights'
    const double power = probeShines && !bsdfOnly ? sumOf(powers) * radius2 / 2 : 0;
    const double share = probeShare(power, sumOf(weights));
    chooseByWeight(weights, 1 - share, table);
    if (shapesAreSampled && table.choiceCount > 0)
        table.lightPerPower = static_cast<float>((1 - share) / sumOf(weights));
    if (share > 0) {
        table.probeChance = static_cast<float>(share);
        const std::vector<AliasEntry> entries = makeAliasTable(table.texelMasses);
        table.entries.insert(table.entries.end(), entries.begin(), entries.end());
    }
    return table;
}

}  // namespace sahl
