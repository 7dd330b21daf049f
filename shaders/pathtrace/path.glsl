// A path as a sequence of steps on a PathState: begin, extend, shade, shadow; and the loop over them.
// A megakernel, a wavefront of queues and the CPU reference call these same steps.

CONST uint DIGEST_SHADOW = 16u;  // kinds of events; DIGEST_HIT + lobe for what a ray met
CONST uint DIGEST_HIT = 32u;

/// One event of a path as a number. `sahl verify` compares the sums of these.
uint digestOf(uint what, uint detail, uint depth, uint kind)
{
    return hash4(what, detail, depth, kind).x;
}

/// Starts sample `sampleIndex` of pixel (x, y): a ray through a random point of the pixel.
PathState beginPath(uint x, uint y, uint sampleIndex)
{
    PathState path;
    path.pixel = y * UNIFORM(width) + x;
    path.sampleIndex = sampleIndex;
    vec4 u = random4(path.pixel, sampleIndex, DIMENSION_CAMERA);
    float dx = UNIFORM(jitter) != 0u ? u.x : 0.5f;
    float dy = UNIFORM(jitter) != 0u ? u.y : 0.5f;
    Ray ray = cameraRay(float(x) + dx, float(y) + dy, u.z, u.w);
    path.org = ray.org;
    path.dir = ray.dir;
    path.phase = PHASE_EXTEND;
    path.depth = 0u;
    path.beta = vec3(1.0f);
    path.L = vec3(0.0f);
    path.shadowOrg = vec3(0.0f);
    path.shadowTMax = 0.0f;
    path.shadowDir = vec3(0.0f);
    path.Ld = vec3(0.0f);
    path.digest = 0u;
    path.mediumEta = 1.0f;
    path.pdf = 0.0f;
    path.etaScale = 1.0f;
    path.probeChance = 0.0f;
    path.tableChance = 0.0f;
    path.hit = beginTraversal(RAY_INFINITY);
    return path;
}

bool inShadowPhase(READ(PathState) path)
{
    return path.phase == PHASE_SHADOW || path.phase == PHASE_LAST_SHADOW;
}

/// Whether the path's ray is its last one and can see the environment only: then it does not matter what it meets. (Rays of
/// the camera are left out: what they meet is counted and compared.)
bool seesTheEnvironmentOrNothing(READ(PathState) path)
{
    return HAS_PATHS && path.phase == PHASE_EXTEND && path.depth != 0u && path.depth >= UNIFORM(maxBounces) &&
           (UNIFORM(shading) & SHADING_DARK) != 0u && UNIFORM(integrator) == INTEGRATOR_PATH;
}

/// The walk that the path's phase asks for.
Traversal beginPathTraversal(READ(PathState) path)
{
    return beginTraversal(inShadowPhase(path) ? path.shadowTMax : RAY_INFINITY);
}

/// Prepares a shadow ray to one light; its arrival will add path.Ld. Returns whether there is one.
///   dimension  of the vertex
///   u          uniform in [0,1)
bool sampleDirectLight(READ(Material) material, READ(SurfaceInteraction) isect, uint dimension, float u,
                       INOUT(PathState) path)
{
    if (!HAS_FAR_LIGHTS && !HAS_SHAPE_LIGHTS && !HAS_PROBE_LIGHT) return false;
    if (!anyLightIsSampled() || isSpecular(material)) return false;
    float carried = maxComponent(path.beta) * path.etaScale;
    LightChoice choice = chooseLight(isect, scattersThrough(material), carried, u);
    path.probeChance = choice.probeChance;
    path.tableChance = choice.tableChance;
    uvec4 bits = randomBits4(path.pixel, path.sampleIndex, dimension + DIMENSION_LIGHT);
    LightSample ls = sampleLight(isect, choice, bits);
    if (!(ls.distance > 0.0f)) return false;
    BsdfValue bsdf = evalBsdf(material, isect, -path.dir, ls.wi);
    float weight = weightOfLightSample(ls.pdf, bsdf.pdf);
    path.Ld = flushed3(flushed3(path.beta * flushed3(bsdf.f) * ls.Li) * weight);
    if (!(maxComponent(path.Ld) > 0.0f)) return false;
    aimShadowRay(isect, ls, path);
    return true;
}

/// Chooses the path's next direction and returns the lobe; LOBE_NONE when the path ends.
///   dimension  of the vertex
///   u          its numbers for the BSDF
uint sampleNextRay(READ(Material) material, READ(SurfaceInteraction) isect, uint dimension, vec4 u,
                   INOUT(PathState) path)
{
    BsdfSample bs = sampleBsdf(material, isect, path.dir, path.mediumEta, u);
    path.beta = flushed3(path.beta * bs.weight);
    if (bs.lobe == LOBE_NONE || !(maxComponent(path.beta) > 0.0f)) return LOBE_NONE;
    path.org = offsetOrigin(isect, bs.wi);
    path.dir = bs.wi;
    path.mediumEta = bs.mediumEta;
    path.pdf = bs.pdf;
    path.etaScale = path.etaScale * bs.etaScale;
    if (!survivesRoulette(dimension, path)) return LOBE_NONE;
    tally.indirectRays++;
    return bs.lobe;
}

