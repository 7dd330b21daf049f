// Uniforms that a driver cannot tell from other numbers.
//
// Mesa 22's lavapipe puts uniforms that branches depend on into the kernel as constants, for every command buffer
// anew: it then compiles the kernel before each dispatch, whatever the values. It does so where their place in a block
// is known. So blocks are arrays of one element, which is read at UNIFORMS_AT.
#ifndef KERNELS_UNIFORMS_GLSL
#define KERNELS_UNIFORMS_GLSL

#include "shared/bindings.h"

layout(constant_id = SPEC_UNIFORMS_HIDDEN) const bool UNIFORMS_HIDDEN = false;

/// 0.
#define UNIFORMS_AT (UNIFORMS_HIDDEN ? gl_NumWorkGroups.x >> 31u : 0u)

#endif
