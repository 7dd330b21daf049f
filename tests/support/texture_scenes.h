// Scenes with textures, made in code.
#pragma once

#include "scene/texture.h"
#include "scene/transform.h"
#include "support/small_scenes.h"

namespace sahl::testing {

/// Adds a lambert material that is white but for its texture of these texels, top row first.
inline Material& addTextured(Scene& scene, uint32_t width, uint32_t height,
                             const std::vector<uint32_t>& rgba, const TextureLook& look = {})
{
    Material& material = scene.materials[addMaterial(scene, "textured", vec3(1))];
    const StoredPicture picture = storePicture(scene, {width, height, rgba}, "test");
    material.baseColorTexture = addTexture(scene, picture, look);
    return material;
}

inline TextureLook nearestTexel()
{
    TextureLook look;
    look.nearest = true;
    return look;
}

/// A picture of opaque texels (or holes) in which all are different.
inline std::vector<uint32_t> patches(uint32_t width, uint32_t height, bool holes)
{
    std::vector<uint32_t> rgba;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t alpha = holes && (x * 5 + y * 3) % 4 == 0 ? 40 : 220;
            rgba.push_back(
                packTexel(255 * x / width, 255 * y / height, (x * 37 + y * 91) & 255, alpha));
        }
    }
    return rgba;
}

/// Leaves on a floor: sheets with holes that lie on and across one another (some at the very same
/// place), a sphere and a bumpy box wall, instances of such sheets, one of them mirrored; a lamp
/// with a picture, a probe, lights.
inline Scene leavesScene(uint32_t width, uint32_t height, uint32_t spp)
{
    Scene scene = emptyScene(width, height, 6);
    scene.settings.spp = spp;
    addTextured(scene, 8, 4, patches(8, 4, false));
    scene.materials.back().normalTexture = addTexture(
        scene,
        storePicture(scene, {2, 2, {0xffff8080, 0xffd0b080, 0xffe06090, 0xfff08040}}, "bumps"), {});
    addLevel(scene, 0, 4);
    addRectangle(scene, {-4, 0, -4}, {8, 0, 0}, {0, 5, 0});
    addSphere(scene, {1.5f, 0.7f, -1}, 0.7f);
    TextureLook look;
    look.srgb = true;
    for (const double lean : {0.0, 0.0, 0.4}) {
        addTextured(scene, 7, 5, patches(7, 5, true), look).alphaCutoff = 0.5f;
        addRectangle(scene, {-1.5, 0.3, 0}, {2, 0.2, lean}, {0, 2, -lean});
        look.rowS += glm::dvec3(0.5, 0.25, 0.1);
    }
    Material& lamp = addTextured(scene, 3, 2, patches(3, 2, false), nearestTexel());
    lamp.emissionTexture = lamp.baseColorTexture;
    lamp.emission = vec3(5, 4, 3);
    addRectangle(scene, {-1, 4, -1}, {2, 0, 0}, {0, 0, 2});

    const uint32_t leaf = 1;
    Scene object = emptyScene(1, 1, 1);
    object.textures = scene.textures;  // so that texture coordinates are kept
    object.triangleCorners = scene.triangleCorners;
    appendShape(object, makeRectangle({-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0}), {}, leaf, "leaf");
    appendShape(object, makeRectangle({-0.5, -0.5, 0}, {1, 0, 0}, {0, 0, 1}), {}, leaf + 1, "leaf");
    scene.triangleCorners = object.triangleCorners;
    scene.objects.push_back(object.primitives);
    for (const double side : {-1.0, 1.0}) {
        const Transform transform =
            compose(translation({1.2 * side, 1.6, 0.8}),
                    compose(rotation({0, 1, 0.3}, 35), scaling({side, 1.3, 0.8})));
        Placement placement;
        placement.linear = transform.linear;
        placement.translation = transform.translation;
        placement.material = side > 0 ? 3 : NO_MATERIAL;
        scene.instances.push_back(placement);
    }
    addLight(scene, LIGHT_POINT, vec3(20, 18, 15)).position = {2, 4, 4};
    scene.probe = addHalves(scene, vec3(0.5f, 0.6f, 0.8f), vec3(0.1f));
    CameraDescription camera;
    camera.eye = {0.3, 1.8, 6};
    camera.lookAt = {0, 1.2, 0};
    camera.fovDeg = 45;
    placeCamera(scene, camera);
    return scene;
}

}  // namespace sahl::testing
