// The few names that let one file be read by both the GLSL and the C++ compiler.
// GLSL: included by kernels. C++: included by the host; types come from GLM, which has GLSL's names.
#ifndef SAHL_INTEROP_H
#define SAHL_INTEROP_H

#ifdef __cplusplus

#include <cstddef>
#include <glm/glm.hpp>

namespace sahl {
using glm::uint;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
}  // namespace sahl

#define SHARED_BEGIN namespace sahl {
#define SHARED_END }
#define SHARED_CONST static constexpr
#define GPU_STRUCT_SIZE(Struct, bytes) static_assert(sizeof(Struct) == (bytes))
#define GPU_FIELD(Struct, field, offset) static_assert(offsetof(Struct, field) == (offset))
// Begins every element at a multiple of `bytes`, the host's memory of arrays as well.
#define HOST_ALIGNED(bytes) alignas(bytes)

#else

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_CONST const
#define GPU_STRUCT_SIZE(Struct, bytes)
#define GPU_FIELD(Struct, field, offset)
#define HOST_ALIGNED(bytes)

#endif

#endif
