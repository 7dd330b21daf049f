// Intersection of a ray with a sphere, without cancellation far away, near the surface and inside:
// Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection",
// Ray Tracing Gems, ch. 7.

/// Finds where the ray meets the sphere first in front of its origin.
///   t  distance [m]
/// A ray that starts on the outside of the sphere's surface and leaves it does not meet it: the offset
/// of its origin (interaction.glsl) is larger than the rounding error of `c` below.
bool intersectSphere(vec3 org, vec3 dir, vec3 centre, float radius, OUT(float) t)
{
    t = 0.0f;
    vec3 f = org - centre;
    float a = dot3(dir, dir);  // 1 up to rounding, which counts for far spheres
    float b = -dot3(f, dir);

    // Squared distance between the centre and the ray, from the perpendicular vector itself
    vec3 beside = f + dir * quotient(b, a);
    float discriminant = radius * radius - dot3(beside, beside);
    if (!(discriminant >= 0.0f)) return false;

    float c = dot3(f, f) - radius * radius;
    float q = root(a * discriminant);
    q = b < 0.0f ? b - q : b + q;
    if (q == 0.0f) return false;
    float near = b < 0.0f ? quotient(q, a) : quotient(c, q);
    float far = b < 0.0f ? quotient(c, q) : quotient(q, a);
    t = near > 0.0f ? near : far;
    return t > 0.0f;
}
