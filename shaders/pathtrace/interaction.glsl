// Everything known about the point that a ray hit, and rays that leave it.

struct SurfaceInteraction
{
    vec3 p;           // hit point, computed on the surface rather than along the ray [m]
    float pError;     // distance along ng within which p may lie beside its surface [m]
    vec3 ng;          // unit geometric normal, on the side that the ray came from
    uint material;
    vec3 ns;          // unit shading normal, on the side of ng
    bool front;       // the ray came from the front, the outside of a closed surface
    vec3 nsStored;    // the shading normal as the mesh has it, on whichever side
    float u;          // texture coordinates, v up
    float v;
};

/// Unit normal of the triangle's front, computed at a scale at which nothing under- or overflows.
/// `otherwise` for a triangle without area.
vec3 triangleNormal(READ(Primitive) triangle, vec3 otherwise)
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

/// Fills in what follows from the point and the normal of the surface's front.
///   sizes  on each axis the size of the terms that p is the sum of, at least |p|
void completeInteraction(vec3 front, vec3 dir, vec3 sizes, INOUT(SurfaceInteraction) isect)
{
    isect.front = !(dot3(front, dir) > 0.0f);
    isect.ng = isect.front ? front : -front;
    isect.ns = isect.ng;
    isect.nsStored = front;

    // p is within gamma(7) of `sizes` on each axis, and adding an offset rounds once more: less than
    // 16 times 2^-24 in all. The largest axis counts for all, as the ray/triangle test mixes axes.
    // (Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", 4th ed., Sec. 6.8.4)
    vec3 slant = absolute3(isect.ng);
    isect.pError = 1e-6f * maxComponent(sizes) * ((slant.x + slant.y) + slant.z);
}

void triangleInteraction(READ(Primitive) triangle, READ(Traversal) hit, vec3 dir, INOUT(SurfaceInteraction) isect)
{
    float b0 = (1.0f - hit.b1) - hit.b2;
    vec3 q0 = triangle.p0 * b0;
    vec3 q1 = triangle.p1 * hit.b1;
    vec3 q2 = triangle.p2 * hit.b2;
    isect.p = (q0 + q1) + q2;
    vec3 sizes = (absolute3(q0) + absolute3(q1)) + absolute3(q2);
    completeInteraction(triangleNormal(triangle, -dir), dir, sizes, isect);
}

/// Replaces the shading normal by that between the corners' normals.
void interpolateNormal(READ(TriangleCorners) normals, READ(Traversal) hit, INOUT(SurfaceInteraction) isect)
{
    float b0 = (1.0f - hit.b1) - hit.b2;
    vec3 ns = (normals.n0 * b0 + normals.n1 * hit.b1) + normals.n2 * hit.b2;
    float length2 = dot3(ns, ns);
    if (length2 > 1e-12f) {
        ns = ns * quotient(1.0f, root(length2));
        isect.nsStored = ns;
        isect.ns = dot3(ns, isect.ng) < 0.0f ? -ns : ns;
    }
}

void sphereInteraction(READ(Primitive) sphere, READ(Traversal) hit, vec3 org, vec3 dir,
                       INOUT(SurfaceInteraction) isect)
{
    // The point along the ray is off by the distance's rounding; its direction from the centre is not.
    vec3 normal = unit((org + dir * hit.tHit) - sphere.p0);
    vec3 arm = normal * sphere.p1.x;
    isect.p = sphere.p0 + arm;
    if (HAS_TEXTURES) {
        vec2 uv = sphereUv(normal);
        isect.u = uv.x;
        isect.v = uv.y;
    }
    completeInteraction(normal, dir, absolute3(sphere.p0) + absolute3(arm), isect);
}

/// Takes an interaction with an instance's object to the world, but for its shading normal.
void placeInteraction(READ(ObjectInstance) instance, INOUT(SurfaceInteraction) isect)
{
    vec3 inside = isect.ng;
    vec3 normal = normalToWorld(instance, inside);
    float inverseLength = quotient(1.0f, root(dot3(normal, normal)));
    vec3 sizes = absolute3(isect.p);
    isect.p = pointToWorld(instance, isect.p);
    isect.ng = normal * inverseLength;
    isect.ns = isect.ng;
    isect.nsStored = isect.front ? isect.ng : -isect.ng;
    if (instance.material != NO_MATERIAL) isect.material = instance.material;

    // A ray that leaves goes through two maps before it may meet the surface again: p into the world,
    // rounded by less than 6 times 2^-24 of `reach` and of the translation, and its origin back,
    // rounded by less than 6 times 2^-24 of `back`; 16 are granted to each. The first counts along the
    // normal in the world, the second along the normal in the object's space, where a step of 1 along ng
    // is one of |normal|.
    vec3 reach = timesRows(absolute3(instance.toWorld0), absolute3(instance.toWorld1),
                           absolute3(instance.toWorld2), sizes);
    vec3 back = timesRows(absolute3(instance.toObject0), absolute3(instance.toObject1),
                          absolute3(instance.toObject2), reach);
    float errorInside = isect.pError + 1e-6f * dot3(absolute3(inside), back);
    float errorInWorld = 1e-6f * dot3(absolute3(isect.ng), reach + absolute3(instance.translation));
    isect.pError = errorInside * inverseLength + errorInWorld;
}

