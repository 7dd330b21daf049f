// Paths between two kernels of a wave. Follows kernels/wave_samples.glsl.

layout(std430, set = 0, binding = BINDING_WAVE_PATHS) buffer WavePathsBlock
{
    uvec4 paths[];
};
layout(std430, set = 0, binding = BINDING_WAVE_RAYS) buffer WaveRaysBlock
{
    uvec4 rays[];
};

/// Whether a scene has shadow rays at all, and whether it has refraction.
CONST bool HAS_SHADOW_RAYS =
    (FEATURES & (FEATURE_FAR_LIGHTS | FEATURE_SHAPE_LIGHTS | FEATURE_PROBE_LIGHT | FEATURE_PHONG)) != 0u;
CONST bool HAS_MEDIA = (FEATURES & (FEATURE_SMOOTH | FEATURE_GLOSSY)) != 0u;

// Rays: two rows for the one that continues the path, two for its shadow ray.

void storeRay(uint slot, vec3 org, vec3 dir)
{
    rays[slot * WAVE_RAY_ROWS] = rowOf(org, 0u);
    rays[slot * WAVE_RAY_ROWS + 1u] = rowOf(dir, 0u);
}

void storeShadowRay(uint slot, PathState path)
{
    rays[slot * WAVE_RAY_ROWS + 2u] = rowOf(path.shadowOrg, floatBitsToUint(path.shadowTMax));
    rays[slot * WAVE_RAY_ROWS + 3u] = rowOf(path.shadowDir, 0u);
}

// Paths. Scatterings, phase and number of the sample in its block share a word: 26, 3 and 3 bits.

CONST uint DEPTH_BITS = 26u;

uint wordOfProgress(PathState path)
{
    return path.depth | path.phase << DEPTH_BITS | (path.sampleIndex - job.firstSample) << (DEPTH_BITS + 3u);
}

void storeMedium(uint slot, uint place, PathState path)
{
    paths[slot * WAVE_PATH_ROWS + 1u] =
        uvec4(path.pixel, place, floatBitsToUint(path.mediumEta), floatBitsToUint(path.etaScale));
}

/// Stores what a step changes.
void storePath(uint slot, uint place, PathState path)
{
    uint at = slot * WAVE_PATH_ROWS;
    paths[at] = rowOf(path.beta, wordOfProgress(path));
    if (HAS_MEDIA) storeMedium(slot, place, path);
    if (HAS_SHADOW_RAYS) {
        paths[at + 2u] = rowOf(path.Ld, floatBitsToUint(path.pdf));
        paths[at + 3u] = uvec4(floatBitsToUint(path.probeChance), floatBitsToUint(path.tableChance), 0u, 0u);
    }
}

/// Stores a path that begins.
void storeNewPath(uint slot, uint place, PathState path)
{
    storePath(slot, place, path);
    if (!HAS_MEDIA) storeMedium(slot, place, path);
}

/// A path without what its sample has gathered, and the place of that.
PathState loadPath(uint slot, out uint place)
{
    PathState path;
    path.org = vectorIn(rays[slot * WAVE_RAY_ROWS]);
    path.dir = vectorIn(rays[slot * WAVE_RAY_ROWS + 1u]);
    uvec4 row = paths[slot * WAVE_PATH_ROWS];
    path.beta = vectorIn(row);
    path.depth = row.w & ((1u << DEPTH_BITS) - 1u);
    path.phase = row.w >> DEPTH_BITS & 7u;
    path.sampleIndex = job.firstSample + (row.w >> (DEPTH_BITS + 3u));
    row = paths[slot * WAVE_PATH_ROWS + 1u];
    path.pixel = row.x;
    place = row.y;
    path.mediumEta = uintBitsToFloat(row.z);
    path.etaScale = uintBitsToFloat(row.w);
    path.Ld = vec3(0.0f);
    path.pdf = 0.0f;
    path.probeChance = 0.0f;
    path.tableChance = 0.0f;
    path.shadowOrg = vec3(0.0f);
    path.shadowTMax = 0.0f;
    path.shadowDir = vec3(0.0f);
    if (HAS_SHADOW_RAYS) {
        row = paths[slot * WAVE_PATH_ROWS + 2u];
        path.Ld = vectorIn(row);
        path.pdf = uintBitsToFloat(row.w);
        row = paths[slot * WAVE_PATH_ROWS + 3u];
        path.probeChance = uintBitsToFloat(row.x);
        path.tableChance = uintBitsToFloat(row.y);
    }
    return path;
}
