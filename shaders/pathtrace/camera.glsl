// Where a camera ray starts and goes.

struct Ray
{
    vec3 org;    // [m]
    float tMax;  // where it ends [m]
    vec3 dir;    // unit
};

/// The ray through a point of the picture and a point of the lens.
///   x, y    pixels from the top left corner of the picture; a pixel's centre is at + 0.5
///   u1, u2  uniform in [0,1), for the point of the lens
Ray cameraRay(float x, float y, float u1, float u2)
{
    float sx = quotient(x * 2.0f, float(UNIFORM(width))) - 1.0f;
    float sy = quotient(y * 2.0f, float(UNIFORM(height))) - 1.0f;
    vec3 across = UNIFORM(camera.right) * sx + UNIFORM(camera.down) * sy;
    Ray ray;
    ray.tMax = RAY_INFINITY;
    if (UNIFORM(camera.type) == CAMERA_ORTHOGRAPHIC) {
        ray.org = UNIFORM(camera.position) + across;
        ray.dir = UNIFORM(camera.forward);
        return ray;
    }
    // Through a thin lens all light from one point of the plane of focus arrives at one point of the
    // picture, so every ray of a picture's point goes through the same point of that plane.
    vec2 disk = sampleDisk(u1, u2);
    vec3 onLens = UNIFORM(camera.lensRight) * disk.x + UNIFORM(camera.lensDown) * disk.y;
    vec3 toFocus = (UNIFORM(camera.forward) + across) * UNIFORM(camera.focusDistance);
    ray.org = UNIFORM(camera.position) + onLens;
    ray.dir = unit(toFocus - onLens);
    return ray;
}
