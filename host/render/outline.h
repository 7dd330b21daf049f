// What can be told of a scene before its tree is built.
#pragma once

#include "device/device.h"
#include "scene/scene.h"

namespace sahl {

/// For Device::expectScene(). A guess where only the light table knows: what shines may have no surface, and a
/// probe may be black.
SceneOutline outlineOf(const Scene& scene);

}  // namespace sahl
