// The plain traversal of the tree, which every tuned one must equal.
//
// The hit does not depend on the order of visits: a primitive's distance is never taken to be smaller
// than the entry into the primitive's own box, computed by the same function as for every other box.
// Rounding is monotone, so a box that encloses another is never entered later; hence a subtree whose
// box is entered behind the closest hit holds nothing closer. Equal distances go to the smallest
// primitive number.
//
// The same holds across the two levels of a scene with instances. A primitive of an instance is hit at the
// largest of three: its own distance, the entry into its box in the object's space, and the entry into
// the instance's box in the world; and not at all if either box is missed. Boxes of the object's tree
// enclose the first, boxes of the world's tree the second. The ray in the object's space is a function of
// the ray and the instance alone, and its direction is not scaled to length 1, so that all three are
// distances along the same ray. What decides ties is unique in the scene: the number of the instance's
// first primitive plus that of the primitive within the object.

Traversal beginTraversal(float tMax)
{
    Traversal walk;
    walk.ref = UNIFORM(rootRef);
    walk.stackSize = 0u;
    walk.group = 0u;
    walk.slot = NO_HIT;
    walk.number = NO_HIT;
    walk.tHit = tMax;
    walk.b1 = 0.0f;
    walk.b2 = 0.0f;
    walk.inside = NO_INSTANCE;
    walk.instance = NO_INSTANCE;
    walk.unused0 = 0u;
    walk.unused1 = 0u;
    return walk;
}

/// Corners of the widened box of a primitive. The host builds the tree from the same boxes.
void primitiveBox(READ(Primitive) shape, OUT(Axes) lo, OUT(Axes) hi)
{
    Axes p0 = axesOf(shape.p0);
    if (HAS_SPHERES && shape.shape == SHAPE_SPHERE) {
        lo = p0 - equalAxes(shape.p1.x);
        hi = p0 + equalAxes(shape.p1.x);
    } else {
        Axes p1 = axesOf(shape.p1);
        Axes p2 = axesOf(shape.p2);
        lo = lesserAxes(lesserAxes(p0, p1), p2);
        hi = greaterAxes(greaterAxes(p0, p1), p2);
    }
    Axes widening = equalAxes(largestAlong(greaterAxes(-lo, hi)) * WIDENING);
    lo = greaterAxes(lo - widening, equalAxes(-LARGEST_FLOAT));
    hi = lesserAxes(hi + widening, equalAxes(LARGEST_FLOAT));
}

// The ray in the space of the tree that is being walked: the world, or an instance's object.
struct WalkRay
{
    vec3 org;
    float entry;        // into the instance's box in the world, 0 in the world [m]
    vec3 dir;           // unit in the world
    uint firstNumber;   // of the instance's primitives, 0 in the world
    uint material;      // of all the instance's primitives, or NO_MATERIAL
    BoxRay boxes;
    BoxRay onGrid;      // NODE_WIDTH 4: of the tree
    ShearedRay sheared;
};

WalkRay makeWalkRay(vec3 org, vec3 dir, float entry, uint firstNumber)
{
    WalkRay ray;
    ray.org = org;
    ray.entry = entry;
    ray.dir = dir;
    ray.firstNumber = firstNumber;
    ray.material = NO_MATERIAL;
    ray.boxes = makeBoxRay(org, dir);
    if (NODE_WIDTH == 4u) ray.onGrid = makeGridRay(ray.boxes, UNIFORM(gridAt), UNIFORM(gridScale));
    ray.sheared = shearRay(org, dir);
    return ray;
}

/// The ray in the space of the object of an instance.
///   entry  of the ray into the instance's box in the world
WalkRay walkRayInside(READ(ObjectInstance) instance, vec3 org, vec3 dir, float entry)
{
    WalkRay ray = makeWalkRay(pointToObject(instance, org), directionToObject(instance, dir), entry,
                              instance.firstNumber);
    ray.material = instance.material;
    if (NODE_WIDTH == 4u) {
        vec3 gridAt = vec3(instance.gridX, instance.gridY, instance.gridZ);
        ray.onGrid = makeGridRay(ray.boxes, gridAt, instance.gridScale);
    }
    return ray;
}

