// Directions to the light probe, by how bright it is there. A texel is chosen by an alias table, then a
// point about it such that the density is what looking up the texels' weights would give: constant on a
// texel, or interpolated between them. So the density is known exactly, wherever a path looks.

/// The direction whose latLongFromDirection is (u, v).
vec3 directionFromLatLong(float u, float v)
{
    float sinU;
    float cosU;
    float sinV;
    float cosV;
    sinCosTurns(u, sinU, cosU);
    sinCosTurns(v * 0.5f, sinV, cosV);
    return vec3(-sinV * sinU, cosV, sinV * cosU);
}

/// The direction whose angularMapFromDirection is (u, v). Points beyond the rim stand for none: false.
bool directionFromAngularMap(float u, float v, OUT(vec3) d)
{
    float right = u - 0.5f;
    float up = 0.5f - v;
    float r = root(right * right + up * up);
    d = vec3(0.0f);
    if (!(r < 0.5f)) return false;
    float sine;
    float cosine;
    sinCosTurns(r, sine, cosine);
    float scale = r > 1e-10f ? quotient(sine, r) : 6.28318531f;
    d = vec3(right * scale, up * scale, -cosine);
    return true;
}

/// Solid angle that an area of the picture stands for, about direction d [sr]. Where that vanishes, at
/// poles and at the rim, it is a very small number instead.
///   d  unit direction in the probe's own space
float probeSolidAngle(READ(Probe) probe, vec3 d)
{
    float solidAngle;
    if (HAS_ANGULAR && (!HAS_LATLONG || probe.mapping == PROBE_ANGULAR)) {
        float sine = root(d.x * d.x + d.y * d.y);
        float turns = atan2Turns(sine, -d.z);
        bool central = d.z < 0.0f && !(sine > 1e-10f);
        solidAngle = central ? 39.4784176f : 6.28318531f * quotient(sine, max2(turns, 1e-12f));
    } else {
        solidAngle = 19.7392088f * root(d.x * d.x + d.z * d.z);
    }
    return max2(solidAngle, 1e-10f);
}

/// Density with which light sampling takes a direction [1/sr].
///   chance  of the probe
///   d       unit direction in the probe's own space
///   weight  of the texels there, looked up like their colour
float pdfProbe(float chance, vec3 d, float weight)
{
    if (!HAS_PROBE_LIGHT || !(chance > 0.0f)) return 0.0f;
    return flushed(chance * quotient(weight, probeSolidAngle(sceneProbe(), d)));
}

/// Place of a point about the middle of texel i, in a row of texels: anywhere within the texel, or
/// distributed as linear interpolation falls off to the middles of its neighbours.
///   u  uniform in [0,1)
float placeAboutTexel(uint i, uint filterMode, float u)
{
    if (filterMode == FILTER_NEAREST) return float(i) + u;
    float away = u < 0.5f ? root(u + u) - 1.0f : 1.0f - root(2.0f - (u + u));
    return (float(i) + 0.5f) + away;
}

/// Where lookup clamps, what would lie beyond a border counts for the border's texels: reflected there.
float reflectedPlace(float x, float size)
{
    if (x < 0.0f) return -x;
    return x > size ? (size + size) - x : x;
}

float wrappedPlace(float x, float size)
{
    if (x < 0.0f) return x + size;
    return x > size ? x - size : x;
}

/// Chooses a direction in the probe's own space; false where none comes of it.
///   bits, finer  see chooseByAlias
///   u1, u2       uniform in [0,1)
bool sampleProbe(uint bits, uint finer, float u1, float u2, OUT(vec3) d)
{
    uint width = UNIFORM(probe.width);
    uint height = UNIFORM(probe.height);
    uint texel = chooseByAlias(UNIFORM(choiceCount), width * height, bits, finer);
    uint row = texel / width;
    float w = float(width);
    float h = float(height);
    float x = placeAboutTexel(texel - row * width, UNIFORM(probe.filterMode), u1);
    float y = placeAboutTexel(row, UNIFORM(probe.filterMode), u2);
    float v = quotient(reflectedPlace(y, h), h);
    if (HAS_ANGULAR && (!HAS_LATLONG || UNIFORM(probe.mapping) == PROBE_ANGULAR)) {
        return directionFromAngularMap(quotient(reflectedPlace(x, w), w), v, d);
    }
    d = directionFromLatLong(quotient(wrappedPlace(x, w), w), v);
    return true;
}
