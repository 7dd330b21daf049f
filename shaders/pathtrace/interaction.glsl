// Everything known about the point that a ray hit, and rays that leave it.

struct SurfaceInteraction
{
    vec3 p;           // hit point, from the barycentric coordinates [m]
    float pError;     // distance along ng within which p may lie beside its triangle [m]
    vec3 ng;          // unit geometric normal, on the side that the ray came from
    uint material;
    vec3 ns;          // unit shading normal, on the side of ng
};

/// Unit normal of the triangle's front, computed at a scale at which nothing under- or overflows.
/// `otherwise` for a triangle without area.
vec3 triangleNormal(Triangle triangle, vec3 otherwise)
{
    vec3 e1 = triangle.p1 - triangle.p0;
    vec3 e2 = triangle.p2 - triangle.p0;
    float size = max2(maxComponent(absolute3(e1)), maxComponent(absolute3(e2)));
    if (!(size > 0.0f)) return otherwise;
    float scale = quotient(1.0f, size);
    vec3 n = cross3(e1 * scale, e2 * scale);
    float n2 = dot3(n, n);
    if (!(n2 > 1e-30f)) return otherwise;
    return n * quotient(1.0f, root(n2));
}

/// The interaction for the closest hit of a ray with direction dir.
SurfaceInteraction interactionAt(Traversal hit, vec3 dir)
{
    Triangle triangle = loadTriangle(hit.slot);
    float b0 = (1.0f - hit.b1) - hit.b2;
    vec3 q0 = triangle.p0 * b0;
    vec3 q1 = triangle.p1 * hit.b1;
    vec3 q2 = triangle.p2 * hit.b2;

    SurfaceInteraction isect;
    isect.p = (q0 + q1) + q2;
    isect.material = triangle.material;
    vec3 ng = triangleNormal(triangle, -dir);
    bool fromBehind = dot3(ng, dir) > 0.0f;
    isect.ng = fromBehind ? -ng : ng;

    // p is within gamma(7) of the sum below on each axis, and adding an offset rounds once more:
    // less than 16 times 2^-24 in all. The largest axis counts for all, as the ray/triangle test
    // mixes axes. (pbrt, 4th ed., Sec. 6.8.4)
    vec3 sizes = (absolute3(q0) + absolute3(q1)) + absolute3(q2);
    vec3 slant = absolute3(isect.ng);
    isect.pError = 1e-6f * maxComponent(sizes) * ((slant.x + slant.y) + slant.z);

    isect.ns = isect.ng;
    if (triangle.normals != NO_NORMALS) {
        TriangleNormals normals = loadNormals(triangle.normals);
        vec3 ns = (normals.n0 * b0 + normals.n1 * hit.b1) + normals.n2 * hit.b2;
        float length2 = dot3(ns, ns);
        if (length2 > 1e-12f) {
            ns = ns * quotient(1.0f, root(length2));
            isect.ns = dot3(ns, isect.ng) < 0.0f ? -ns : ns;
        }
    }
    return isect;
}

/// Where a ray that leaves in direction wi must start so that it cannot hit its own triangle.
vec3 offsetOrigin(SurfaceInteraction isect, vec3 wi)
{
    float side = dot3(wi, isect.ng) < 0.0f ? -isect.pError : isect.pError;
    return isect.p + isect.ng * side;
}
