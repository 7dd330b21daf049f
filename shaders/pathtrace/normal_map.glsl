// Normal maps: textures that say, in the frame of the texture's own axes, how the shading normal leans.
//
// That frame is the surface's: red leans the normal along u, green along v, both as the picture shows them;
// blue is the shading normal as the mesh has it. Seen from behind, the same relief is seen from behind.

// The directions in which u and v grow over a surface, each of any length. u: zero where there are none.
struct UvAxes
{
    vec3 u;
    vec3 v;
};

/// A triangle's, in the space where it is stored: du * e1 = p1 - p0 and so on, solved and scaled by the
/// determinant's size, and everything before that by its largest component, so that nothing underflows.
UvAxes triangleUvAxes(READ(Primitive) triangle, READ(TriangleCorners) corners)
{
    vec3 e1 = triangle.p1 - triangle.p0;
    vec3 e2 = triangle.p2 - triangle.p0;
    vec2 d1 = vec2(corners.u1 - corners.u0, corners.v1 - corners.v0);
    vec2 d2 = vec2(corners.u2 - corners.u0, corners.v2 - corners.v0);
    float size = max2(maxComponent(absolute3(e1)), maxComponent(absolute3(e2)));
    float uvSize = max2(max2(absolute(d1.x), absolute(d1.y)), max2(absolute(d2.x), absolute(d2.y)));
    UvAxes axes;
    axes.u = vec3(0.0f);
    axes.v = vec3(0.0f);
    if (!(size > 1e-30f) || !(uvSize > 1e-30f)) return axes;
    float scale = quotient(1.0f, size);
    float uvScale = quotient(1.0f, uvSize);
    e1 = e1 * scale;
    e2 = e2 * scale;
    d1 = d1 * uvScale;
    d2 = d2 * uvScale;
    float determinant = d1.x * d2.y - d2.x * d1.y;
    if (!(absolute(determinant) > 1e-12f)) return axes;
    float side = determinant < 0.0f ? -1.0f : 1.0f;
    axes.u = (e1 * d2.y - e2 * d1.y) * side;
    axes.v = (e2 * d1.x - e1 * d2.x) * side;
    return axes;
}

/// Those of sphereUv: u along the parallels, v along the meridians towards +Y.
///   n  unit direction from the centre, in the sphere's own space
UvAxes sphereUvAxes(vec3 n)
{
    UvAxes axes;
    axes.u = vec3(n.z, 0.0f, -n.x);
    axes.v = cross3(n, axes.u);
    return axes;
}

/// The axes at a hit, in the world.
UvAxes uvAxesAt(READ(Traversal) hit, READ(SurfaceInteraction) isect)
{
    Primitive shape = loadPrimitive(hit.slot);
    bool inInstance = HAS_INSTANCES && hit.instance != NO_INSTANCE;
    vec3 p = isect.p;
    if (inInstance) p = pointToObject(loadInstance(hit.instance), p);
    UvAxes axes;
    axes.u = vec3(0.0f);
    axes.v = vec3(0.0f);
    if (HAS_SPHERES && shape.shape == SHAPE_SPHERE) {
        axes = sphereUvAxes(unit(p - shape.p0));
    } else if (shape.shape != SHAPE_FLAT) {
        axes = triangleUvAxes(shape, loadCorners(shape.shape));
    }
    if (inInstance) {
        ObjectInstance instance = loadInstance(hit.instance);
        axes.u = timesRows(instance.toWorld0, instance.toWorld1, instance.toWorld2, axes.u);
        axes.v = timesRows(instance.toWorld0, instance.toWorld1, instance.toWorld2, axes.v);
    }
    return axes;
}

/// The normal of a map at (u, v): unit, or zero where the map has none.
vec3 normalInMap(uint number, float u, float v)
{
    vec3 n = lookUpColor(number, u, v) * 2.0f - vec3(1.0f);
    float strength = loadTexture(number - 1u).strength;
    n = vec3(n.x * strength, n.y * strength, n.z);
    float n2 = dot3(n, n);
    if (!(n2 > 1e-12f)) return vec3(0.0f);
    return n * quotient(1.0f, root(n2));
}

/// A unit normal near `ns` that is on the side of ng for certain.
vec3 onSideOf(vec3 ng, vec3 ns)
{
    float cosine = dot3(ns, ng);
    return cosine < 0.01f ? unit(ns + ng * (0.01f - cosine)) : ns;
}

/// Turns the shading normal as the material's normal map has it, if there is one. The texture's
/// axes are made perpendicular to the shading normal first (Gram and Schmidt).
void bumpInteraction(READ(Material) material, READ(Traversal) hit, INOUT(SurfaceInteraction) isect)
{
    bool facets = (UNIFORM(shading) & SHADING_FLAT) != 0u;
    if (!HAS_TEXTURES || material.normalTexture == NO_TEXTURE || facets) return;
    UvAxes axes = uvAxesAt(hit, isect);
    vec3 n = isect.nsStored;
    vec3 t = axes.u - n * dot3(n, axes.u);
    float length2 = flushed(dot3(t, t));
    vec3 m = normalInMap(material.normalTexture, isect.u, isect.v);
    if (!(length2 > 1e-12f * dot3(axes.u, axes.u)) || !(dot3(m, m) > 0.0f)) return;
    t = t * quotient(1.0f, root(length2));
    vec3 b = cross3(n, t);
    if (dot3(b, axes.v) < 0.0f) b = -b;
    bool reversed = dot3(n, isect.ng) < 0.0f;
    vec3 leaning = unit((t * m.x + b * m.y) + n * m.z);
    isect.ns = onSideOf(isect.ng, reversed ? -leaning : leaning);
    isect.nsStored = reversed ? -isect.ns : isect.ns;
}
