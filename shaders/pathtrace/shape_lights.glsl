// Triangles and spheres that shine: points on them to look for, and the density of finding them so.
//
// A light's weight is the luminance of its emission, where that is a picture of the picture's mean, times
// its area in the world. So all shapes are sampled with a density per area that follows from their material
// alone: `perArea`, luminance times frame.lightPerPower [m^-2]. Where a path runs into a shape, the density
// is known without asking which light that is.

// A point on a light, as seen from the origin of a ray.
struct ShapeSample
{
    vec3 wi;         // unit direction to it
    float distance;  // at which a ray for it must end, lest the light itself block it [m]; 0: not seen
    float pdf;       // density of wi [1/sr]
    float u;         // texture coordinates of the point
    float v;
};

// A ray in the space of the primitive that it may meet.
struct ObjectRay
{
    vec3 org;
    vec3 dir;       // not unit: distances along it are those in the world
    float stretch;  // square root of the mean square by which the way to the object stretches directions
};

float squaredLength(vec3 v) { return dot3(v, v); }

ObjectRay objectRayOf(uint instanceIndex, vec3 org, vec3 dir)
{
    ObjectRay ray = {org, dir, 1.0f};
    if (HAS_INSTANCES && instanceIndex != NO_INSTANCE) {
        ObjectInstance instance = loadInstance(instanceIndex);
        ray.org = pointToObject(instance, org);
        ray.dir = directionToObject(instance, dir);
        float sum = squaredLength(instance.toObject0) + squaredLength(instance.toObject1);
        ray.stretch = root((sum + squaredLength(instance.toObject2)) * 0.333333343f);
    }
    return ray;
}

vec3 worldPointOf(uint instanceIndex, vec3 q)
{
    if (!HAS_INSTANCES || instanceIndex == NO_INSTANCE) return q;
    return pointToWorld(loadInstance(instanceIndex), q);
}

/// Density of a direction to a point at `distance`, of points sampled with density 1 on a surface that
/// stands at an angle of the given cosine [m^2/sr].
float areaToSolidAngle(float distance, float cosine)
{
    return quotient(distance * distance, max2(cosine, 1e-20f));
}

/// From here on a sphere is sampled by the solid angle that it fills. Nearer, and inside, all of its
/// surface is: there the cone that it fills says less about what a surface receives.
bool isFarFrom(READ(Primitive) sphere, vec3 fromCentre)
{
    return dot3(fromCentre, fromCentre) > 1.0001f * (sphere.p1.x * sphere.p1.x);
}

/// Density of a direction within the cone that a sphere fills [1/sr]: the chance of the sphere, perArea 4 pi
/// r^2, over the solid angle of the cone, 2 pi (1 - cosine). As r^2 = d^2 (1 - cosine^2), r cancels.
///   d2      squared distance of its centre
///   cosine  of half the cone's angle
float pdfSphereCone(float perArea, float d2, float cosine)
{
    return perArea * (2.0f * d2 * (1.0f + cosine));
}

float sphereConeCosine(READ(Primitive) sphere, float d2)
{
    return root(max2(0.0f, 1.0f - quotient(sphere.p1.x * sphere.p1.x, d2)));
}

/// Density of the direction of a ray that meets a sphere first at distance t, if points are sampled all over
/// the sphere, those on its far side included [1/sr].
///
/// An instance may make an ellipsoid of the sphere. Points are uniform on the sphere still, which the map
/// p = M q spreads over areas |det M| |M^-T n| times as large. Its weight is taken to be that of an area of
/// 4 pi r^2 |det M| s with s, the ray's stretch, the root of the mean square of |M^-T n|: so |det M| cancels.
float pdfSphereSurface(float perArea, READ(Primitive) sphere, READ(ObjectRay) ray, float t)
{
    vec3 f = ray.org - sphere.p0;
    float a = dot3(ray.dir, ray.dir);
    float c = dot3(f, f) - sphere.p1.x * sphere.p1.x;
    float cosine = quotient(absolute(dot3(f + ray.dir * t, ray.dir)), sphere.p1.x);
    float nearSide = areaToSolidAngle(t, cosine);
    if (!(c > 0.0f)) return perArea * (ray.stretch * nearSide);
    float farSide = areaToSolidAngle(quotient(c, max2(a * t, 1e-20f)), cosine);
    return perArea * (ray.stretch * (nearSide + farSide));
}

