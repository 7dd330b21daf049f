// Trees of two levels: one over the world's primitives and instances, and one for every object that
// instances share. An object is stored once, however often it is placed.
#pragma once

#include "bvh/box.h"
#include "bvh/bvh.h"

#include <glm/glm.hpp>

namespace sahl {

/// An object placed in the world: p = linear q + translation for its points q.
struct Placement {
    glm::dmat3 linear = glm::dmat3(1.0);
    glm::dvec3 translation = glm::dvec3(0.0);
    uint object = 0;
    uint material = NO_MATERIAL;  ///< of all its primitives, instead of their own
};

/// Most by which an instance may stretch or shrink, so that products of lengths in its object's
/// space stay well within the range of float32.
constexpr double LARGEST_STRETCH = 1e9;

/// Whether the map can be inverted, and no element of it or of its inverse exceeds LARGEST_STRETCH.
bool isPlaceable(const Placement& placement);

/// The box, in the world, of a placed box: exact but for one rounding outwards.
Box placedBox(const Placement& placement, const Box& box);

/// The device's instance of an object whose primitives' boxes lie in `object`, for rays whose
/// origins have no coordinate beyond `reach`. rootRef and firstNumber are left 0. Throws badInput
/// when the placement is not placeable, or its box is not finite.
ObjectInstance makeInstance(const Placement& placement, const Box& object, double reach);

/// What a visit of an instance costs in the tree of the world, by that of its object: the tree below,
/// and the box that is tested once more.
inline double costOfInstance(const Bvh& object)
{
    return 1 + object.statistics.sahCost;
}

/// Appends the trees of objects, none with instances in it, to the world's, one after the other.
/// The statistics become those of all. Returns the references to their roots.
std::vector<uint> appendObjects(std::span<const Bvh> objects, Bvh& world);

/// Builds all trees; the instances are in the order of `placements`. Primitives of objects count
/// from 0 in each; numbers of instances follow those of the world.
///   reach  no ray starts at a coordinate beyond it, other than on the surfaces given here [m]
/// Throws as buildBvh() does, and for more than MAX_INSTANCES or more primitives, as seen by rays,
/// than can be numbered.
Bvh buildTwoLevels(std::span<const Primitive> primitives,
                   std::span<const std::vector<Primitive>> objects,
                   std::span<const Placement> placements, double reach, BvhBuild build,
                   unsigned threads);

}  // namespace sahl
