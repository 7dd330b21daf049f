#include "scene/transform.h"

#include "scene/angles.h"

#include <cmath>

namespace sahl {

Transform translation(const glm::dvec3& offset)
{
    return {glm::dmat3(1.0), offset};
}

Transform scaling(const glm::dvec3& factors)
{
    glm::dmat3 linear(0.0);
    for (int i = 0; i < 3; i++) linear[i][i] = factors[i];
    return {linear, glm::dvec3(0.0)};
}

Transform rotation(const glm::dvec3& axis, double angleDeg)
{
    // Rodrigues: R = cos I + sin [a]x + (1 - cos) a a^T
    glm::dvec3 a = axis / std::sqrt(glm::dot(axis, axis));
    double c = cosDeg(angleDeg);
    double s = sinDeg(angleDeg);
    glm::dmat3 cross({0, a.z, -a.y}, {-a.z, 0, a.x}, {a.y, -a.x, 0});
    glm::dmat3 outer(a * a.x, a * a.y, a * a.z);
    return {glm::dmat3(1.0) * c + cross * s + outer * (1 - c), glm::dvec3(0.0)};
}

Transform compose(const Transform& second, const Transform& first)
{
    return {second.linear * first.linear, second.linear * first.translation + second.translation};
}

double determinant(const Transform& transform)
{
    const glm::dmat3& m = transform.linear;
    return glm::dot(m[0], glm::cross(m[1], m[2]));
}

glm::dvec3 mapPoint(const Transform& transform, const glm::dvec3& p)
{
    return transform.linear * p + transform.translation;
}

glm::dmat3 normalMatrix(const Transform& transform)
{
    const glm::dmat3& m = transform.linear;
    double sign = determinant(transform) < 0 ? -1.0 : 1.0;
    return {glm::cross(m[1], m[2]) * sign, glm::cross(m[2], m[0]) * sign,
            glm::cross(m[0], m[1]) * sign};
}

}  // namespace sahl
