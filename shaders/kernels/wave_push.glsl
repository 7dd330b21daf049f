// Lists that the invocations of a kernel append to. Their order is free: no bit of a picture depends on it.
//
// One addition to the list's length for all invocations of a subgroup, or with SAHL_SHARED_QUEUES, for devices that have
// no ballots, of a workgroup, through its shared memory.

#ifdef SAHL_SHARED_QUEUES

shared uint groupNext;
shared uint groupFree;
shared uint groupNextAt;
shared uint groupFreeAt;

/// All invocations of the workgroup call this.
///   goesOn, entry  what goes into the queue of the next wave
///   ends, slot     what is free again
void pushAll(bool goesOn, uint entry, bool ends, uint slot)
{
    if (gl_LocalInvocationIndex == 0u) {
        groupNext = 0u;
        groupFree = 0u;
    }
    barrier();
    uint place = 0u;
    if (goesOn) place = atomicAdd(groupNext, 1u);
    if (ends) place = atomicAdd(groupFree, 1u);
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        groupNextAt = atomicAdd(counts.nextCount, groupNext);
        groupFreeAt = atomicAdd(counts.freeCount, groupFree);
    }
    barrier();
    if (goesOn) entries[queueAt(1u - counts.queue) + groupNextAt + place] = entry;
    if (ends) entries[freeSlotsAt() + groupFreeAt + place] = slot;
}

#else

void pushAll(bool goesOn, uint entry, bool ends, uint slot)
{
    // Ballots within the branch: they count who is there, however a device lets invocations go apart.
    if (goesOn) {
        uvec4 who = subgroupBallot(true);
        uint first = 0u;
        if (subgroupElect()) first = atomicAdd(counts.nextCount, subgroupBallotBitCount(who));
        first = subgroupBroadcastFirst(first);
        entries[queueAt(1u - counts.queue) + first + subgroupBallotExclusiveBitCount(who)] = entry;
    }
    if (ends) {
        uvec4 who = subgroupBallot(true);
        uint first = 0u;
        if (subgroupElect()) first = atomicAdd(counts.freeCount, subgroupBallotBitCount(who));
        first = subgroupBroadcastFirst(first);
        entries[freeSlotsAt() + first + subgroupBallotExclusiveBitCount(who)] = slot;
    }
}

#endif
