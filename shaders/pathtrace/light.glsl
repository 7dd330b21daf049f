// Lights that a surface looks for on purpose, by a shadow ray.

struct LightSample
{
    vec3 wi;         // unit direction to the light
    float distance;  // that a shadow ray must go unblocked [m]; 0: the light gives nothing here
    vec3 Li;         // what arrives, over the density of the choice and of wi: of point, spot and
                     // directional lights the irradiance of a surface that faces them, else radiance
    float pdf;       // that density [1/sr]; 0: nothing else can find the light
};

LightSample noLight()
{
    LightSample ls;
    ls.wi = vec3(0.0f);
    ls.distance = 0.0f;
    ls.Li = vec3(0.0f);
    ls.pdf = 0.0f;
    return ls;
}

/// Share of a spot light's intensity that goes in a direction whose cosine with its axis is given: a
/// smooth step between the outer and the inner angle's cosine.
float spotFalloff(READ(Light) light, float cosine)
{
    if (!(cosine > light.cosOuter)) return 0.0f;
    if (cosine >= light.cosInner) return 1.0f;
    float t = quotient(cosine - light.cosOuter, light.cosInner - light.cosOuter);
    return t * t * (3.0f - t * 2.0f);
}

/// What a light gives to a point, with a density of 1.
LightSample illuminate(READ(Light) light, vec3 p)
{
    LightSample ls = noLight();
    if (light.type == LIGHT_DIRECTIONAL) {
        ls.distance = RAY_INFINITY;
        ls.wi = -light.direction;
        ls.Li = light.intensity;
        return ls;
    }
    vec3 toLight = light.position - p;
    float d2 = dot3(toLight, toLight);
    if (!(d2 > 1e-30f)) return ls;
    ls.distance = root(d2);
    ls.wi = toLight * quotient(1.0f, ls.distance);
    float share = light.type == LIGHT_SPOT ? spotFalloff(light, -dot3(ls.wi, light.direction)) : 1.0f;
    ls.Li = light.intensity * flushed(quotient(share, d2));
    return ls;
}

/// Li and pdf of a direction whose density is known: none where that is too small or too large a number.
LightSample withRadiance(vec3 wi, float distance, vec3 radiance, float pdf)
{
    LightSample ls = noLight();
    if (!(pdf > 0.0f) || !(pdf < 1e30f)) return ls;
    ls.wi = wi;
    ls.distance = distance;
    ls.Li = flushed3(radiance * quotient(1.0f, pdf));
    ls.pdf = pdf;
    return ls;
}

/// A point on a shape that shines.
///   chance  of the alias table
LightSample sampleShapeLight(float chance, READ(Light) light, READ(SurfaceInteraction) isect, float u1, float u2)
{
    Primitive shape = loadPrimitive(light.slot);
    uint ofInstance = NO_MATERIAL;
    if (HAS_INSTANCES && light.instance != NO_INSTANCE) ofInstance = loadInstance(light.instance).material;
    Material material = loadMaterial(ofInstance != NO_MATERIAL ? ofInstance : shape.material);
    float perArea = lightPerArea(material) * chance;
    ShapeSample ss;
    if (HAS_SPHERES && light.type == LIGHT_SPHERE) {
        ss = sampleSphereLight(perArea, shape, light.instance, isect, u1, u2);
    } else {
        ss = sampleTriangleLight(perArea, shape, light.instance, ofInstance, isect, u1, u2);
    }
    return withRadiance(ss.wi, ss.distance, emittedAt(material, ss.u, ss.v), ss.pdf);
}

LightSample sampleProbeLight(float chance, uint bits, uint finer, float u1, float u2)
{
    vec3 d;
    if (!sampleProbe(bits, finer, u1, u2, d)) return noLight();
    // Looked up as for any other ray, so that the density is that of the direction as it came out
    vec3 dir = unit(fromProbe(sceneProbe(), d));
    vec3 seen = toProbe(sceneProbe(), dir);
    vec4 texel = lookUpProbe(sceneProbe(), seen);
    return withRadiance(dir, RAY_INFINITY, vec3(texel), pdfProbe(chance, seen, texel.w));
}

/// Samples a direction to what was chosen.
///   bits  uniform: which light of the alias table or texel of the probe, and where on it
LightSample sampleLight(READ(SurfaceInteraction) isect, READ(LightChoice) choice, uvec4 bits)
{
    if (choice.light == TAKE_NOTHING) return noLight();
    float u1 = unitFloat(bits.y);
    float u2 = unitFloat(bits.z);
    uint finer = ((bits.y & 255u) | ((bits.z & 255u) << 8u)) | ((bits.w & 255u) << 16u);
    if (HAS_PROBE_LIGHT && choice.light == TAKE_PROBE) {
        return sampleProbeLight(choice.chance, bits.x, finer, u1, u2);
    }
    if (!HAS_FAR_LIGHTS && !HAS_SHAPE_LIGHTS) return noLight();
    uint index = choice.light;
    float chance = choice.chance;
    if (choice.light == TAKE_TABLE) {
        index = UNIFORM(singleCount) + chooseByAlias(0u, UNIFORM(choiceCount), bits.x, finer);
    }
    Light light = loadLight(index);
    if (HAS_SHAPE_LIGHTS && (!HAS_FAR_LIGHTS || light.type >= LIGHT_TRIANGLE)) {
        return sampleShapeLight(chance, light, isect, u1, u2);
    }
    if (choice.light == TAKE_TABLE) chance = chance * light.chance;
    LightSample ls = illuminate(light, isect.p);
    ls.Li = flushed3(ls.Li * quotient(1.0f, chance));
    return ls;
}

/// Weight of what was found by one of two ways of sampling, by the power heuristic: Veach 1997, "Robust
/// Monte Carlo Methods for Light Transport Simulation", Sec. 9.2.4, with an exponent of 2.
///   pdf    density of the way that found it
///   other  density with which the other would have
float powerHeuristic(float pdf, float other)
{
    if (!(other > 0.0f)) return 1.0f;
    float ratio = quotient(other, pdf);
    return ratio > 1e9f ? 0.0f : quotient(1.0f, 1.0f + ratio * ratio);
}

/// Weight of light that light sampling found. No scattering finds lights with a pdf of 0.
float weightOfLightSample(float pdfLight, float pdfScattering)
{
    if (!(pdfLight > 0.0f) || UNIFORM(lightSampling) == LIGHTS_ONLY) return 1.0f;
    return powerHeuristic(pdfLight, pdfScattering);
}

/// Weight of light that a scattered ray ran into. Light sampling finds nothing for rays with a pdf of 0.
float weightOfScattering(float pdfScattering, float pdfLight)
{
    if (!(pdfScattering > 0.0f) || !(pdfLight > 0.0f)) return 1.0f;
    return UNIFORM(lightSampling) == LIGHTS_ONLY ? 0.0f : powerHeuristic(pdfScattering, pdfLight);
}

/// Aims the path's shadow ray from a surface at a light.
void aimShadowRay(READ(SurfaceInteraction) isect, READ(LightSample) ls, INOUT(PathState) path)
{
    path.shadowOrg = offsetOrigin(isect, ls.wi);
    path.shadowDir = ls.wi;
    path.shadowTMax = ls.distance;
    tally.shadowRays++;
}
