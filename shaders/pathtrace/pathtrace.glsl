// The path tracer, in the order in which a path meets its parts. The includer provides the buffers
// (loadNode, loadPrimitive, ...), `frame`, STACK_SIZE, STACK_IN_REGISTERS, STEP_BY_STEP, WALKS_ARE_WATCHED,
// BRANCHES_ARE_GUESSED, NODE_WIDTH, TRAVERSAL_ORDER, MATH, FEATURES, fusedMultiplyAdd(), the macros OUT and INOUT, and
// what four.glsl and axes.glsl have.

// Invocation-wide state.
struct Tally
{
    uint indirectRays;
    uint shadowRays;
    uint boxTests;
    uint primitiveTests;
    uint bounces;
    uint clamped;
};

Tally tally;             // work counted for the current sample
uint stepsLeft;          // steps of traversal before the invocation must stop
uint faults;             // FAULT_* seen so far
uint stack[STACK_SIZE];  // references still to visit, or
uint registers[STACK_REGISTERS];  // groups of them (stack.glsl)

CONST float RAY_INFINITY = 3.0e38f;

#include "pathtrace/features.glsl"
#include "pathtrace/exact.glsl"
#include "pathtrace/math.glsl"
#include "pathtrace/sobol.glsl"
#include "pathtrace/sobol64.glsl"
#include "pathtrace/rng.glsl"
#include "pathtrace/sampling.glsl"
#include "pathtrace/camera.glsl"
#include "pathtrace/boxes.glsl"
#include "pathtrace/triangle.glsl"
#include "pathtrace/sphere.glsl"
#include "pathtrace/texture.glsl"
#include "pathtrace/instance.glsl"
#include "pathtrace/stack.glsl"
#include "pathtrace/wide.glsl"
#include "pathtrace/traverse.glsl"
#include "pathtrace/interaction.glsl"
#include "pathtrace/normal_map.glsl"
#include "pathtrace/fresnel.glsl"
#include "pathtrace/lobes.glsl"
#include "pathtrace/smooth.glsl"
#include "pathtrace/microfacet.glsl"
#include "pathtrace/coat.glsl"
#include "pathtrace/plastic.glsl"
#include "pathtrace/metallic_roughness.glsl"
#include "pathtrace/glossy.glsl"
#include "pathtrace/bsdf.glsl"
#include "pathtrace/probe.glsl"
#include "pathtrace/light_choice.glsl"
#include "pathtrace/probe_sampling.glsl"
#include "pathtrace/shape_lights.glsl"
#include "pathtrace/light.glsl"
#include "pathtrace/light_estimate.glsl"
#include "pathtrace/phong.glsl"
#include "pathtrace/roulette.glsl"
#include "pathtrace/gather.glsl"
#include "pathtrace/path.glsl"
#include "pathtrace/film.glsl"
#include "pathtrace/first_hits.glsl"
