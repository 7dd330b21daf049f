// Descriptor set 0 of every path tracing kernel, specialisation constants and workgroup shape.
#ifndef SAHL_BINDINGS_H
#define SAHL_BINDINGS_H

#include "shared/interop.h"

SHARED_BEGIN

// Read-only scene data: texel buffers (RGBA32UI) or storage buffers, see kernels/accessors.glsl.
SHARED_CONST uint BINDING_NODES = 0u;
SHARED_CONST uint BINDING_PRIMITIVES = 1u;
SHARED_CONST uint BINDING_CORNERS = 2u;
SHARED_CONST uint BINDING_MATERIALS = 3u;
SHARED_CONST uint BINDING_TABLES = 4u;      // lights, aliases, textures: Frame says where each begins
SHARED_CONST uint BINDING_PROBE = 5u;
SHARED_CONST uint BINDING_INSTANCES = 6u;   // always a texel buffer: 8 storage buffers are enough then
SHARED_CONST uint SCENE_BUFFER_COUNT = 7u;

SHARED_CONST uint BINDING_FRAME = 7u;       // uniform buffer, Frame
SHARED_CONST uint BINDING_PIXELS = 8u;      // storage buffer, PixelBlock[] of the tile
SHARED_CONST uint BINDING_SUSPENDED = 9u;   // storage buffer, SuspendedPath[] of the tile
SHARED_CONST uint BINDING_COUNT = 10u;      // of the path kernels
SHARED_CONST uint BINDING_FIRST_HITS = 10u; // storage buffer, FirstHits[] of the tile: first_hits only

// In place of these, of trace_rays: TraceRay[], read as arrays of the scene are; storage buffers, TraceHit[] and
// SuspendedWalk[].
SHARED_CONST uint BINDING_RAYS = 8u;
SHARED_CONST uint BINDING_RAY_HITS = 9u;
SHARED_CONST uint BINDING_RAY_WALKS = 10u;

// In place of these, of the kernels of waves: storage buffers. wave_trace has all up to the
// stacks, wave_shade those up to the hits, wave_film the first two and the pixels. wave_plan has the queues, at binding 0.
SHARED_CONST uint BINDING_WAVE_QUEUES = 8u;    // WaveCounts, then the queues
SHARED_CONST uint BINDING_WAVE_SAMPLES = 9u;   // WaveSample[] of the tile
SHARED_CONST uint BINDING_WAVE_PATHS = 10u;    // WavePath[] and so on: of the slots
SHARED_CONST uint BINDING_WAVE_RAYS = 11u;
SHARED_CONST uint BINDING_WAVE_HITS = 12u;
SHARED_CONST uint BINDING_WAVE_WALKS = 13u;
SHARED_CONST uint BINDING_WAVE_STACKS = 14u;
SHARED_CONST uint BINDING_WAVE_PIXELS = 10u;   // of wave_film: PixelBlock[] of the tile

// Specialisation constants.
SHARED_CONST uint SPEC_GROUP_WIDTH = 0u;   // workgroup shape [invocations]
SHARED_CONST uint SPEC_GROUP_HEIGHT = 1u;
SHARED_CONST uint SPEC_STACK_SIZE = 2u;    // entries, as many as the trees need (device/walked_tree.h)
SHARED_CONST uint SPEC_ORDER = 3u;         // one of ORDER_*
SHARED_CONST uint SPEC_MATH = 4u;          // one of MATH_*
SHARED_CONST uint SPEC_FEATURES = 5u;      // what the scene has: FEATURE_* of features.h
SHARED_CONST uint SPEC_NODE_WIDTH = 6u;    // children of a node: 2, or 4 for the wide tree
SHARED_CONST uint SPEC_STACK_IN_REGISTERS = 7u;  // 1: with NODE_WIDTH 4 only
SHARED_CONST uint SPEC_RESUMES = 8u;       // 1: what runs out of steps is saved; 0: it begins again in the next dispatch
SHARED_CONST uint SPEC_UNIFORMS_HIDDEN = 9u;  // 1: see kernels/uniforms.glsl
SHARED_CONST uint SPEC_STEP_BY_STEP = 10u;  // 1: a walk's loop is one node and one primitive (pathtrace/traverse.glsl)
SHARED_CONST uint SPEC_WATCHED = 11u;      // 1: walks stop when their steps are spent, and see that loops are cut
SHARED_CONST uint SPEC_COUNT = 12u;

// How division and root come to be C++'s (pathtrace/exact.glsl).
SHARED_CONST uint MATH_NATIVE = 0u;    // the device's own
SHARED_CONST uint MATH_INTEGERS = 1u;  // made exact by integers
SHARED_CONST uint MATH_FUSED = 2u;     // division by fused multiply-add, root by integers

// Order in which the children of a node are visited. It changes the counters, never a hit.
SHARED_CONST uint ORDER_NEAR_FIRST = 0u;
SHARED_CONST uint ORDER_LEFT_FIRST = 1u;
SHARED_CONST uint ORDER_RIGHT_FIRST = 2u;

SHARED_END

#endif
