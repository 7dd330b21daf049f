// The wide tree that rays walk: the builder's binary tree collapsed to nodes of four children with
// boxes of 16 bits (WideNode). Made when a scene is prepared, never saved.
#pragma once

#include "shared/scene_types.h"

#include <span>
#include <vector>

namespace sahl {

/// The wide trees of a scene. Leaves and instances are referred to as in the binary ones.
struct WideTrees {
    std::vector<WideNode> nodes;
    std::vector<ObjectInstance> instances;  ///< with rootRef and grid of the objects' wide trees
    uint rootRef = REF_NONE;
    vec3 gridAt = vec3(0.0f);  ///< of the world, as in Frame
    uint gridScale = 0;
    uint worstPending = 0;  ///< most references that wait on the stack, whatever the ray
    uint worstGroups = 0;   ///< most nodes of which children wait, whatever the ray
};

/// Collapses trees that are sound (bvh.h). The result depends on the arguments alone.
///   reach  no ray of the world starts at a coordinate beyond it [m]
/// Empty, without any node, where the numbers of a grid would leave the range of float32 (scenes
/// larger than 2^56 m): those are walked in the binary tree.
WideTrees widen(std::span<const BvhNode> nodes, std::span<const ObjectInstance> instances,
                uint rootRef, double reach);

}  // namespace sahl
