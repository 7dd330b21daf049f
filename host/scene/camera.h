// Cameras for scenes that describe none.
#pragma once

#include "scene/scene.h"

namespace sahl {

/// Looks at all triangles from the front right and slightly above, so that the whole of their box
/// lies inside a picture of the scene's size with a margin. CameraDescription's own defaults when
/// there are no triangles.
CameraDescription frameTriangles(const Scene& scene);

}  // namespace sahl