/// Density with which light sampling takes the direction of a ray that met a sphere [1/sr].
float pdfSphereLight(float perArea, READ(Primitive) sphere, uint instance, vec3 org, vec3 dir, float t)
{
    bool placed = HAS_INSTANCES && instance != NO_INSTANCE;
    vec3 f = org - sphere.p0;
    if (!placed && isFarFrom(sphere, f)) {
        float d2 = dot3(f, f);
        return pdfSphereCone(perArea, d2, sphereConeCosine(sphere, d2));
    }
    return pdfSphereSurface(perArea, sphere, objectRayOf(instance, org, dir), t);
}

/// Density per area with which shapes of a material are sampled, where the alias table is [m^-2].
///   material  as it is stored
float lightPerArea(READ(Material) material)
{
    vec3 emission = material.emission;
    if (HAS_TEXTURES && material.emissionTexture != NO_TEXTURE) {
        emission = emission * loadTexture(material.emissionTexture - 1u).mean;
    }
    return flushed(luminance(emission) * UNIFORM(lightPerPower));
}

/// Density with which light sampling takes the direction of a ray that met a shape [1/sr].
///   chance  of the alias table
float pdfShapeLight(float chance, READ(Traversal) hit, READ(SurfaceInteraction) isect, vec3 org, vec3 dir)
{
    float perArea = lightPerArea(loadMaterial(isect.material)) * chance;
    if (!(perArea > 0.0f)) return 0.0f;
    Primitive shape = loadPrimitive(hit.slot);
    if (HAS_SPHERES && shape.shape == SHAPE_SPHERE) {
        return flushed(pdfSphereLight(perArea, shape, hit.instance, org, dir, hit.tHit));
    }
    return flushed(perArea * areaToSolidAngle(hit.tHit, absolute(dot3(isect.ng, dir))));
}

/// How far a shadow ray to a light may go: a little less than where the light itself would stop it, which
/// traversal finds to be at `met` or behind it.
float shadowDistance(float met) { return met * 0.999999046f; }

ShapeSample nothingSeen()
{
    ShapeSample ss = {vec3(0.0f), 0.0f, 0.0f, 0.0f, 0.0f};
    return ss;
}

/// Aims at a point q of a light. Returns the distance to it along a ray that starts at `org`, or 0 where
/// there is no direction to it.
float aimAtPoint(READ(SurfaceInteraction) isect, vec3 q, OUT(vec3) org, OUT(vec3) wi)
{
    org = offsetOrigin(isect, q - isect.p);
    wi = vec3(0.0f);
    vec3 way = q - org;
    float d2 = dot3(way, way);
    if (!(d2 > 1e-30f)) return 0.0f;
    float distance = root(d2);
    wi = way * quotient(1.0f, distance);
    // A direction within rounding of the surface itself, so that the ray would start on its other side
    vec3 start = offsetOrigin(isect, wi);
    return start.x == org.x && start.y == org.y && start.z == org.z ? distance : 0.0f;
}

/// The triangle with its corners in the world.
Primitive placedTriangle(READ(Primitive) triangle, uint instance)
{
    Primitive placed = triangle;
    placed.p0 = worldPointOf(instance, triangle.p0);
    placed.p1 = worldPointOf(instance, triangle.p1);
    placed.p2 = worldPointOf(instance, triangle.p2);
    return placed;
}

/// A point of a triangle, all as likely.
///   material  of the instance, or NO_MATERIAL
///   u1, u2    uniform in [0,1)
ShapeSample sampleTriangleLight(float perArea, READ(Primitive) triangle, uint instance, uint material,
                                READ(SurfaceInteraction) isect, float u1, float u2)
{
    Primitive placed = placedTriangle(triangle, instance);
    float side = root(u1);
    float b2 = side * u2;
    float b1 = side - b2;
    vec3 q = (placed.p0 * (1.0f - side) + placed.p1 * b1) + placed.p2 * b2;
    vec3 org;
    ShapeSample ss = nothingSeen();
    float distance = aimAtPoint(isect, q, org, ss.wi);
    if (!(distance > 0.0f) || (HAS_CUTOUTS && isCutOut(triangle, material, b1, b2))) return ss;
    if (HAS_TEXTURES) {
        vec2 uv = triangleUv(triangle, b1, b2);
        ss.u = uv.x;
        ss.v = uv.y;
    }
    float cosine = absolute(dot3(triangleNormal(placed, vec3(0.0f)), ss.wi));
    ss.pdf = flushed(perArea * areaToSolidAngle(distance, cosine));

    // What traversal will find the distance of this triangle's plane to be, if it meets the triangle
    ObjectRay ray = objectRayOf(instance, org, ss.wi);
    float met = planeDistance(ray.org, ray.dir, triangle);
    ss.distance = shadowDistance(met > 0.0f ? min2(met, distance) : distance);
    return ss;
}

