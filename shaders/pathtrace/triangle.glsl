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
    vec3 e0 = triangle.p1 - triangle.p0;
    vec3 e1 = triangle.p2 - triangle.p1;
    vec3 e2 = triangle.p0 - triangle.p2;
    float size0 = dot3(e0, e0);
    float size1 = dot3(e1, e1);
    float size2 = dot3(e2, e2);
    bool longest0 = size0 > size1 && size0 > size2;
    bool longest1 = !longest0 && size1 > size2;
    vec3 a = longest0 ? e1 : (longest1 ? e2 : e0);
    vec3 b = longest0 ? e2 : (longest1 ? e0 : e1);
    vec3 n = cross3(a, b);
    vec3 toPlane = (longest0 ? triangle.p2 : (longest1 ? triangle.p0 : triangle.p1)) - org;
    float slope = flushed(dot3(n, dir));
    if (slope == 0.0f) return -1.0f;
    float inverseSlope = quotient(1.0f, slope);
    float t = dot3(n, toPlane) * inverseSlope;

    // A bound on the rounding error of t, so that a hit behind the origin is never taken for one in
    // front: edges are within 1 rounding (2^-24) of their size, n within 4 of the products below, the
    // numerator of t within 8 and the slope within 7 of theirs, t itself 2 more. 10 cover all that.
    vec3 sizeA = absolute3(a);
    vec3 sizeB = absolute3(b);
    vec3 products = vec3(sizeA.y * sizeB.z + sizeA.z * sizeB.y, sizeA.z * sizeB.x + sizeA.x * sizeB.z,
                         sizeA.x * sizeB.y + sizeA.y * sizeB.x);
    float above = dot3(products, absolute3(toPlane));
    float below = dot3(products, absolute3(dir));
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

    // Corners relative to the origin, sheared
    float az = pickDifference(triangle.p0, org, ray.kz, ray.oz);
    float bz = pickDifference(triangle.p1, org, ray.kz, ray.oz);
    float cz = pickDifference(triangle.p2, org, ray.kz, ray.oz);
    float ax = pickDifference(triangle.p0, org, ray.kx, ray.ox) - ray.sx * az;
    float ay = pickDifference(triangle.p0, org, ray.ky, ray.oy) - ray.sy * az;
    float bx = pickDifference(triangle.p1, org, ray.kx, ray.ox) - ray.sx * bz;
    float by = pickDifference(triangle.p1, org, ray.ky, ray.oy) - ray.sy * bz;
    float cx = pickDifference(triangle.p2, org, ray.kx, ray.ox) - ray.sx * cz;
    float cy = pickDifference(triangle.p2, org, ray.ky, ray.oy) - ray.sy * cz;

    // Edge functions: neighbours compute the same products for a shared edge, so no ray slips through
    float u = cx * by - cy * bx;
    float v = ax * cy - ay * cx;
    float w = bx * ay - by * ax;
    if (min2(min2(u, v), w) < 0.0f && max2(max2(u, v), w) > 0.0f) return false;
    float det = (u + v) + w;
    if (det == 0.0f) return false;

    t = planeDistance(org, dir, triangle);
    if (t < 0.0f) return false;
    float inverseDet = quotient(1.0f, det);
    b1 = v * inverseDet;
    b2 = w * inverseDet;
    return true;
}
