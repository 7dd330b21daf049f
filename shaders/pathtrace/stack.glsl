// What a walk has still to visit.
//
// Either references wait in an array, or, with STACK_IN_REGISTERS, groups in registers. A group is the children of one
// wide node that wait to be visited, so that a visit adds one entry at most, and never more wait than the tree is high:
//   bits 8 to 31  the node
//        6 and 7  how many of its children wait, 1 to 3
//        0 to 5   their numbers, two bits each, the next one lowest
// GROUP_LEAVE stands for REF_LEAVE, 0 for nothing. walk.group is the one whose turn is next; those behind it are
// registers[0] to registers[walk.stackSize - 1].
//
// A register is found by comparing numbers, all registers' with the wanted one. Machines that run invocations in step
// write to an array of which each of them has another element by a branch for every one of them; comparing has none.
CONST uint GROUP_LEAVE = 0x3fu;
CONST uint GROUP_COUNT = 0xc0u;
CONST uint GROUP_ONE = 0x40u;  // of GROUP_COUNT: one child

#define EACH_REGISTER(DO) \
    DO(0u) DO(1u) DO(2u) DO(3u) DO(4u) DO(5u) DO(6u) DO(7u) \
    DO(8u) DO(9u) DO(10u) DO(11u) DO(12u) DO(13u) DO(14u) DO(15u)

/// Register `at`; 0 where there is none.
uint registerAt(uint at)
{
    uint entry = 0u;
#define PICK_REGISTER(i) \
    if (i < STACK_SIZE) entry = at == i ? registers[i] : entry;
    EACH_REGISTER(PICK_REGISTER)
#undef PICK_REGISTER
    return entry;
}

/// Nothing happens where there is no register `at`.
void setRegister(uint at, uint entry)
{
#define SET_REGISTER(i) \
    if (i < STACK_SIZE) registers[i] = at == i ? entry : registers[i];
    EACH_REGISTER(SET_REGISTER)
#undef SET_REGISTER
}

/// Puts walk.group behind the group that is next from now on.
///   returns  whether it was pushed: nothing is not
bool pushGroup(bool wanted, INOUT(Traversal) walk)
{
    bool pushed = wanted && walk.group != 0u;
    setRegister(pushed ? walk.stackSize : STACK_SIZE, walk.group);
    if (pushed && walk.stackSize == STACK_SIZE) faults |= FAULT_STACK_OVERFLOW;
    return pushed;
}

/// The group without the child that is visited next.
uint groupWithoutNext(uint group) { return ((group - GROUP_ONE) & ~0x3fu) | ((group >> 2u) & 0xfu); }

/// With STACK_IN_REGISTERS: goes down to a child of the node that was visited, or on to the next one that waits. One
/// piece of text does both, since machines that run invocations in step do the work of both whichever a walk needs.
///   node, number  which child to go down to
///   rest          group of the node's children that are to wait, 0 for none; none where the walk does not go down
///   returns       the child, REF_NONE where the walk does not go down and nothing waits
uint goDownOrOn(bool down, uint node, uint number, uint rest, INOUT(Traversal) walk)
{
    uint group = walk.group;
    uint ref = pick(loadWideRefs(down ? node : group >> 8u), down ? number : group & 3u);
    if (HAS_INSTANCES && !down && group == GROUP_LEAVE) ref = REF_LEAVE;
    if (!down && group == 0u) ref = REF_NONE;

    bool spent = !down && (group & GROUP_COUNT) <= GROUP_ONE;
    bool pops = spent && walk.stackSize != 0u;
    uint below = registerAt(walk.stackSize - 1u);
    bool pushed = pushGroup(rest != 0u, walk);
    walk.group = rest != 0u ? rest : (down ? group : (spent ? below : groupWithoutNext(group)));
    walk.stackSize = pushed ? walk.stackSize + 1u : (pops ? walk.stackSize - 1u : walk.stackSize);
    return ref;
}

void pushRef(uint ref, INOUT(Traversal) walk)
{
    if (walk.stackSize < STACK_SIZE) {
        stack[walk.stackSize] = ref;
        walk.stackSize++;
    } else {
        faults |= FAULT_STACK_OVERFLOW;
    }
}

/// Takes the next reference from what waits; REF_NONE where nothing does.
uint popRef(INOUT(Traversal) walk)
{
    if (STACK_IN_REGISTERS) return goDownOrOn(false, 0u, 0u, 0u, walk);
    if (walk.stackSize == 0u) return REF_NONE;
    walk.stackSize--;
    return stack[walk.stackSize];
}

/// Has the walk leave the instance that it enters when all below is visited.
void pushLeave(INOUT(Traversal) walk)
{
    if (STACK_IN_REGISTERS) {
        if (pushGroup(true, walk)) walk.stackSize++;
        walk.group = GROUP_LEAVE;
    } else {
        pushRef(REF_LEAVE, walk);
    }
}

// For walks that stop and go on:

uint stackEntry(uint at) { return STACK_IN_REGISTERS ? registerAt(at) : stack[at]; }

void setStackEntry(uint at, uint entry)
{
    if (STACK_IN_REGISTERS) {
        setRegister(at, entry);
    } else {
        stack[at] = entry;
    }
}
