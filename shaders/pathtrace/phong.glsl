// The phong integrator: what a surface shows of ambient light and of the lights, without bounces.
//
//   L = Le + ka La + sum over the lights of (kd max(0, n.l) + ks max(0, r.v)^s) E / pi
//
// Phong 1975, "Illumination for Computer Generated Pictures", CACM 18(6). E is the irradiance of a
// surface that faces the light, so E / pi is the radiance of a white one: kd means what it means to
// the path integrator. The highlight is not normalised: a larger s makes it smaller and no brighter.
//
// n is the normal as the mesh has it, whichever side is seen, so both sides of a surface look alike.
// One light is taken at a time, because a path has one shadow ray: PHASE_LIGHT, then PHASE_SHADOW
// where a shadow ray is needed, then the next light.

bool shadingHas(uint bit) { return (UNIFORM(shading) & bit) != 0u; }

/// What one light that is seen gives to the viewer by way of a surface. Nothing from a light on the
/// side that n does not point to.
///   wo  unit direction to the viewer
vec3 phongReflection(READ(Material) material, vec3 n, vec3 wo, READ(LightSample) ls)
{
    float cosine = dot3(ls.wi, n);
    if (!(cosine > 0.0f)) return vec3(0.0f);
    vec3 f = vec3(0.0f);
    if (shadingHas(SHADING_DIFFUSE)) {
        f = material.baseColor * (diffuseShare(material) * (cosine * INV_PI));
    }
    if (shadingHas(SHADING_SPECULAR)) {
        float cosR = dot3(reflected(-ls.wi, n), wo);
        float lobe = power(min2(1.0f, max2(0.0f, cosR)), material.shininess);
        f = f + material.specularColor * (lobe * INV_PI);
    }
    return flushed3(flushed3(f) * ls.Li);
}

/// Whether the surface itself keeps light from wi off the side that its shading normal points to.
bool shadowsItself(READ(SurfaceInteraction) isect, vec3 wi)
{
    vec3 ng = dot3(isect.ng, isect.nsStored) < 0.0f ? -isect.ng : isect.ng;
    return !(dot3(wi, ng) > 0.0f);
}

/// The next light's turn, or the end after the last.
void passLight(INOUT(PathState) path)
{
    path.depth++;
    path.phase = path.depth < UNIFORM(lightCount) ? PHASE_LIGHT : PHASE_ENDED;
}

/// Adds what one light gives, or sends a shadow ray whose arrival will add it.
void shadeNextLight(READ(SurfaceInteraction) isect, READ(Material) material, INOUT(PathState) path)
{
    LightSample ls = illuminate(loadLight(path.depth), isect.p);
    path.Ld = phongReflection(material, isect.nsStored, -path.dir, ls);
    if (!shadingHas(SHADING_SHADOWS)) {
        path.L = path.L + path.Ld;
        passLight(path);
    } else if (maxComponent(path.Ld) > 0.0f && !shadowsItself(isect, ls.wi)) {
        aimShadowRay(isect, ls, path);
        path.phase = PHASE_SHADOW;
    } else {
        passLight(path);
    }
}

/// What happens at a surface: when the camera ray arrives emission and ambient light, then and in
/// every PHASE_LIGHT the next light.
void shadePhong(READ(SurfaceInteraction) isect, READ(Material) material, READ(Traversal) hit, INOUT(PathState) path)
{
    if (path.phase == PHASE_EXTEND) {
        tally.bounces++;
        path.hit = hit;
        path.L = path.L + material.emission;
        if (shadingHas(SHADING_AMBIENT)) {
            path.L = path.L + flushed3(material.ambientColor * UNIFORM(ambient));
        }
    }
    if (path.depth < UNIFORM(lightCount)) {
        shadeNextLight(isect, material, path);
    } else {
        path.phase = PHASE_ENDED;
    }
}
