// Scenes for lamps and probes.
#include "oracle/terms.h"
#include "oracle/terms_parts.h"

namespace sahl::testing {
namespace {

void scaleEmission(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.emission *= 1 + by;
}

void scaleLights(Scene& scene, float by)
{
    for (Light& light : scene.lights) light.intensity *= 1 + by;
}

/// A lamp that lights a floor; both are seen. There is no other light.
Scene emission()
{
    Scene scene = scene32(3);
    addMaterialOf(scene, MATERIAL_LAMBERT, {0.8f, 0.6f, 0.7f});
    addLevel(scene, 0, 2);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = {3, 4, 5};
    addRectangle(scene, {-1, 0.3, -1}, {2, 0, 0}, {0, 1.5, -0.5});
    lookFrom(scene, {0, 3, 4}, {0, 0.4, 0}, 40);
    return scene;
}

/// A floor, a wall and a box that throws a shadow. No light but that of the lamps added later.
Scene room()
{
    Scene scene = corner(MATERIAL_LAMBERT, 3);
    scene.probe = blackProbe();
    addRectangle(scene, {-0.5, 0, 0.5}, {1, 0, 0.3}, {0, 0.7, 0});
    addSphere(scene, {1, 0.4f, 0.6f}, 0.4f);
    return scene;
}

Scene pointLight()
{
    Scene scene = room();
    addLight(scene, LIGHT_POINT, {8, 9, 10}).position = {0.5f, 2, 2.5f};
    return scene;
}

Scene directionalLight()
{
    Scene scene = room();
    addLight(scene, LIGHT_DIRECTIONAL, {3, 4, 5}).direction =
        vec3(glm::normalize(glm::dvec3(-0.5, -1, -0.7)));
    return scene;
}

Light& addSpot(Scene& scene, double outerDeg, double innerDeg)
{
    Light& light = addLight(scene, LIGHT_SPOT, {8, 9, 10});
    light.position = {0.5f, 2, 2.5f};
    light.direction = vec3(glm::normalize(glm::dvec3(-0.5, -1.4, -2)));
    light.cosOuter = cosineOf(outerDeg);
    light.cosInner = cosineOf(innerDeg);
    return light;
}

/// The whole cone lies in the view, with a wide soft rim.
Scene spotLight()
{
    Scene scene = room();
    addSpot(scene, 25, 10);
    return scene;
}

void widenSpot(Scene& scene, float by)
{
    scene.lights[0].cosOuter = cosineOf(25 * (1 + double{by}));
    scene.lights[0].cosInner = cosineOf(10 * (1 + double{by}));
}

Scene severalLights()
{
    Scene scene = directionalLight();
    addSpot(scene, 30, 20);
    addLight(scene, LIGHT_POINT, {2, 3, 2}).position = {-1, 2, 1.5f};
    return scene;
}

/// Turns the probe about an axis by the given share of a whole turn.
void turnProbe(Scene& scene, glm::dvec3 axis, double turns)
{
    const Transform turn = rotation(axis, 360 * turns);
    for (vec3* row : {&scene.probe.axisX, &scene.probe.axisY, &scene.probe.axisZ}) {
        *row = vec3(turn.linear * glm::dvec3(*row));
    }
}

void turnProbeAboutX(Scene& scene, float by)
{
    turnProbe(scene, {1, 0, 0}, double{by});
}

/// A mirror ball before black: the probe gives all light, and the ball shows nearly all of it.
Scene mirrorBall(uint mapping, uint filter, bool turned)
{
    Scene scene = scene32(1);
    addMaterialOf(scene, MATERIAL_MIRROR, vec3(1));
    addSphere(scene, {0, 0, 0}, 1);
    scene.probe = addSky(scene, mapping, filter);
    scene.background = blackProbe();
    if (turned) turnProbe(scene, {0.3, 1, -0.5}, 0.3);
    lookFrom(scene, {0, 0, 4}, {0, 0, 0}, 30);
    return scene;
}

Scene latLongNearest()
{
    return mirrorBall(PROBE_LATLONG, FILTER_NEAREST, false);
}

Scene latLongTurned()
{
    return mirrorBall(PROBE_LATLONG, FILTER_BILINEAR, true);
}

Scene angularNearest()
{
    return mirrorBall(PROBE_ANGULAR, FILTER_NEAREST, false);
}

Scene angularTurned()
{
    return mirrorBall(PROBE_ANGULAR, FILTER_BILINEAR, true);
}

/// The camera looks past a small dark ball at a background that lights nothing else.
Scene background()
{
    Scene scene = scene32(2);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f));
    addSphere(scene, {0.3f, 0, 0}, 0.5f);
    scene.probe = addHalves(scene, vec3(0.1f), vec3(0.2f));
    scene.background = addSky(scene, PROBE_ANGULAR, FILTER_BILINEAR);
    lookFrom(scene, {0, 0, 4}, {0, 0, 0}, 60);
    return scene;
}

}  // namespace

std::vector<Term> lightTerms()
{
    return {
        {"emission", emission, scaleEmission, "radiance"},
        {"pointLight", pointLight, scaleLights, "intensity"},
        {"spotLight", spotLight, widenSpot, "both angles"},
        {"directionalLight", directionalLight, scaleLights, "irradiance"},
        {"severalLights", severalLights, scaleLights, "intensities"},
        {"latLongNearest", latLongNearest, scaleProbes, "radiance"},
        {"latLongTurned", latLongTurned, turnProbeAboutX, "rotation, of a turn", true},
        {"angularNearest", angularNearest, scaleProbes, "radiance"},
        {"angularTurned", angularTurned, turnProbeAboutX, "rotation, of a turn", true},
        {"background", background, scaleProbes, "radiance"},
    };
}

}  // namespace sahl::testing
