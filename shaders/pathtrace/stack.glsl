// The references that a walk has still to visit.

void pushRef(uint ref, INOUT(Traversal) walk)
{
    if (walk.stackSize < STACK_SIZE) {
        stack[walk.stackSize] = ref;
        walk.stackSize++;
    } else {
        faults |= FAULT_STACK_OVERFLOW;
    }
}

uint popRef(INOUT(Traversal) walk)
{
    if (walk.stackSize == 0u) return REF_NONE;
    walk.stackSize--;
    return stack[walk.stackSize];
}
