// Nodes of the wide tree: four boxes at once, on a grid of 16 bits.
//
// The walk relies on one thing (traverse.glsl): a box is met wherever a primitive's box in it is, and entered no
// later, in the numbers that are computed. Here that is so for boxes on the grid, compared with boxes tested by
// intersectBox():
//   - A plane of a child, q + gridAt in steps of 2^k, lies on or beyond that of every box in the child; the host
//     rounds it outwards, in numbers that are exact (host/bvh/widen.cpp).
//   - makeGridRay() moves the ray's widened origin into the grid. Scaling by 2^-k is exact; the difference to
//     gridAt is rounded, and then moved outwards by at least that rounding. So q - origin is at most what plane -
//     origin is in steps for a lower plane, and at least that for an upper one; and rounding is monotone.
//   - inverse 2^k is exact, and products are monotone too. So are the smallest and largest of them.
// The host sees to it that no scaling leaves the range of numbers, whatever the ray; an infinite product is in
// its place in the order, and none is infinity times 0.

/// 2^k and 2^-k along the axes, from the bytes GRID_BIAS + k.
vec3 gridSteps(uint gridScale)
{
    return vec3(uintBitsToFloat((gridScale & 0xffu) << 23u), uintBitsToFloat(((gridScale >> 8u) & 0xffu) << 23u),
                uintBitsToFloat(((gridScale >> 16u) & 0xffu) << 23u));
}

vec3 gridCounts(uint gridScale)
{
    return gridSteps(0x00fefefeu - gridScale);
}

/// The ray as boxes on a grid need it: as in BoxRay, in steps from gridAt on.
BoxRay makeGridRay(BoxRay ray, vec3 gridAt, uint gridScale)
{
    BoxRay onGrid;
    onGrid.inverse = ray.inverse * axesOf(gridSteps(gridScale));
    Axes counts = axesOf(gridCounts(gridScale));
    Axes at = axesOf(gridAt);
    Axes lo = ray.orgLo * counts - at;
    Axes hi = ray.orgHi * counts - at;
    onGrid.orgLo = lo + (sizeAlongAxes(lo) * 1.1920929e-07f + equalAxes(1e-30f));  // 2^-23
    onGrid.orgHi = hi - (sizeAlongAxes(hi) * 1.1920929e-07f + equalAxes(1e-30f));
    return onGrid;
}

/// Tests the four boxes of a node against the part of the ray up to tMax.
///   x, y, z  as in WideNode
///   absent   all bits for the children that the node lacks
///   returns  for each child a key: larger where the ray enters later, the number of the child in its two lowest
///            bits; WIDE_MISS where the box is not met
FourUints intersectFour(BoxRay ray, FourUints x, FourUints y, FourUints z, FourUints absent, float tMax)
{
    Four ax = (floatsOf(x & 0xffffu) - alongX(ray.orgLo)) * alongX(ray.inverse);
    Four bx = (floatsOf(x >> 16u) - alongX(ray.orgHi)) * alongX(ray.inverse);
    Four ay = (floatsOf(y & 0xffffu) - alongY(ray.orgLo)) * alongY(ray.inverse);
    Four by = (floatsOf(y >> 16u) - alongY(ray.orgHi)) * alongY(ray.inverse);
    Four az = (floatsOf(z & 0xffffu) - alongZ(ray.orgLo)) * alongZ(ray.inverse);
    Four bz = (floatsOf(z >> 16u) - alongZ(ray.orgHi)) * alongZ(ray.inverse);
    // Those by way of int come last: what an int gave is none of the numbers of which a compiler sees the lesser in one instruction
    Four entry = positive4(greater4(greater4(lesser4(ax, bx), lesser4(ay, by)), lesser4(az, bz)));
    Four leave = upTo4(lesser4(lesser4(greater4(ax, bx), greater4(ay, by)), greater4(az, bz)), tMax);
    FourUints number = fourUints(uvec4(0u, 1u, 2u, 3u));
    if (TRAVERSAL_ORDER == ORDER_RIGHT_FIRST) number = fourUints(uvec4(3u, 2u, 1u, 0u));
    // Without the sign: zero has either
    FourUints key = (bitsOf(entry) & 0x7ffffffcu) | number;
    if (TRAVERSAL_ORDER != ORDER_NEAR_FIRST) key = number;
    return key | ~allBitsWhere(entry, leave) | absent;
}

