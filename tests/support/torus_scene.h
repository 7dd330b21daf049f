// A small scene for tests of devices themselves: a wavy torus under a white sky, and its blocks as
// the CPU renders them.
#pragma once

#include "scene/scene.h"
#include "bvh/bvh.h"
#include "device/device.h"
#include "support/soups.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace sahl::testing {

/// 2 * rings * sides triangles; the view is a function of the tile's pixels alone.
class TorusScene {
public:
    explicit TorusScene(uint rings = 24, uint sides = 16, uint32_t seed = 7)
    {
        bvh_ = buildBvh(torus(rings, sides), BvhBuild::automatic, 1);
        material_.baseColor = vec3(0.7f);
        light_.position = vec3(2, 3, -1);
        light_.intensity = vec3(4, 5, 6);
        Frame& frame = scene.frame;
        frame.camera.position = vec3(0, 1.2f, -2.5f);
        frame.camera.right = vec3(0.6f, 0, 0);
        frame.camera.down = vec3(0, -0.5f, -0.3f);
        frame.camera.forward = vec3(0, -0.447f, 0.894f);
        frame.camera.focusDistance = 1;
        frame.probe = plainProbe(1, 1, PROBE_LATLONG, FILTER_NEAREST);
        frame.background = frame.probe;
        frame.width = WIDTH;
        frame.height = HEIGHT;
        frame.seed = seed;
        frame.maxBounces = 5;
        frame.rootRef = bvh_.rootRef;
        frame.lightCount = 1;
        scene.nodes = bvh_.nodes;
        scene.primitives = bvh_.primitives;
        scene.materials = {&material_, 1};
        scene.lights = {&light_, 1};
        scene.probeTexels = {&sky_, 1};
        scene.treeDepth = bvh_.statistics.depth;
    }
    TorusScene(const TorusScene&) = delete;
    TorusScene& operator=(const TorusScene&) = delete;

    static constexpr uint32_t WIDTH = 32, HEIGHT = 24;  ///< [pixels]

    DeviceScene scene;

    static TileRequest wholePicture() { return {0, 0, WIDTH, HEIGHT, 0, 4}; }

    /// What the CPU makes of a tile.
    std::vector<PixelBlock> expected(const TileRequest& tile) const
    {
        return render(*makeCpuDevice({}), tile);
    }

    std::vector<PixelBlock> render(Device& device, const TileRequest& tile) const
    {
        device.setScene(scene);
        std::vector<PixelBlock> blocks(size_t{tile.width} * tile.height);
        device.render(tile, blocks);
        return blocks;
    }

private:
    Bvh bvh_;
    Material material_ = {};
    Light light_ = {};
    vec4 sky_ = vec4(1.0f);
};

inline std::string textOf(const PixelBlock& block)
{
    std::string text;
    for (uint32_t word : std::bit_cast<std::array<uint32_t, sizeof(PixelBlock) / 4>>(block))
        text += fmt::format("{:08x} ", word);
    return text;
}

inline void expectSameBlocks(const std::vector<PixelBlock>& a, const std::vector<PixelBlock>& b)
{
    ASSERT_EQ(a.size(), b.size());
    size_t differing = 0, first = 0;
    for (size_t i = 0; i < a.size(); i++) {
        if (std::memcmp(&a[i], &b[i], sizeof(PixelBlock)) == 0) continue;
        if (differing++ == 0) first = i;
    }
    if (differing == 0) return;
    ADD_FAILURE() << differing << " of " << a.size() << " pixels; number " << first << ":\n  "
                  << textOf(a[first]) << "\n  " << textOf(b[first]);
}

}  // namespace sahl::testing
