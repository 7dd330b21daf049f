// What camera rays meet first, for the pictures that go along with the light.

FirstHits noFirstHits()
{
    FirstHits sums;
    sums.albedo = vec3(0.0f);
    sums.depth = 0.0f;
    sums.ns = vec3(0.0f);
    sums.hits = 0u;
    sums.ng = vec3(0.0f);
    sums.number = NO_HIT;
    sums.position = vec3(0.0f);
    sums.material = NO_HIT;
    return sums;
}

/// Share of light that a material returns, roughly, as a colour in [0,1]: what denoisers expect.
vec3 albedoOf(READ(Material) material)
{
    if (material.type == MATERIAL_CONDUCTOR || material.type == MATERIAL_ROUGH_CONDUCTOR) {
        return conductorReflectance(material, 1.0f);
    }
    if (material.type == MATERIAL_REPORT) {
        return material.baseColor * material.diffuseWeight + vec3(material.specularWeight);
    }
    return material.baseColor;
}

/// Walks on until the camera ray's hit is known; then the path has ended.
void advanceFirstHit(INOUT(PathState) path, INOUT(Traversal) walk)
{
    if (traverse(path.org, path.dir, false, walk)) path.phase = PHASE_ENDED;
}

/// Adds what a camera ray met. `isFirst`: it is the pixel's first sample.
void addFirstHit(READ(PathState) path, READ(Traversal) hit, bool isFirst, INOUT(FirstHits) sums)
{
    if (hit.slot == NO_HIT) return;
    SurfaceInteraction isect = interactionAt(hit, path.org, path.dir);
    Material material = loadMaterial(isect.material);
    textureMaterial(isect.u, isect.v, material);
    bumpInteraction(material, hit, isect);
    if (isFirst) {
        sums.number = hit.number;
        sums.material = isect.material;
    }
    sums.albedo = sums.albedo + albedoOf(material);
    sums.depth = sums.depth + hit.tHit;
    sums.ns = sums.ns + isect.ns;
    sums.ng = sums.ng + isect.ng;
    sums.position = sums.position + isect.p;
    sums.hits++;
}