/// Normals at the corners of an instance's triangle: those that the triangle itself would have, were it
/// moved to the world. (Interpolated before it is moved, a normal would lean elsewhere.) None stay none.
TriangleCorners placeNormals(READ(ObjectInstance) instance, READ(TriangleCorners) normals)
{
    TriangleCorners placed = normals;
    if (HAS_TEXTURES && !(dot3(normals.n0, normals.n0) > 0.0f)) return placed;
    placed.n0 = unit(normalToWorld(instance, normals.n0));
    placed.n1 = unit(normalToWorld(instance, normals.n1));
    placed.n2 = unit(normalToWorld(instance, normals.n2));
    return placed;
}

/// The interaction with a primitive by its geometry alone, in the space where it is stored.
SurfaceInteraction geometryAt(READ(Primitive) shape, READ(Traversal) hit, vec3 org, vec3 dir)
{
    SurfaceInteraction isect;
    isect.material = shape.material;
    isect.u = 0.0f;
    isect.v = 0.0f;
    if (HAS_SPHERES && shape.shape == SHAPE_SPHERE) {
        sphereInteraction(shape, hit, org, dir, isect);
    } else {
        triangleInteraction(shape, hit, dir, isect);
    }
    return isect;
}

/// Whether there is something in a triangle's corners that counts.
bool hasCorners(READ(Primitive) shape)
{
    bool facets = (UNIFORM(shading) & SHADING_FLAT) != 0u;
    return shape.shape != SHAPE_SPHERE && shape.shape != SHAPE_FLAT && (HAS_TEXTURES || !facets);
}

/// What lies between the corners: the normal, and texture coordinates.
void interpolateCorners(READ(TriangleCorners) corners, READ(Traversal) hit, INOUT(SurfaceInteraction) isect)
{
    if (HAS_TEXTURES) {
        vec2 uv = cornersUv(corners, hit.b1, hit.b2);
        isect.u = uv.x;
        isect.v = uv.y;
        if ((UNIFORM(shading) & SHADING_FLAT) != 0u) return;
    }
    interpolateNormal(corners, hit, isect);
}

SurfaceInteraction interactionInInstance(READ(Primitive) shape, READ(Traversal) hit, vec3 org, vec3 dir)
{
    ObjectInstance instance = loadInstance(hit.instance);
    SurfaceInteraction isect = geometryAt(shape, hit, pointToObject(instance, org),
                                          directionToObject(instance, dir));
    placeInteraction(instance, isect);
    if (hasCorners(shape)) {
        interpolateCorners(placeNormals(instance, loadCorners(shape.shape)), hit, isect);
    }
    return isect;
}

/// The interaction for the closest hit of a ray.
SurfaceInteraction interactionAt(READ(Traversal) hit, vec3 org, vec3 dir)
{
    Primitive shape = loadPrimitive(hit.slot);
    if (HAS_INSTANCES && hit.instance != NO_INSTANCE) {
        return interactionInInstance(shape, hit, org, dir);
    }
    SurfaceInteraction isect = geometryAt(shape, hit, org, dir);
    if (hasCorners(shape)) interpolateCorners(loadCorners(shape.shape), hit, isect);
    return isect;
}

/// The normal for mirror directions: the shading normal, where it faces the ray as it should.
vec3 mirrorNormal(READ(SurfaceInteraction) isect, vec3 dir)
{
    return dot3(isect.ns, dir) < 0.0f ? isect.ns : isect.ng;
}

/// Where a ray that leaves in direction wi must start so that it cannot hit its own surface.
vec3 offsetOrigin(READ(SurfaceInteraction) isect, vec3 wi)
{
    float side = dot3(wi, isect.ng) < 0.0f ? -isect.pError : isect.pError;
    return isect.p + isect.ng * side;
}
