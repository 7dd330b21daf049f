// Which of a scene's trees rays walk.
#pragma once

#include "device/device.h"

#include <algorithm>

namespace sahl {

/// How kernels walk a scene: what their constants of these names are.
struct WalkForm {
    uint32_t nodeWidth = 2;
    uint32_t stackEntries = 0;  ///< that the scene's trees need
    bool stackInRegisters = false;
    bool watched = true;  ///< walks count their steps, stop when these are spent, and see that loops are cut

    bool operator==(const WalkForm&) const = default;
};

/// A walk through a scene of so many primitives, without instances, takes 2^20 steps at most, even if it should meet all: 16
/// times what a card is given for a path in a dispatch. It need not be able to stop midway for the sake of time.
constexpr size_t SHORT_WALK_PRIMITIVES = size_t{1} << 19;

/// Entries that a stack of references needs beyond those that can wait: a wide node writes three at
/// once (pathtrace/wide.glsl).
constexpr uint32_t WIDE_STACK_SLACK = 2;

/// The wanted form, but the binary tree where there is no wide one or none that the largest stack
/// is enough for, and an array where the registers are too few.
inline WalkForm walkFormFor(const DeviceScene& scene, uint32_t wantedWidth, bool wantRegisters)
{
    const uint32_t entries = scene.wide.worstPending + WIDE_STACK_SLACK;
    const uint32_t groups = scene.wide.worstGroups;
    if (wantedWidth != 4 || scene.wide.nodes.empty() || entries > MAX_STACK_SIZE)
        return {2, scene.treeDepth, false};
    if (wantRegisters && groups <= STACK_REGISTERS + 1) return {4, std::max(groups, 2u) - 1, true};
    return {4, entries, false};
}

/// Up to so many samples a kernel with too many registers is the faster one if it is there already: 4 too many cost 2 to
/// 5 % of the samples a second on lavapipe, and another kernel takes as long as some 150,000.
constexpr uint64_t FEW_SAMPLES = 4'000'000;

/// The form in which a scene of so many primitives is likely to be walked, before its tree is known. Where many samples
/// are to come it is a guess, by the models at hand, from a box to a million triangles; for few it has all registers.
inline WalkForm expectedWalkForm(size_t primitives, uint32_t wantedWidth, bool wantRegisters, bool fewSamples)
{
    const bool isTiny = primitives <= MAX_LEAF_SIZE;
    if (wantedWidth != 4 || isTiny) return {2, isTiny ? 0u : 32u, false};
    if (wantRegisters && fewSamples) return {4, STACK_REGISTERS, true};
    const size_t size = primitives < 15'000 ? 0 : (primitives < 500'000 ? 1 : 2);
    constexpr uint32_t GROUPS[] = {8, 12, 16}, ENTRIES[] = {32, 48, MAX_STACK_SIZE};
    return {4, wantRegisters ? GROUPS[size] : ENTRIES[size], wantRegisters};
}

/// Whether a kernel made for the one form is to serve the other. An array costs nothing for being too large; registers do.
inline bool serves(const WalkForm& made, const WalkForm& needed, bool fewSamples)
{
    return made.nodeWidth == needed.nodeWidth && made.watched == needed.watched &&
           made.stackInRegisters == needed.stackInRegisters && made.stackEntries >= needed.stackEntries &&
           (!made.stackInRegisters || fewSamples);
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
