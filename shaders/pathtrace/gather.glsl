// How light that a path has found is added to its sample: as it is, or clamped.

/// Adds radiance that was scattered so many times on its way from a light to the camera. Light that was
/// scattered more than once is cut to the luminance frame.clampIndirect, if that is not 0: less noise for
/// too dark a picture.
void gather(vec3 L, uint scatterings, INOUT(PathState) path)
{
    if (UNIFORM(clampIndirect) > 0.0f && scatterings > 1u) {
        float y = luminance(L);
        if (y > UNIFORM(clampIndirect)) {
            L = L * quotient(UNIFORM(clampIndirect), y);
            tally.clamped++;
        }
    }
    path.L = path.L + L;
}
