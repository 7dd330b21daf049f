// Watertight intersection of a ray with a triangle: Woop, Benthin and Wald 2013, "Watertight
// Ray/Triangle Intersection", JCGT 2(1), without its double precision fallback: an edge function of
// zero counts as inside, and two triangles hit at the same distance are told apart by their number.
// The distance is not theirs but that of the triangle's plane, which stays accurate on slivers.

// The ray's axes permuted and sheared so that it runs along +z.
struct ShearedRay
{
    uint kx;   // axes: kz is the one along which the ray is fastest
    uint ky;
    uint kz;
    float sx;  // shear
    float sy;
    float sz;
    float ox;  // origin along kx, ky, kz
    float oy;
    float oz;
};

ShearedRay shearRay(vec3 org, vec3 dir)
{
    vec3 size = absolute3(dir);
    ShearedRay ray;
    uint k = size.x > size.y ? 0u : 1u;
    ray.kz = max2(size.y, size.x) > size.z ? k : 2u;
    ray.kx = ray.kz == 2u ? 0u : ray.kz + 1u;
    ray.ky = ray.kx == 2u ? 0u : ray.kx + 1u;
    ray.sz = quotient(1.0f, pickAxis(dir, ray.kz));
    ray.sx = pickAxis(dir, ray.kx) * ray.sz;
    ray.sy = pickAxis(dir, ray.ky) * ray.sz;
    ray.ox = pickAxis(org, ray.kx);
    ray.oy = pickAxis(org, ray.ky);
    ray.oz = pickAxis(org, ray.kz);
    return ray;
}

/// Distance at which the ray meets the triangle's plane [m], or a negative number where that is not
/// certain to be in front of the origin. A distance weighted by barycentric coordinates is off by
/// hundreds of roundings on long triangles; from a normal made of the two shorter edges it is off by
/// about one rounding of the farthest corner's distance, divided by the cosine between ray and normal.
float planeDistance(vec3 org, vec3 dir, READ(Primitive) triangle)
{
    Axes p0 = axesOf(triangle.p0);
    Axes p1 = axesOf(triangle.p1);
    Axes p2 = axesOf(triangle.p2);
    Axes e0 = p1 - p0;
    Axes e1 = p2 - p1;
    Axes e2 = p0 - p2;
    float size0 = dotAxes(e0, e0);
    float size1 = dotAxes(e1, e1);
    float size2 = dotAxes(e2, e2);
    AxesMask longest0 = lessAlongAxes(equalAxes(max2(size1, size2)), equalAxes(size0));
    AxesMask longest1 = lessAlongAxes(equalAxes(size2), equalAxes(size1));
    Axes a = chosenAxes(longest0, e1, chosenAxes(longest1, e2, e0));
    Axes b = chosenAxes(longest0, e2, chosenAxes(longest1, e0, e1));
    Axes n = crossAxes(a, b);
    Axes toPlane = chosenAxes(longest0, p2, chosenAxes(longest1, p0, p1)) - axesOf(org);
    float slope = flushed(dotAxes(n, axesOf(dir)));
    if (slope == 0.0f) return -1.0f;
    float inverseSlope = quotient(1.0f, slope);
    float t = dotAxes(n, toPlane) * inverseSlope;

    // A bound on the rounding error of t, so that a hit behind the origin is never taken for one in
    // front: edges are within 1 rounding (2^-24) of their size, n within 4 of the products below, the
    // numerator of t within 8 and the slope within 7 of theirs, t itself 2 more. 10 cover all that.
    Axes sizeA = sizeAlongAxes(a);
    Axes sizeB = sizeAlongAxes(b);
    Axes products = yzx(sizeA) * zxy(sizeB) + zxy(sizeA) * yzx(sizeB);
    float above = dotAxes(products, sizeAlongAxes(toPlane));
    float below = dotAxes(products, sizeAlongAxes(axesOf(dir)));
    float error = 6e-7f * (above + absolute(t) * below) * absolute(inverseSlope);
    return t > error ? t : -1.0f;
}

/// Finds where the ray meets the triangle's plane inside the triangle, in front of the origin.
///   t       distance [m], larger than its own rounding error; no upper end is applied
///   b1, b2  barycentric coordinates of p1 and p2
/// Returns false for a miss, a degenerate triangle and anything that is not a number.
bool intersectTriangle(vec3 org, vec3 dir, ShearedRay ray, READ(Primitive) triangle, OUT(float) t,
                       OUT(float) b1, OUT(float) b2)
{
    t = 0.0f;
    b1 = 0.0f;
    b2 = 0.0f;

    // Corners relative to the origin, sheared: of each its place along one axis
    Axes z = cornersAlong(triangle, org, ray.kz, ray.oz);
    Axes x = cornersAlong(triangle, org, ray.kx, ray.ox) - equalAxes(ray.sx) * z;
    Axes y = cornersAlong(triangle, org, ray.ky, ray.oy) - equalAxes(ray.sy) * z;

    // Edge functions: neighbours compute the same products for a shared edge, so no ray slips through
    Axes edges = zxy(x) * yzx(y) - zxy(y) * yzx(x);
    if (onBothSidesOfZero(edges)) return false;
    float u = alongX(edges);
    float v = alongY(edges);
    float w = alongZ(edges);
    float det = (u + v) + w;
    t = planeDistance(org, dir, triangle);
    if (!(absolute(det) > 0.0f) || t < 0.0f) return false;
    float inverseDet = quotient(1.0f, det);
    b1 = v * inverseDet;
    b2 = w * inverseDet;
    return true;
}
