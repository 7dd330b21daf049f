// A path as a sequence of steps on a PathState: begin, extend, shade, shadow; and the loop over them.
// A megakernel, a wavefront of queues and the CPU reference call these same steps.

/// Folds one event of a path into its digest. Sums of this are compared by `sahl verify`.
uint digestOf(uint what, uint detail, uint depth, uint phase)
{
    return hash4(what, detail, depth, phase).x;
}

/// Starts sample `sampleIndex` of pixel (x, y): a ray through a random point of the pixel.
PathState beginPath(uint x, uint y, uint sampleIndex)
{
    PathState path;
    path.pixel = y * frame.width + x;
    path.sampleIndex = sampleIndex;
    vec4 u = random4(path.pixel, sampleIndex, DIMENSION_CAMERA);
    Ray ray = cameraRay(float(x) + u.x, float(y) + u.y);
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
    path.hasNext = 0u;
    return path;
}

/// The walk that the path's phase asks for.
Traversal beginPathTraversal(PathState path)
{
    return beginTraversal(path.phase == PHASE_SHADOW ? path.shadowTMax : RAY_INFINITY);
}

/// Prepares a shadow ray to one light; its arrival will add path.Ld. Returns whether there is one.
bool sampleDirectLight(Material material, SurfaceInteraction isect, float u, INOUT(PathState) path)
{
    if (frame.lightCount == 0u) return false;
    LightSample ls = sampleLight(isect.p, u);
    if (!(ls.distance > 0.0f)) return false;
    vec3 f = evalBsdfCos(material, isect, ls.wi);
    path.Ld = flushed3(path.beta * f * ls.Li);
    if (!(maxComponent(path.Ld) > 0.0f)) return false;
    path.shadowOrg = offsetOrigin(isect, ls.wi);
    path.shadowDir = ls.wi;
    path.shadowTMax = ls.distance;
    tally.shadowRays++;
    return true;
}

/// Chooses the path's next direction. Returns whether the path goes on.
bool sampleNextRay(Material material, SurfaceInteraction isect, float u1, float u2,
                   INOUT(PathState) path)
{
    BsdfSample bs = sampleBsdf(material, isect, u1, u2);
    path.beta = flushed3(path.beta * bs.weight);
    if (!(bs.pdf > 0.0f) || !(maxComponent(path.beta) > 0.0f)) return false;
    path.org = offsetOrigin(isect, bs.wi);
    path.dir = bs.wi;
    tally.indirectRays++;
    return true;
}

/// What happens where the path's ray ended: light that is seen, a shadow ray, the next ray.
void shadePath(Traversal hit, INOUT(PathState) path)
{
    path.digest += digestOf(hit.primitive, floatBitsToUint(hit.tHit), path.depth, PHASE_EXTEND);
    if (hit.slot == NO_HIT) {
        path.L = path.L + path.beta * evalProbe(path.dir);
        path.phase = PHASE_ENDED;
        return;
    }
    tally.bounces++;
    SurfaceInteraction isect = interactionAt(hit, path.dir);
    Material material = loadMaterial(isect.material);
    path.L = path.L + path.beta * material.emission;
    if (path.depth >= frame.maxBounces) {
        path.phase = PHASE_ENDED;
        return;
    }
    vec4 u = random4(path.pixel, path.sampleIndex,
                     DIMENSION_FIRST_VERTEX + DIMENSIONS_PER_VERTEX * path.depth);
    bool lit = sampleDirectLight(material, isect, u.z, path);
    bool goesOn = sampleNextRay(material, isect, u.x, u.y, path);
    path.depth++;
    path.hasNext = goesOn ? 1u : 0u;
    path.phase = lit ? PHASE_SHADOW : (goesOn ? PHASE_EXTEND : PHASE_ENDED);
}

/// What happens when the shadow ray's walk is over.
void finishShadow(Traversal hit, INOUT(PathState) path)
{
    uint blocked = hit.slot != NO_HIT ? 1u : 0u;
    path.digest += digestOf(blocked, 0u, path.depth, PHASE_SHADOW);
    if (blocked == 0u) path.L = path.L + path.Ld;
    path.phase = path.hasNext != 0u ? PHASE_EXTEND : PHASE_ENDED;
}

/// Takes a path as far as the steps allow: until it has ended, stepsLeft is 0, or a fault.
void advancePath(INOUT(PathState) path, INOUT(Traversal) walk)
{
    while (path.phase != PHASE_ENDED && stepsLeft != 0u) {
        bool shadow = path.phase == PHASE_SHADOW;
        vec3 org = shadow ? path.shadowOrg : path.org;
        vec3 dir = shadow ? path.shadowDir : path.dir;
        bool over = traverse(org, dir, shadow, walk);
        if (faults != 0u) break;
        if (over) {
            if (shadow) {
                finishShadow(walk, path);
            } else {
                shadePath(walk, path);
            }
            walk = beginPathTraversal(path);
        }
    }
    if (path.phase != PHASE_ENDED && stepsLeft != 0u) faults |= FAULT_LOOP_CUT;
}
