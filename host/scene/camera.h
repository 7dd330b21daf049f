// Cameras as people describe them, and cameras for scenes that describe none.
#pragma once

#include "scene/scene.h"

namespace sahl {

/// Unit direction in which the camera looks. Throws badInput as makeCamera does.
glm::dvec3 viewDirection(const CameraDescription& description);

/// Looks at all primitives from the front right and slightly above, so that the whole of their box
/// lies inside a picture of the scene's size with a margin. CameraDescription's own defaults when
/// there are no primitives.
CameraDescription framePrimitives(const Scene& scene);

}  // namespace sahl