CONST uint WIDE_MISS = 0xffffffffu;

uint lesserUint(uint a, uint b) { return b < a ? b : a; }

uint greaterUint(uint a, uint b) { return a < b ? b : a; }

/// The child that a key of intersectFour() names.
uint childNumber(uint key) { return TRAVERSAL_ORDER == ORDER_RIGHT_FIRST ? 3u - (key & 3u) : key & 3u; }

void pushChild(uvec4 refs, uint key, INOUT(Traversal) walk)
{
    uint ref = pick(refs, childNumber(key));
    expectRef(ref);
    stack[walk.stackSize] = ref;
    walk.stackSize++;
}

/// The group of the children that three keys name, of which those after a WIDE_MISS are no more; 0 for none.
uint groupOf(uint node, uint second, uint third, uint fourth)
{
    uint count = third == WIDE_MISS ? 1u : (fourth == WIDE_MISS ? 2u : 3u);
    uint numbers = (childNumber(fourth) << 4u) | (childNumber(third) << 2u) | childNumber(second);
    uint group = (node << 8u) | (count << 6u) | numbers;
    return second == WIDE_MISS ? 0u : group;
}

/// Visits an inner node of the wide tree: returns the child to visit next, the nearest one that is met, and
/// keeps the others that are met for later.
uint visitWideNode(BoxRay ray, INOUT(Traversal) walk)
{
    // With registers the children are read of the node that the walk goes on from
    FourUints absent = STACK_IN_REGISTERS ? allBitsWhereBeyond(walk.ref >> WIDE_CHILDREN_SHIFT)
                                          : allBitsWhereNone(fourUints(loadWideRefs(walk.ref)));
    FourUints keys = intersectFour(ray, fourUints(loadWideX(walk.ref)), fourUints(loadWideY(walk.ref)),
                                   fourUints(loadWideZ(walk.ref)), absent, walk.tHit);
    if (BRANCHES_ARE_GUESSED) {
        // A single child needs no order, and which one it is decides itself sooner than by the network below
        uint met = bitsWhereHighestIsClear(keys);
        if (met == 0u) return popRef(walk);
        if ((met & (met - 1u)) == 0u) return pickByGuess(loadWideRefs(walk.ref), lowestBit(met));
    }
    // A sorting network of five exchanges
    uint a = lesserUint(keys[0], keys[1]);
    uint b = greaterUint(keys[0], keys[1]);
    uint c = lesserUint(keys[2], keys[3]);
    uint d = greaterUint(keys[2], keys[3]);
    uint first = lesserUint(a, c);
    uint e = greaterUint(a, c);
    uint f = lesserUint(b, d);
    uint second = lesserUint(e, f);
    uint third = greaterUint(e, f);
    uint fourth = greaterUint(b, d);
    if (STACK_IN_REGISTERS) {
        uint node = walk.ref & WIDE_INDEX;
        uint rest = groupOf(node, second, third, fourth);
        return goDownOrOn(first != WIDE_MISS, node, childNumber(first), rest, walk);
    }
    if (first == WIDE_MISS) return popRef(walk);
    if (WALKS_ARE_WATCHED && walk.stackSize + 3u > STACK_SIZE) {
        faults |= FAULT_STACK_OVERFLOW;
        return REF_NONE;
    }
    READ(uvec4) refs = loadWideRefs(walk.ref);
    if (second != WIDE_MISS) {
        if (third != WIDE_MISS) {
            if (fourth != WIDE_MISS) pushChild(refs, fourth, walk);
            pushChild(refs, third, walk);
        }
        pushChild(refs, second, walk);
    }
    return pickByGuess(refs, childNumber(first));
}
