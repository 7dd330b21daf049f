// Three numbers, along x, y and z, as the machine handles them best: here a vector of three.
// host/reference/axes.h has the same for C++.

#define Axes vec3

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
