// Lobes, of which materials are made: what a sample of one is, and what all of them share.

CONST uint LOBE_NONE = 0u;      // nothing was sampled, the path ends
CONST uint LOBE_DIFFUSE = 1u;
CONST uint LOBE_REFLECT = 2u;   // a mirror direction: no other sampling can find it
CONST uint LOBE_TRANSMIT = 3u;  // through the surface, likewise
CONST uint LOBE_GLOSSY_REFLECT = 4u;   // by a rough surface
CONST uint LOBE_GLOSSY_TRANSMIT = 5u;

struct BsdfSample
{
    vec3 wi;          // unit direction to the light
    uint lobe;        // one of LOBE_*
    vec3 weight;      // f * cosine / density
    float pdf;        // density of wi [1/sr]; 0: not by density, a delta lobe
    float mediumEta;  // index of refraction where wi goes, by the report's rule
    float etaScale;   // what refraction has divided radiance by: the square of the relative index
};

/// Of all lobes but delta lobes together.
struct BsdfValue
{
    vec3 f;     // BSDF times the cosine of wi with the normal [1/sr]
    float pdf;  // density with which wi is sampled, the choice of a lobe included [1/sr]
};

BsdfValue noBsdf()
{
    BsdfValue value;
    value.f = vec3(0.0f);
    value.pdf = 0.0f;
    return value;
}

bool isDeltaLobe(uint lobe) { return lobe == LOBE_REFLECT || lobe == LOBE_TRANSMIT; }

/// Whether light from wi is on the side of the geometric surface that wo is on.
bool onViewersSide(READ(SurfaceInteraction) isect, vec3 wo, vec3 wi)
{
    return dot3(wo, isect.ng) >= 0.0f && dot3(wi, isect.ng) > 0.0f;
}

/// Whether a reflected direction leaves on the viewer's side, by the geometric normal and by n, which an
/// interpolated normal may tell apart.
bool staysAbove(READ(SurfaceInteraction) isect, vec3 n, vec3 wi)
{
    return dot3(wi, n) > 0.0f && dot3(wi, isect.ng) > 0.0f;
}

bool goesBelow(READ(SurfaceInteraction) isect, vec3 n, vec3 wi)
{
    return dot3(wi, n) < 0.0f && dot3(wi, isect.ng) < 0.0f;
}

/// Makes wi the sample of a lobe of finite density, from the value of all of these.
void takeSample(READ(BsdfValue) value, vec3 wi, uint lobe, INOUT(BsdfSample) bs)
{
    if (!(value.pdf > 0.0f)) return;
    bs.wi = wi;
    bs.lobe = lobe;
    bs.pdf = value.pdf;
    bs.weight = value.f * quotient(1.0f, value.pdf);
}
