// Scenes and films for tests that render.
#pragma once

#include "render/prepare.h"
#include "render/render.h"
#include "support/assets.h"

namespace sahl::testing {

/// The built-in scene, small.
inline SceneOptions smallPicture(uint32_t width, uint32_t height, uint32_t spp)
{
    SceneOptions options;
    options.width = width;
    options.height = height;
    options.spp = spp;
    options.maxBounces = 8;
    return options;
}

/// Adds a closed cube of 12 triangles of the first material.
inline void addBox(Scene& scene, vec3 centre, float halfSide)
{
    const int faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 5, 1}, {0, 4, 5},
                              {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    auto corner = [&](int i) {
        return centre + halfSide * vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    };
    for (auto& face : faces) {
        Primitive triangle = {};
        triangle.p0 = corner(face[0]);
        triangle.p1 = corner(face[1]);
        triangle.p2 = corner(face[2]);
        triangle.number = static_cast<uint>(scene.primitives.size());
        triangle.shape = SHAPE_FLAT;
        scene.primitives.push_back(triangle);
    }
}

/// Renders samples [first, first + count) of a scene on a device.
inline Film renderFilm(Device& device, const PreparedScene& scene, uint32_t firstSample, uint32_t count,
                       uint32_t tileSize = 0)
{
    device.setScene(scene.deviceScene());
    RenderPlan plan = {scene.scene.settings.width, scene.scene.settings.height, firstSample, count, tileSize};
    return renderPicture(device, plan, [](const RenderProgress&) {}).film;
}

inline Film renderFilm(Device& device, const PreparedScene& scene)
{
    return renderFilm(device, scene, 0, scene.scene.settings.spp);
}

}  // namespace sahl::testing
