// What a walk hands to the step that follows it: the closest hit, and the work of the walk that is over.

layout(std430, set = 0, binding = BINDING_WAVE_HITS) buffer WaveHitsBlock
{
    uvec4 hits[];
};

/// A shadow ray leaves the hit as it is: the phong integrator comes back to it.
void storeHit(uint slot, bool shadow, Traversal walk)
{
    uint at = slot * WAVE_HIT_ROWS;
    if (!shadow) {
        hits[at] = uvec4(walk.slot, walk.number, floatBitsToUint(walk.tHit), floatBitsToUint(walk.b1));
        hits[at + 1u] = uvec4(floatBitsToUint(walk.b2), walk.instance, tally.boxTests, tally.primitiveTests);
    } else {
        hits[at + 1u].z = tally.boxTests;
        hits[at + 1u].w = tally.primitiveTests;
    }
}

/// The hit; the work is added to the tally, if it was not before.
Traversal loadHit(uint slot, bool isNew)
{
    uint at = slot * WAVE_HIT_ROWS;
    uvec4 row = hits[at];
    Traversal walk = beginTraversal(uintBitsToFloat(row.z));
    walk.slot = row.x;
    walk.number = row.y;
    walk.b1 = uintBitsToFloat(row.w);
    row = hits[at + 1u];
    walk.b2 = uintBitsToFloat(row.x);
    walk.instance = row.y;
    tally.boxTests += isNew ? row.z : 0u;
    tally.primitiveTests += isNew ? row.w : 0u;
    return walk;
}