/// The ray as a walk needs it that goes on where another dispatch left it.
WalkRay walkRayOf(READ(Traversal) walk, vec3 org, vec3 dir)
{
    WalkRay ray = makeWalkRay(org, dir, 0.0f, 0u);
    if (HAS_INSTANCES && walk.inside != NO_INSTANCE) {
        ObjectInstance instance = loadInstance(walk.inside);
        float entry;
        bool met = intersectBox(ray.boxes, instance.lo, instance.hi, RAY_INFINITY, entry);
        ray = walkRayInside(instance, org, dir, met ? entry : 0.0f);
    }
    return ray;
}

/// Tests the primitive in `slot` and keeps it in `walk` when it is the closest so far. Where its material has a
/// hole there is no hit, whoever asks: so the closest hit depends on no order, as above.
void visitPrimitive(READ(WalkRay) ray, uint slot, INOUT(Traversal) walk)
{
    READ(Primitive) shape = loadPrimitive(slot);
    float t;
    float b1 = 0.0f;
    float b2 = 0.0f;
    if (HAS_SPHERES && shape.shape == SHAPE_SPHERE) {
        if (!intersectSphere(ray.org, ray.dir, shape.p0, shape.p1.x, t)) return;
    } else {
        if (!intersectTriangle(ray.org, ray.dir, ray.sheared, shape, t, b1, b2)) return;
    }

    Axes lo;
    Axes hi;
    primitiveBox(shape, lo, hi);
    float entry;
    if (!intersectAxes(ray.boxes, lo, hi, walk.tHit, entry)) return;
    t = max2(t, entry);
    uint number = shape.number;
    if (HAS_INSTANCES) {
        t = max2(t, ray.entry);
        number += ray.firstNumber;
    }
    bool closer = t < walk.tHit || (t == walk.tHit && number < walk.number);
    if (HAS_CUTOUTS && closer) closer = !isCutOut(shape, ray.material, b1, b2);
    if (closer) {
        walk.slot = slot;
        walk.number = number;
        if (HAS_INSTANCES) walk.instance = walk.inside;
        walk.tHit = t;
        walk.b1 = b1;
        walk.b2 = b2;
    }
}

/// Visits an inner node: returns the child to visit next and pushes the other one, if it is met too.
uint visitNode(BoxRay boxes, INOUT(Traversal) walk)
{
    BvhNode node = loadNode(walk.ref);
    float entry0;
    float entry1;
    bool met0 = intersectBox(boxes, node.lo0, node.hi0, walk.tHit, entry0);
    bool met1 = intersectBox(boxes, node.lo1, node.hi1, walk.tHit, entry1);
    if (met0 && met1) {
        bool firstIs0 = TRAVERSAL_ORDER == ORDER_NEAR_FIRST ? entry0 <= entry1
                                                            : TRAVERSAL_ORDER == ORDER_LEFT_FIRST;
        pushRef(firstIs0 ? node.ref1 : node.ref0, walk);
        return firstIs0 ? node.ref0 : node.ref1;
    }
    if (met0) return node.ref0;
    if (met1) return node.ref1;
    return popRef(walk);
}

uint firstOfLeaf(uint leaf) { return (leaf & ~REF_LEAF) >> LEAF_COUNT_BITS; }

bool hasMoreThanOne(uint leaf) { return (leaf & (MAX_LEAF_SIZE - 1u)) != 0u; }

/// The leaf without its first primitive; it must have more than one.
uint leafWithoutFirst(uint leaf) { return leaf + (1u << LEAF_COUNT_BITS) - 1u; }

/// Visits all primitives of the leaf that the walk is at, or the first one STEP_BY_STEP; returns how many.
uint visitLeaf(READ(WalkRay) ray, INOUT(Traversal) walk)
{
    uint first = firstOfLeaf(walk.ref);
    if (STEP_BY_STEP) {
        visitPrimitive(ray, first, walk);
        return 1u;
    }
    uint count = (walk.ref & (MAX_LEAF_SIZE - 1u)) + 1u;
    uint i = 0u;
    for (;;) {
        visitPrimitive(ray, first + i, walk);
        i++;
        if (i >= count) break;
    }
    if (WALKS_ARE_WATCHED && i != count) faults |= FAULT_LOOP_CUT;
    return count;
}

