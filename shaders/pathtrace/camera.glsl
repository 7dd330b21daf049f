// Where a camera ray starts and goes.

struct Ray
{
    vec3 org;    // [m]
    float tMax;  // where it ends [m]
    vec3 dir;    // unit
};

/// The ray through a point of the picture.
///   x, y  pixels from the top left corner of the picture; a pixel's centre is at + 0.5
Ray cameraRay(float x, float y)
{
    float sx = quotient(x * 2.0f, float(frame.width)) - 1.0f;
    float sy = quotient(y * 2.0f, float(frame.height)) - 1.0f;
    Ray ray;
    ray.org = frame.camera.position;
    ray.tMax = RAY_INFINITY;
    ray.dir = unit((frame.camera.forward + frame.camera.right * sx) + frame.camera.down * sy);
    return ray;
}