/// Light that a path sees where its ray meets nothing.
void seeEnvironment(INOUT(PathState) path)
{
    Probe probe = sceneProbe();
    if (path.depth == 0u) probe = backgroundProbe();
    vec3 d = toProbe(probe, path.dir);
    vec4 texel = lookUpProbe(probe, d);
    float weight = weightOfScattering(path.pdf, pdfProbe(path.probeChance, d, texel.w));
    gather(path.beta * vec3(texel) * weight, path.depth, path);
    path.phase = PHASE_ENDED;
}

/// Light that a path sees where its ray meets a surface.
void seeEmission(READ(SurfaceInteraction) isect, READ(Material) material, READ(Traversal) hit, INOUT(PathState) path)
{
    if (!(maxComponent(material.emission) > 0.0f)) return;
    float weight = 1.0f;
    if (HAS_SHAPE_LIGHTS && path.pdf > 0.0f) {
        float pdfLight = pdfShapeLight(path.tableChance, hit, isect, path.org, path.dir);
        weight = weightOfScattering(path.pdf, pdfLight);
    }
    gather(path.beta * material.emission * weight, path.depth, path);
}

/// What happens at a surface: its emission, a shadow ray, the next ray. Returns the lobe sampled.
uint shadeSurface(READ(SurfaceInteraction) isect, READ(Material) material, READ(Traversal) hit, INOUT(PathState) path)
{
    tally.bounces++;
    seeEmission(isect, material, hit, path);
    path.phase = PHASE_ENDED;
    if (path.depth >= UNIFORM(maxBounces)) return LOBE_NONE;

    uint dimension = DIMENSION_FIRST_VERTEX + DIMENSIONS_PER_VERTEX * path.depth;
    vec4 u = random4(path.pixel, path.sampleIndex, dimension);
    bool lit = sampleDirectLight(material, isect, dimension, u.z, path);
    uint lobe = sampleNextRay(material, isect, dimension, u, path);
    path.depth++;
    if (lit) {
        path.phase = lobe != LOBE_NONE ? PHASE_SHADOW : PHASE_LAST_SHADOW;
    } else if (lobe != LOBE_NONE) {
        path.phase = PHASE_EXTEND;
    }
    return lobe;
}

/// What happens where the path's ray ended; under phong also when it is the next light's turn there.
/// Both integrators share one place that loads the surface: some drivers run every branch.
void shadePath(READ(Traversal) hit, INOUT(PathState) path)
{
    uint depth = path.depth;
    uint lobe = LOBE_NONE;
    bool arrives = path.phase == PHASE_EXTEND;
    bool blocked = seesTheEnvironmentOrNothing(path) && hit.slot != NO_HIT;
    if (hit.slot == NO_HIT) {
        seeEnvironment(path);
    } else if (blocked) {
        tally.bounces++;
        path.phase = PHASE_ENDED;
    } else {
        SurfaceInteraction isect = interactionAt(hit, path.org, path.dir);
        Material material = loadMaterial(isect.material);
        textureMaterial(isect.u, isect.v, material);
        bumpInteraction(material, hit, isect);
        if (HAS_PHONG && (!HAS_PATHS || UNIFORM(integrator) == INTEGRATOR_PHONG)) {
            shadePhong(isect, material, hit, path);
        } else {
            lobe = shadeSurface(isect, material, hit, path);
        }
    }
    if (arrives) {
        // Which of those in its way a ray finds that ends at any hit is a matter of the order of visits
        uint number = blocked ? 0u : hit.number;
        uint distance = blocked ? 0u : floatBitsToUint(hit.tHit);
        path.digest += digestOf(number, distance, depth, DIGEST_HIT + lobe);
    }
}

/// What happens when the shadow ray's walk is over.
void finishShadow(READ(Traversal) hit, INOUT(PathState) path)
{
    uint blocked = hit.slot != NO_HIT ? 1u : 0u;
    path.digest += digestOf(blocked, 0u, path.depth, DIGEST_SHADOW);
    bool phong = HAS_PHONG && UNIFORM(integrator) == INTEGRATOR_PHONG;
    if (blocked == 0u) gather(path.Ld, phong ? 1u : path.depth, path);
    if (phong) {
        passLight(path);
    } else {
        path.phase = path.phase == PHASE_SHADOW ? PHASE_EXTEND : PHASE_ENDED;
    }
}

/// Takes a path one ray further, or as far along it as the steps allow.
void stepPath(INOUT(PathState) path, INOUT(Traversal) walk)
{
    bool shadow = inShadowPhase(path);
    vec3 org = shadow ? path.shadowOrg : path.org;
    vec3 dir = shadow ? path.shadowDir : path.dir;
    bool over = HAS_PHONG && path.phase == PHASE_LIGHT;
    if (over) {
        stepsLeft--;
        walk = path.hit;
    } else {
        over = traverse(org, dir, shadow || seesTheEnvironmentOrNothing(path), walk);
    }
    if (!over || faults != 0u) return;
    if (shadow) {
        finishShadow(walk, path);
    } else {
        shadePath(walk, path);
    }
    walk = beginPathTraversal(path);
}

/// Takes a path that has not ended as far as the steps allow: until it has, stepsLeft is 0, or a fault.
void advancePath(INOUT(PathState) path, INOUT(Traversal) walk)
{
    for (;;) {
        stepPath(path, walk);
        if (path.phase == PHASE_ENDED || stepsLeft == 0u || faults != 0u) break;
    }
    if (path.phase != PHASE_ENDED && stepsLeft != 0u) faults |= FAULT_LOOP_CUT;
}
