// Lights that a surface looks for on purpose, by a shadow ray.

struct LightSample
{
    vec3 wi;         // unit direction to the light
    float distance;  // [m]; 0: the light gives nothing here
    vec3 Li;         // what arrives, divided by the density of the choice
};

/// Chooses one light and a point on it.
///   u  uniform in [0,1)
LightSample sampleLight(vec3 p, float u)
{
    float count = float(frame.lightCount);
    uint chosen = uint(u * count);
    Light light = loadLight(chosen < frame.lightCount ? chosen : frame.lightCount - 1u);
    vec3 toLight = light.position - p;
    float d2 = dot3(toLight, toLight);
    LightSample ls;
    ls.distance = 0.0f;
    ls.wi = vec3(0.0f);
    ls.Li = vec3(0.0f);
    if (d2 > 1e-30f) {
        ls.distance = root(d2);
        ls.wi = toLight * quotient(1.0f, ls.distance);
        ls.Li = light.intensity * quotient(count, d2);
    }
    return ls;
}
