// The light probe: radiance that arrives from infinitely far away, looked up by direction.
// Mappings are Debevec's; d is a unit direction with +Y up.

/// Lat-long: u runs from left to right, v from the top; the picture's centre is -Z.
vec2 latLongFromDirection(vec3 d)
{
    float u = 0.5f + atan2Turns(d.x, -d.z);
    float v = 2.0f * atan2Turns(root(d.x * d.x + d.z * d.z), d.y);
    return vec2(u, v);
}

/// Angular map: the picture's centre is -Z, its rim +Z.
vec2 angularMapFromDirection(vec3 d)
{
    float sine = root(d.x * d.x + d.y * d.y);
    // The angle with -Z as a fraction of half a turn, over its sine; at the centre the limit of that
    // over 2 is taken, at the rim any direction will do.
    float r = sine > 0.0f ? quotient(atan2Turns(sine, -d.z), sine) : 0.0f;
    float right = sine > 0.0f ? d.x * r : (d.z > 0.0f ? 0.5f : 0.0f);
    return vec2(0.5f + right, 0.5f - d.y * r);
}

/// Colour and weight of texel (x, y); beside the picture of the nearest one, except that lat-long goes
/// round in x.
vec4 probeTexelAt(READ(Probe) probe, int x, int y)
{
    int width = int(probe.width);
    int height = int(probe.height);
    if (probe.mapping == PROBE_LATLONG) {
        x = x < 0 ? x + width : (x >= width ? x - width : x);
    }
    // Also for directions that are not numbers: no texel beside the picture may be read.
    x = x < 0 ? 0 : (x >= width ? width - 1 : x);
    y = y < 0 ? 0 : (y >= height ? height - 1 : y);
    return loadProbeTexel(probe.firstTexel + uint(y) * probe.width + uint(x));
}

/// A direction on its way from the world to the probe's own space.
vec3 toProbe(READ(Probe) probe, vec3 dir)
{
    return vec3(dot3(probe.axisX, dir), dot3(probe.axisY, dir), dot3(probe.axisZ, dir));
}

vec3 fromProbe(READ(Probe) probe, vec3 d)
{
    return (probe.axisX * d.x + probe.axisY * d.y) + probe.axisZ * d.z;
}

/// Radiance [W m^-2 sr^-1] and light sampling's weight of the texels that direction d, in the probe's own
/// space, meets.
vec4 lookUpProbe(READ(Probe) probe, vec3 d)
{
    if (probe.height == 0u) return vec4(0.0f);
    if (!HAS_MANY_TEXELS || (probe.width == 1u && probe.height == 1u)) return loadProbeTexel(probe.firstTexel);
    bool angular = HAS_ANGULAR && (!HAS_LATLONG || probe.mapping == PROBE_ANGULAR);
    vec2 uv = angular ? angularMapFromDirection(d)
                                                   : latLongFromDirection(d);
    float x = uv.x * float(probe.width);
    float y = uv.y * float(probe.height);
    if (probe.filterMode == FILTER_NEAREST) {
        return probeTexelAt(probe, int(floor(x)), int(floor(y)));
    }
    float left = floor(x - 0.5f);
    float top = floor(y - 0.5f);
    float fx = (x - 0.5f) - left;
    float fy = (y - 0.5f) - top;
    int ix = int(left);
    int iy = int(top);
    vec4 upper = probeTexelAt(probe, ix, iy) * (1.0f - fx) + probeTexelAt(probe, ix + 1, iy) * fx;
    vec4 lower = probeTexelAt(probe, ix, iy + 1) * (1.0f - fx) + probeTexelAt(probe, ix + 1, iy + 1) * fx;
    return upper * (1.0f - fy) + lower * fy;
}

/// Radiance from direction dir [W m^-2 sr^-1].
vec3 evalProbe(READ(Probe) probe, vec3 dir) { return vec3(lookUpProbe(probe, toProbe(probe, dir))); }
