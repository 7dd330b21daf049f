// Which of a scene's trees rays walk.
#pragma once

#include "device/device.h"

namespace sahl {

/// Entries that a stack needs beyond those that can wait: a wide node writes three at once
/// (pathtrace/wide.glsl).
constexpr uint32_t WIDE_STACK_SLACK = 2;

/// NODE_WIDTH of the kernels for a scene: `wanted`, but 2 where there is no wide tree, or none that
/// the largest stack is enough for.
inline uint32_t nodeWidthFor(const DeviceScene& scene, uint32_t wanted)
{
    const bool fits = scene.wide.worstPending + WIDE_STACK_SLACK <= MAX_STACK_SIZE;
    return wanted == 4 && fits && !scene.wide.nodes.empty() ? 4 : 2;
}

/// Entries of the stack that walks through the trees of that width need.
inline uint32_t stackEntriesFor(const DeviceScene& scene, uint32_t nodeWidth)
{
    return nodeWidth == 4 ? scene.wide.worstPending + WIDE_STACK_SLACK : scene.treeDepth;
}

/// The scene with the frame and the instances of the trees of that width.
inline DeviceScene walkedScene(DeviceScene scene, uint32_t nodeWidth)
{
    if (nodeWidth != 4) return scene;
    scene.instances = scene.wide.instances;
    scene.frame.rootRef = scene.wide.rootRef;
    scene.frame.gridAt = scene.wide.gridAt;
    scene.frame.gridScale = scene.wide.gridScale;
    return scene;
}

}  // namespace sahl
