// Lights that a surface looks for on purpose, by a shadow ray.

struct LightSample
{
    vec3 wi;         // unit direction to the light
    float distance;  // [m]; 0: the light gives nothing here
    vec3 Li;         // irradiance of a surface that faces the light, over the density of the choice
};

/// Share of a spot light's intensity that goes in a direction whose cosine with its axis is given: a
/// smooth step between the outer and the inner angle's cosine.
float spotFalloff(Light light, float cosine)
{
    if (!(cosine > light.cosOuter)) return 0.0f;
    if (cosine >= light.cosInner) return 1.0f;
    float t = quotient(cosine - light.cosOuter, light.cosInner - light.cosOuter);
    return t * t * (3.0f - t * 2.0f);
}

/// What a light gives to a point, with a density of 1.
LightSample illuminate(Light light, vec3 p)
{
    LightSample ls;
    if (light.type == LIGHT_DIRECTIONAL) {
        ls.distance = RAY_INFINITY;
        ls.wi = -light.direction;
        ls.Li = light.intensity;
        return ls;
    }
    ls.distance = 0.0f;
    ls.wi = vec3(0.0f);
    ls.Li = vec3(0.0f);
    vec3 toLight = light.position - p;
    float d2 = dot3(toLight, toLight);
    if (!(d2 > 1e-30f)) return ls;
    ls.distance = root(d2);
    ls.wi = toLight * quotient(1.0f, ls.distance);
    float share = light.type == LIGHT_SPOT ? spotFalloff(light, -dot3(ls.wi, light.direction)) : 1.0f;
    ls.Li = light.intensity * flushed(quotient(share, d2));
    return ls;
}

/// Chooses one light; all are as likely.
///   u  uniform in [0,1)
LightSample sampleLight(vec3 p, float u)
{
    float count = float(frame.lightCount);
    uint chosen = uint(u * count);
    Light light = loadLight(chosen < frame.lightCount ? chosen : frame.lightCount - 1u);
    LightSample ls = illuminate(light, p);
    ls.Li = ls.Li * count;
    return ls;
}

/// Aims the path's shadow ray from a surface at a light.
void aimShadowRay(SurfaceInteraction isect, LightSample ls, INOUT(PathState) path)
{
    path.shadowOrg = offsetOrigin(isect, ls.wi);
    path.shadowDir = ls.wi;
    path.shadowTMax = ls.distance;
    tally.shadowRays++;
}
