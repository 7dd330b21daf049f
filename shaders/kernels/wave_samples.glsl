// What the samples of a tile have gathered: light, digest and work so far.
//
// Like all that waits between two kernels of a wave they are rows of 16 bytes: some drivers take as long to read one number
// as to read four.

layout(std430, set = 0, binding = BINDING_WAVE_SAMPLES) buffer WaveSamplesBlock
{
    uvec4 samples[];
};

uvec4 rowOf(vec3 v, uint w) { return uvec4(floatBitsToUint(v), w); }

vec3 vectorIn(uvec4 row) { return uintBitsToFloat(row.xyz); }

void storeSample(uint place, PathState path)
{
    uint at = place * WAVE_SAMPLE_ROWS;
    samples[at] = rowOf(path.L, path.digest);
    samples[at + 1u] = uvec4(tally.indirectRays, tally.shadowRays, tally.boxTests, tally.primitiveTests);
    samples[at + 2u] = uvec4(tally.bounces, tally.clamped, 0u, 0u);
}

void loadSample(uint place, inout PathState path)
{
    uint at = place * WAVE_SAMPLE_ROWS;
    path.L = vectorIn(samples[at]);
    path.digest = samples[at].w;
    uvec4 row = samples[at + 1u];
    tally.indirectRays = row.x;
    tally.shadowRays = row.y;
    tally.boxTests = row.z;
    tally.primitiveTests = row.w;
    row = samples[at + 2u];
    tally.bounces = row.x;
    tally.clamped = row.y;
}
