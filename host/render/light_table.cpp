#include "render/light_table.h"

#include "bvh/box.h"
#include "render/light_clusters.h"
#include "render/shape_lights.h"
#include "scene/alias_table.h"
#include "scene/probe_weights.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

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

/// Lights that are chosen by an alias table.
struct Chosen {
    std::vector<double> weights;
    std::vector<FarLight> far;
    double everywhere = 0;  ///< irradiance by directional lights [W m^-2]
};

/// Adds lights of the scene file that are too many to be chosen one by one.
void addLights(const DeviceScene& scene, Chosen& chosen)
{
    const double radius2 = squaredRadius(scene);
    for (const Light& light : scene.lights) {
        const double weight = weightOf(light, radius2);
        chosen.weights.push_back(weight);
        if (light.type == LIGHT_DIRECTIONAL)
            chosen.everywhere += luminance(light.intensity);
        else
            chosen.far.push_back({glm::dvec3(light.position), 0, weight / 2});
    }
}

/// Adds shapes that shine. Returns whether they are chosen among.
bool addShapes(const DeviceScene& scene, LightTable& table, Chosen& chosen)
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
        chosen.weights.push_back(shape.weight);
        chosen.far.push_back(shape.far);
    }
    return true;
}

/// Makes the alias table and the clusters.
void chooseByWeight(Chosen& chosen, LightTable& table)
{
    if (!(sumOf(chosen.weights) > 0)) return;
    const std::vector<uint64_t> masses = massesOf(chosen.weights);
    const double total = static_cast<double>(masses.size()) * 0x1p32;
    for (size_t i = 0; i < masses.size(); i++) {
        table.lights[table.singleCount + i].chance =
            static_cast<float>(static_cast<double>(masses[i]) / total);
    }
    table.entries = makeAliasTable(masses);
    table.choiceCount = static_cast<uint>(masses.size());
    const std::vector<Light> clusters =
        clustersOf(std::move(chosen.far), chosen.everywhere, MAX_LIGHT_CLUSTERS);
    table.clusterCount = static_cast<uint>(clusters.size());
    table.lights.insert(table.lights.end(), clusters.begin(), clusters.end());
}

/// Powers of the probe's texels; none where the probe is the same everywhere: scattered rays find
/// such light as well, and need no shadow ray for it.
std::vector<double> powersOfProbe(const DeviceScene& scene)
{
    const Probe& probe = scene.frame.probe;
    if (probe.height == 0 || isConstant(probe, scene.probeTexels)) return {};
    return texelPowers(probe, scene.probeTexels);
}

/// Share of the probe's light that is for shadow rays: what the power heuristic gives them where their
/// density is that of the probe's mean point, and that of scattered rays 1 / pi. A bright lamp in the dark is
/// all for them, a sky that is the same everywhere 1 / 17.
double shareOfShadowRays(const DeviceScene& scene, const std::vector<double>& powers)
{
    const auto texels = scene.probeTexels.subspan(scene.frame.probe.firstTexel, powers.size());
    double squares = 0;
    for (size_t i = 0; i < powers.size(); i++) squares += powers[i] * luminance(vec3(texels[i]));
    const double sum = sumOf(powers);
    const double ratio = squares / (sum * sum) * std::numbers::pi;
    return ratio * ratio / (ratio * ratio + 1);
}

/// Adds the probe, of which the texels' powers are given.
void addProbe(const DeviceScene& scene, const std::vector<double>& powers, LightTable& table)
{
    const Probe& probe = scene.frame.probe;
    const std::vector<AliasEntry> entries = makeAliasTable(table.texelMasses);
    table.entries.insert(table.entries.end(), entries.begin(), entries.end());
    constexpr double SPHERE = 4 * std::numbers::pi;
    const double share = shareOfShadowRays(scene, powers);
    table.probeMean = static_cast<float>(share * sumOf(powers) / SPHERE);
    table.probeSlope = vec3(powerMoment(probe, powers) * (share * 3 / SPHERE));
}

}  // namespace

LightTable makeLightTable(const DeviceScene& scene)
{
    const bool bsdfOnly = scene.frame.lightSampling == LIGHTS_BSDF_ONLY;
    LightTable table;
    Chosen chosen;
    table.lights.assign(scene.lights.begin(), scene.lights.end());
    if (scene.lights.size() <= MAX_SINGLE_LIGHTS)
        table.singleCount = static_cast<uint>(scene.lights.size());
    else
        addLights(scene, chosen);
    const bool shapesAreSampled = !bsdfOnly && addShapes(scene, table, chosen);
    chooseByWeight(chosen, table);
    if (shapesAreSampled && table.choiceCount > 0)
        table.lightPerPower = static_cast<float>(1 / sumOf(chosen.weights));

    const std::vector<double> powers = powersOfProbe(scene);
    if (sumOf(powers) > 0) {
        table.texelMasses = massesOf(powers);
        if (!bsdfOnly) addProbe(scene, powers, table);
    }
    return table;
}

}  // namespace sahl
