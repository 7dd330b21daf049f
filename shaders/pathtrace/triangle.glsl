// Watertight intersection of a ray with a triangle: Woop, Benthin and Wald 2013, "Watertight
// Ray/Triangle Intersection", JCGT 2(1), without its double precision fallback: an edge function of
// zero counts as inside, and two triangles hit at the same distance are told apart by their number.

// The ray's axes permuted and sheared so that it runs along +z.
struct ShearedRay
{
    uint kx;   // axes: kz is the one along which the ray is fastest
    uint ky;
    uint kz;
    float sx;  // shear
    float sy;
    float sz;
};

float pickAxis(vec3 v, uint axis)
{
    return axis == 0u ? v.x : (axis == 1u ? v.y : v.z);
}

ShearedRay shearRay(vec3 dir)
{
    vec3 size = absolute3(dir);
    ShearedRay ray;
    ray.kz = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
    ray.kx = ray.kz == 2u ? 0u : ray.kz + 1u;
    ray.ky = ray.kx == 2u ? 0u : ray.kx + 1u;
    ray.sz = quotient(1.0f, pickAxis(dir, ray.kz));
    ray.sx = pickAxis(dir, ray.kx) * ray.sz;
    ray.sy = pickAxis(dir, ray.ky) * ray.sz;
    return ray;
}

/// A bound on the rounding error of tHit: a hit closer than this may lie behind the origin.
/// Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", 4th ed., Sec. 6.8.7; the numbers are
/// its gamma(n) = n e / (1 - n e), e = 2^-24.
///   x, y, z  largest sizes of the sheared corners' coordinates
///   edge     largest size of the edge functions
float hitDistanceError(float x, float y, float z, float edge, float inverseDet)
{
    float dz = 1.78813967e-07f * z;
    float dx = 2.98023313e-07f * (x + z);
    float dy = 2.98023313e-07f * (y + z);
    float de = 2.0f * ((1.19209304e-07f * x * y + dy * x) + dx * y);
    return 3.0f * ((1.78813967e-07f * edge * z + de * z) + dz * edge) * absolute(inverseDet);
}

/// Finds where the ray meets the triangle's plane inside the triangle, in front of the origin.
///   t       distance [m], larger than its own rounding error; no upper end is applied
///   b1, b2  barycentric coordinates of p1 and p2
/// Returns false for a miss, a degenerate triangle and anything that is not a number.
bool intersectTriangle(vec3 org, ShearedRay ray, Triangle triangle, OUT(float) t, OUT(float) b1,
                       OUT(float) b2)
{
    t = 0.0f;
    b1 = 0.0f;
    b2 = 0.0f;

    // Corners relative to the origin, sheared
    vec3 a = triangle.p0 - org;
    vec3 b = triangle.p1 - org;
    vec3 c = triangle.p2 - org;
    float az = pickAxis(a, ray.kz);
    float bz = pickAxis(b, ray.kz);
    float cz = pickAxis(c, ray.kz);
    float ax = pickAxis(a, ray.kx) - ray.sx * az;
    float ay = pickAxis(a, ray.ky) - ray.sy * az;
    float bx = pickAxis(b, ray.kx) - ray.sx * bz;
    float by = pickAxis(b, ray.ky) - ray.sy * bz;
    float cx = pickAxis(c, ray.kx) - ray.sx * cz;
    float cy = pickAxis(c, ray.ky) - ray.sy * cz;

    // Edge functions: neighbours compute the same products for a shared edge, so no ray slips through
    float u = cx * by - cy * bx;
    float v = ax * cy - ay * cx;
    float w = bx * ay - by * ax;
    if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) return false;
    float det = (u + v) + w;
    if (det == 0.0f) return false;

    // Distance
    az = az * ray.sz;
    bz = bz * ray.sz;
    cz = cz * ray.sz;
    float inverseDet = quotient(1.0f, det);
    t = ((u * az + v * bz) + w * cz) * inverseDet;
    float sizeX = max2(max2(absolute(ax), absolute(bx)), absolute(cx));
    float sizeY = max2(max2(absolute(ay), absolute(by)), absolute(cy));
    float sizeZ = max2(max2(absolute(az), absolute(bz)), absolute(cz));
    float edge = max2(max2(absolute(u), absolute(v)), absolute(w));
    if (!(t > hitDistanceError(sizeX, sizeY, sizeZ, edge, inverseDet))) return false;

    b1 = v * inverseDet;
    b2 = w * inverseDet;
    return true;
}
