// What tells whether two pictures are of the same scene, whatever the names of their files.
#pragma once

#include "device/device.h"

namespace sahl {

struct SceneHashes {
    uint64_t scene = 0;  ///< camera, lights, surfaces: all but the tree and the settings below
    uint64_t tree =
        0;  ///< with another one the picture is the same, the work that is counted is not
};

/// XXH3 of the scene as a device reads it. Size, seed, bounces and shading, which the attributes of
/// a picture tell, are not in it; but the camera's shape is, which follows the picture's.
SceneHashes hashesOf(const DeviceScene& scene);

}  // namespace sahl
