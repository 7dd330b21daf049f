// Boxes with planes along the axes, and what tests of them need of a ray.

// A ray that meets a primitive must meet its box. The test of a triangle may take the ray to be beside
// where it is by 7 roundings (2^-24) of the farthest corner's coordinates relative to the origin, that of
// a sphere by fewer, the test of a box its planes by 3. So boxes and rays' origins are widened by 12
// roundings of their largest coordinate; 2 are left for the widening itself.
CONST float WIDENING = 7.15255737e-07f;
CONST float LARGEST_FLOAT = 3.40282347e+38f;

// What box tests need of a ray.
struct BoxRay
{
    vec3 inverse;  // 1 / direction, clamped so that no axis is infinite
    vec3 orgLo;    // origin widened for the lower and the upper planes of a box, so that a ray inside a
    vec3 orgHi;    // box's plane meets the box
};

float clampedInverse(float d)
{
    return absolute(d) < 1e-18f ? (d < 0.0f ? -1e18f : 1e18f) : quotient(1.0f, d);
}

BoxRay makeBoxRay(vec3 org, vec3 dir)
{
    BoxRay ray;
    ray.inverse = vec3(clampedInverse(dir.x), clampedInverse(dir.y), clampedInverse(dir.z));
    vec3 pad = vec3(maxComponent(absolute3(org)) * WIDENING + 1e-20f);
    ray.orgLo = org + pad;
    ray.orgHi = org - pad;
    return ray;
}

/// Tests a box against the part of the ray up to tMax.
///   entry  distance at which the ray enters, 0 when it starts inside [m]
bool intersectBox(BoxRay ray, vec3 lo, vec3 hi, float tMax, OUT(float) entry)
{
    vec3 a = (lo - ray.orgLo) * ray.inverse;
    vec3 b = (hi - ray.orgHi) * ray.inverse;
    entry = max2(max2(max2(min2(a.x, b.x), min2(a.y, b.y)), min2(a.z, b.z)), 0.0f);
    float leave = min2(min2(min2(max2(a.x, b.x), max2(a.y, b.y)), max2(a.z, b.z)), tMax);
    return entry <= leave;
}