/// Texture coordinates of the point of a sphere that a ray meets at distance t.
void lookUpSphere(READ(Primitive) sphere, READ(ObjectRay) ray, float t, INOUT(ShapeSample) ss)
{
    if (!HAS_TEXTURES) return;
    vec2 uv = sphereUv(unit((ray.org + ray.dir * t) - sphere.p0));
    ss.u = uv.x;
    ss.v = uv.y;
}

/// A direction within the cone that a sphere fills, all as likely.
///   u1, u2  uniform in [0,1)
ShapeSample sampleSphereCone(float perArea, READ(Primitive) sphere, READ(SurfaceInteraction) isect, vec3 from, float u1,
                             float u2)
{
    vec3 toCentre = sphere.p0 - from;
    float d2 = dot3(toCentre, toCentre);
    float cosineMax = sphereConeCosine(sphere, d2);
    // 1 - cosine rather than the cosine: nothing cancels when the sphere is small
    float away = u1 * quotient(quotient(sphere.p1.x * sphere.p1.x, d2), 1.0f + cosineMax);
    float sine = root(max2(0.0f, away * (2.0f - away)));
    float sinPhi;
    float cosPhi;
    sinCosTurns(u2, sinPhi, cosPhi);
    vec3 axis = toCentre * quotient(1.0f, root(d2));
    vec3 t;
    vec3 b;
    tangentFrame(axis, t, b);
    ShapeSample ss = nothingSeen();
    ss.wi = unit((t * (sine * cosPhi) + b * (sine * sinPhi)) + axis * (1.0f - away));
    vec3 org = offsetOrigin(isect, ss.wi);
    float met;
    bool meets = intersectSphere(org, ss.wi, sphere.p0, sphere.p1.x, met);
    // By rounding a ray may pass the rim: then nothing of the sphere is in its way
    if (!meets) met = dot3(sphere.p0 - org, ss.wi);
    if (!(met > 0.0f)) return ss;
    lookUpSphere(sphere, objectRayOf(NO_INSTANCE, org, ss.wi), met, ss);
    ss.distance = shadowDistance(met);
    ss.pdf = flushed(pdfSphereLight(perArea, sphere, NO_INSTANCE, org, ss.wi, met));
    return ss;
}

/// A point of a sphere, all as likely. What is seen is the side of the sphere that its direction meets
/// first, which the density takes into account.
///   u1, u2  uniform in [0,1)
ShapeSample sampleSphereSurface(float perArea, READ(Primitive) sphere, uint instance, READ(SurfaceInteraction) isect,
                                float u1, float u2)
{
    float height = (1.0f - u1) - u1;
    float ring = root(max2(0.0f, 1.0f - height * height));
    float sinPhi;
    float cosPhi;
    sinCosTurns(u2, sinPhi, cosPhi);
    vec3 n = vec3(ring * cosPhi, ring * sinPhi, height);
    vec3 org;
    ShapeSample ss = nothingSeen();
    float distance = aimAtPoint(isect, worldPointOf(instance, sphere.p0 + n * sphere.p1.x), org, ss.wi);
    if (!(distance > 0.0f)) return ss;
    ObjectRay ray = objectRayOf(instance, org, ss.wi);
    float met;
    if (!intersectSphere(ray.org, ray.dir, sphere.p0, sphere.p1.x, met)) return ss;
    lookUpSphere(sphere, ray, met, ss);
    ss.distance = shadowDistance(met);
    ss.pdf = flushed(pdfSphereLight(perArea, sphere, instance, org, ss.wi, met));
    return ss;
}

ShapeSample sampleSphereLight(float perArea, READ(Primitive) sphere, uint instance, READ(SurfaceInteraction) isect,
                              float u1, float u2)
{
    bool placed = HAS_INSTANCES && instance != NO_INSTANCE;
    vec3 from = offsetOrigin(isect, sphere.p0 - isect.p);
    if (!placed && isFarFrom(sphere, from - sphere.p0)) {
        return sampleSphereCone(perArea, sphere, isect, from, u1, u2);
    }
    return sampleSphereSurface(perArea, sphere, instance, isect, u1, u2);
}
