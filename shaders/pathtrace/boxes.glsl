// Boxes with planes along the axes, and what tests of them need of a ray.

// A ray that meets a primitive must meet its box. The test of a triangle may take the ray to be beside
// where it is by 7 roundings (2^-24) of the farthest corner's coordinates relative to the origin, that of
// a sphere by fewer, the test of a box its planes by 3. So boxes and rays' origins are widened by 12
// roundings of their largest coordinate; 2 are left for the widening itself.
CONST float WIDENING = 7.15255737e-07f;
CONST float LARGEST_FLOAT = 3.40282347e+38f;

// What box tests need of a ray. Handed on by value, as is ShearedRay: by READ the CPU's walks were 1 to 4 % slower.
struct BoxRay
{
    Axes inverse;  // 1 / direction, clamped so that no axis is infinite
    Axes orgLo;    // origin widened for the lower and the upper planes of a box, so that a ray inside a
    Axes orgHi;    // box's plane meets the box
};

Axes clampedInverse(Axes d)
{
    Axes largest = chosenAxes(lessAlongAxes(d, equalAxes(0.0f)), equalAxes(-1e18f), equalAxes(1e18f));
    return chosenAxes(lessAlongAxes(sizeAlongAxes(d), equalAxes(1e-18f)), largest, inverseAlongAxes(d));
}

float dotAxes(Axes a, Axes b)
{
    Axes products = a * b;
    return (alongX(products) + alongY(products)) + alongZ(products);
}

Axes crossAxes(Axes a, Axes b) { return yzx(a) * zxy(b) - zxy(a) * yzx(b); }

float largestAlong(Axes v) { return max2(max2(alongX(v), alongY(v)), alongZ(v)); }

float smallestAlong(Axes v) { return min2(min2(alongX(v), alongY(v)), alongZ(v)); }

BoxRay makeBoxRay(vec3 org, vec3 dir)
{
    BoxRay ray;
    ray.inverse = clampedInverse(axesOf(dir));
    Axes at = axesOf(org);
    Axes pad = equalAxes(largestAlong(sizeAlongAxes(at)) * WIDENING + 1e-20f);
    ray.orgLo = at + pad;
    ray.orgHi = at - pad;
    return ray;
}

/// Tests a box against the part of the ray up to tMax.
///   entry  distance at which the ray enters, 0 when it starts inside [m]
bool intersectAxes(BoxRay ray, Axes lo, Axes hi, float tMax, OUT(float) entry)
{
    Axes a = (lo - ray.orgLo) * ray.inverse;
    Axes b = (hi - ray.orgHi) * ray.inverse;
    entry = max2(largestAlong(lesserAxes(a, b)), 0.0f);
    float leave = min2(smallestAlong(greaterAxes(a, b)), tMax);
    return entry <= leave;
}

bool intersectBox(BoxRay ray, vec3 lo, vec3 hi, float tMax, OUT(float) entry)
{
    return intersectAxes(ray, axesOf(lo), axesOf(hi), tMax, entry);
}
