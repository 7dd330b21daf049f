// Affine maps from a shape's own space to the world.
#pragma once

#include <glm/glm.hpp>

namespace sahl {

/// p' = linear * p + translation. Column vectors.
struct Transform {
    glm::dmat3 linear = glm::dmat3(1.0);
    glm::dvec3 translation = glm::dvec3(0.0);
};

Transform translation(const glm::dvec3& offset);
Transform scaling(const glm::dvec3& factors);

/// Counter-clockwise when `axis` points to the viewer. `axis` must not be zero.
Transform rotation(const glm::dvec3& axis, double angleDeg);

/// `second` after `first`.
Transform compose(const Transform& second, const Transform& first);

/// Volume factor; 0 when the map flattens space, negative when it mirrors.
double determinant(const Transform& transform);

glm::dvec3 mapPoint(const Transform& transform, const glm::dvec3& p);

/// Maps normals by the inverse transpose, up to a positive factor: the cofactor matrix with the
/// sign of the determinant, which needs no division.
glm::dmat3 normalMatrix(const Transform& transform);

}  // namespace sahl
