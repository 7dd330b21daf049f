#include "render/light_clusters.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <span>

namespace sahl {

namespace {

struct Cluster {
    std::span<FarLight> lights;
    FarLight whole;
    glm::dvec3 variance{0.0};  // of their centres, along each axis [m^2]

    double size() const { return whole.strength * whole.squaredRadius; }
};

Cluster clusterOf(std::span<FarLight> lights)
{
    Cluster cluster;
    cluster.lights = lights;
    FarLight& whole = cluster.whole;
    for (const FarLight& light : lights) {
        whole.centre += light.centre * light.strength;
        whole.strength += light.strength;
    }
    if (!(whole.strength > 0)) return cluster;
    whole.centre /= whole.strength;
    for (const FarLight& light : lights) {
        const glm::dvec3 away = light.centre - whole.centre;
        const double share = light.strength / whole.strength;
        cluster.variance += away * away * share;
        whole.squaredRadius += (glm::dot(away, away) + light.squaredRadius) * share;
    }
    return cluster;
}

int longestAxis(const glm::dvec3& v)
{
    if (v.x >= v.y && v.x >= v.z) return 0;
    return v.y >= v.z ? 1 : 2;
}

/// Cuts the cluster in two, if its lights are in different places.
bool cut(Cluster& cluster, Cluster& other)
{
    const int axis = longestAxis(cluster.variance);
    const double middle = cluster.whole.centre[axis];
    const auto lights = cluster.lights;
    const auto above =
        std::stable_partition(lights.begin(), lights.end(),
                              [&](const FarLight& light) { return light.centre[axis] < middle; });
    const auto below = static_cast<size_t>(above - lights.begin());
    if (below == 0 || below == lights.size()) return false;
    cluster = clusterOf(lights.first(below));
    other = clusterOf(lights.subspan(below));
    return true;
}

Light lightOf(const FarLight& whole)
{
    Light light = {};
    light.type = LIGHT_CLUSTER;
    light.position = vec3(whole.centre);
    light.intensity = {static_cast<float>(whole.strength), 0, 0};
    light.cosOuter = static_cast<float>(whole.squaredRadius);
    return light;
}

}  // namespace

std::vector<Light> clustersOf(std::vector<FarLight> lights, double everywhere, size_t limit)
{
    std::vector<Cluster> clusters = {clusterOf(lights)};
    while (clusters.size() < limit) {
        const auto largest = std::max_element(
            clusters.begin(), clusters.end(),
            [](const Cluster& a, const Cluster& b) { return a.size() < b.size(); });
        Cluster other;
        if (!cut(*largest, other)) break;
        clusters.push_back(other);
    }
    std::vector<Light> result;
    for (const Cluster& cluster : clusters) {
        if (cluster.whole.strength > 0) result.push_back(lightOf(cluster.whole));
    }
    if (everywhere > 0) {
        if (result.empty()) result.push_back(lightOf({}));
        result[0].cosInner = static_cast<float>(everywhere);
    }
    return result;
}

}  // namespace sahl