/// Takes the walk into the instance that it is at, if the ray meets its box, or out of the one that it
/// is in; `ray` becomes the ray in the space where it goes on.
///   org, dir  of the ray in the world
void changeSpace(vec3 org, vec3 dir, INOUT(WalkRay) ray, INOUT(Traversal) walk)
{
    if (walk.ref == REF_LEAVE) {
        walk.inside = NO_INSTANCE;
        walk.ref = popRef(walk);
        ray = makeWalkRay(org, dir, 0.0f, 0u);
        return;
    }
    uint index = walk.ref & ~REF_INSTANCE;
    ObjectInstance instance = loadInstance(index);
    float entry;
    tally.boxTests++;
    if (intersectBox(ray.boxes, instance.lo, instance.hi, walk.tHit, entry)) {
        pushLeave(walk);
        walk.inside = index;
        walk.ref = instance.rootRef;
        ray = walkRayInside(instance, org, dir, entry);
    } else {
        walk.ref = popRef(walk);
    }
}

bool mayGoOn(uint steps) { return !WALKS_ARE_WATCHED || steps != 0u; }

/// Walks on until the closest hit (or, for anyHit, some hit) is known or the steps are spent.
/// Returns true when the walk is over. Where walks are watched, every loop says whether it ended by its own condition:
/// a driver that cuts a loop short leaves a fault behind.
///
/// A turn of the outer loop goes through nodes until there is a leaf, and visits all of it (while-while). STEP_BY_STEP it
/// is one node and one primitive at most, so that invocations in step never wait for one that has a long way to its next
/// leaf, or a large leaf (if-if; both are compared by Aila and Laine 2009, "Understanding the Efficiency of Ray Traversal
/// on GPUs"). Order and number of the visits are the same.
///
/// Here as in all loops that take time, what ends the loop stands behind its work: drivers that run invocations in step,
/// with a mask of who takes part, ask whether anybody is left only there, and would run the work once more for nobody.
bool traverse(vec3 org, vec3 dir, bool anyHit, INOUT(Traversal) state)
{
    Traversal walk = state;  // nothing else has a name for it, so that C++ may keep it in registers
    uint steps = stepsLeft;
    uint nodesVisited = 0u;
    uint primitivesVisited = 0u;
    WalkRay ray = walkRayOf(walk, org, dir);
    for (;;) {
        if ((walk.ref & REF_NOT_INNER) == 0u) {
            // Also in front: without it SwiftShader computes other hits where the stack is in registers
            while ((walk.ref & REF_NOT_INNER) == 0u) {
                steps--;
                nodesVisited++;
                if (NODE_WIDTH == 4u) {
                    walk.ref = visitWideNode(ray.onGrid, walk);
                } else {
                    walk.ref = visitNode(ray.boxes, walk);
                }
                if (STEP_BY_STEP || (walk.ref & REF_NOT_INNER) != 0u || !mayGoOn(steps)) break;
            }
        }
        bool amongNodes = (walk.ref & REF_NOT_INNER) == 0u;
        if (WALKS_ARE_WATCHED && !STEP_BY_STEP && amongNodes && steps != 0u) faults |= FAULT_LOOP_CUT;
        if (walk.ref == REF_NONE || (WALKS_ARE_WATCHED && (steps == 0u || faults != 0u))) break;

        if (STEP_BY_STEP && amongNodes) continue;

        if (HAS_INSTANCES && (walk.ref & REF_LEAF) == 0u) {
            steps--;
            changeSpace(org, dir, ray, walk);
        } else {
            uint count = visitLeaf(ray, walk);
            primitivesVisited += count;
            steps = steps > count ? steps - count : 0u;
            if (STEP_BY_STEP && hasMoreThanOne(walk.ref)) {
                walk.ref = leafWithoutFirst(walk.ref);
            } else {
                walk.ref = anyHit && walk.slot != NO_HIT ? REF_NONE : popRef(walk);
            }
        }
        if (walk.ref == REF_NONE || !mayGoOn(steps)) break;
    }
    if (WALKS_ARE_WATCHED && walk.ref != REF_NONE && steps != 0u) faults |= FAULT_LOOP_CUT;
    tally.boxTests += NODE_WIDTH * nodesVisited;
    tally.primitiveTests += primitivesVisited;
    stepsLeft = WALKS_ARE_WATCHED ? steps : stepsLeft - lesserUint(stepsLeft, nodesVisited + primitivesVisited);
    state = walk;
    return walk.ref == REF_NONE;
}
