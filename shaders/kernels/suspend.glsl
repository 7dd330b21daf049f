// Paths that ran out of steps are saved and go on in a later dispatch. Follows pathtrace/pathtrace.glsl.

layout(std430, set = 0, binding = BINDING_SUSPENDED) buffer SuspendedBlock
{
    SuspendedPath suspended[];
};

void suspendPath(uint index, PathState path, Traversal walk)
{
    suspended[index].path = path;
    suspended[index].traversal = walk;
    suspended[index].indirectRays = tally.indirectRays;
    suspended[index].shadowRays = tally.shadowRays;
    suspended[index].boxTests = tally.boxTests;
    suspended[index].primitiveTests = tally.primitiveTests;
    suspended[index].bounces = tally.bounces;
    suspended[index].clamped = tally.clamped;
    uint i = 0u;
    for (; i < walk.stackSize; i++) suspended[index].stack[i] = stackEntry(i);
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
}

void resumePath(uint index, out PathState path, out Traversal walk)
{
    path = suspended[index].path;
    walk = suspended[index].traversal;
    tally.indirectRays = suspended[index].indirectRays;
    tally.shadowRays = suspended[index].shadowRays;
    tally.boxTests = suspended[index].boxTests;
    tally.primitiveTests = suspended[index].primitiveTests;
    tally.bounces = suspended[index].bounces;
    tally.clamped = suspended[index].clamped;
    uint i = 0u;
    for (; i < walk.stackSize; i++) setStackEntry(i, suspended[index].stack[i]);
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
}
