// Phong's shading out of the textbook, in double precision: one ray through the centre of each
// pixel, brute force. Like the textbook tracer it shares no line with what it is a witness for.
#pragma once

#include "oracle/textbook.h"

namespace textbook {

struct PhongMaterial {
    Vec emission;
    Vec ambient;   ///< ka
    Vec diffuse;   ///< kd
    Vec specular;  ///< ks
    double exponent = 1;
};

struct PhongWorld {
    World world;                           ///< its materials are not looked at
    std::vector<PhongMaterial> materials;  ///< in their place
    Vec ambient;                           ///< La
    bool ambientTerm = true, diffuseTerm = true, specularTerm = true;
    bool shadows = false;
    bool flat = false;  ///< the triangles' own normals in place of interpolated ones
};

/// Radiance of every pixel, top row first. The camera has no lens.
std::vector<Vec> renderPhong(const PhongWorld& phong);

}  // namespace textbook
