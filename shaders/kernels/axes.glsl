// Three numbers, along x, y and z, as the machine handles them best: here a vector of three.
// host/reference/axes.h has the same for C++.

#define Axes vec3
#define AxesMask bvec3

vec3 axesOf(vec3 v) { return v; }

vec3 equalAxes(float x) { return vec3(x); }

float alongX(vec3 v) { return v.x; }

float alongY(vec3 v) { return v.y; }

float alongZ(vec3 v) { return v.z; }

vec3 lesserAxes(vec3 a, vec3 b) { return mix(a, b, lessThan(b, a)); }

vec3 greaterAxes(vec3 a, vec3 b) { return mix(a, b, lessThan(a, b)); }

vec3 sizeAlongAxes(vec3 v) { return uintBitsToFloat(floatBitsToUint(v) & 0x7fffffffu); }

bvec3 lessAlongAxes(vec3 a, vec3 b) { return lessThan(a, b); }

vec3 chosenAxes(bvec3 which, vec3 a, vec3 b) { return mix(b, a, which); }

#define inverseAlongAxes(v) vec3(quotient(1.0f, (v).x), quotient(1.0f, (v).y), quotient(1.0f, (v).z))

vec3 yzx(vec3 v) { return v.yzx; }

vec3 zxy(vec3 v) { return v.zxy; }

/// Whether one number is below zero and another above; either, if one is not a number.
bool onBothSidesOfZero(vec3 v)
{
    vec2 lesser = mix(v.xy, v.yz, lessThan(v.yz, v.xy));
    vec2 greater = mix(v.xy, v.yz, lessThan(v.xy, v.yz));
    return (lesser.y < lesser.x ? lesser.y : lesser.x) < 0.0f && (greater.x < greater.y ? greater.y : greater.x) > 0.0f;
}

float pickAxis(vec3 v, uint axis) { return axis == 0u ? v.x : (axis == 1u ? v.y : v.z); }

/// Of the corners of a triangle, relative to org, their places along an axis.
///   orgAlong  org's
vec3 cornersAlong(Primitive triangle, vec3 org, uint axis, float orgAlong)
{
    // Subtracts first: picking from what was just read takes SwiftShader's compiler minutes
    return vec3(pickAxis(triangle.p0 - org, axis), pickAxis(triangle.p1 - org, axis), pickAxis(triangle.p2 - org, axis));
}
