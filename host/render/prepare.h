// From a scene to what a device reads: the tree is built and the frame filled in.
#pragma once

#include "bvh/bvh.h"
#include "bvh/widen.h"
#include "device/device.h"
#include "render/light_table.h"
#include "scene/scene.h"

#include <memory>
#include <optional>

namespace sahl {

/// A scene with its tree. scene.primitives, objects and instances are empty: they are in bvh, the
/// primitives in leaf order. scene.objectStarts counts instances as objects, after the world's.
struct PreparedScene {
    Scene scene;
    Bvh bvh;

    /// Set for a scene that lies in a mapped file: then its arrays are read there and those of `scene`
    /// and `bvh` are empty, but for probeTexels where another probe took the place of the saved one.
    std::optional<DeviceScene> borrowed;
    std::shared_ptr<const MappedFile> file;

    LightTable lightTable;  ///< see prepareLights()
    WideTrees wide;         ///< see prepareWideTrees()

    /// The lights of the scene file: point, spot, directional.
    std::span<const Light> sceneLights() const { return borrowed ? borrowed->lights : scene.lights; }

    /// Views into this object, which must outlive the device's use of them.
    DeviceScene deviceScene() const;
};

/// Largest coordinate at which a ray of the camera may start [m]. The boxes of instances are made for
/// rays from no farther away (bvh/instances.h).
double reachOf(const Camera& camera);

/// Makes the light table, and the weights of the probe's texels, by the scene's settings. Called by those
/// who make prepared scenes; to be called again when lights, probe or settings.lightSampling change.
void prepareLights(PreparedScene& prepared);

/// Makes the trees that rays walk. Called by those who make prepared scenes.
void prepareWideTrees(PreparedScene& prepared);

/// Lets go of the binary tree where rays walk the wide one and nothing else needs it any more: hashes and
/// saving do. `nodeWidth`: of DeviceOptions.
void dropUnwalkedTree(PreparedScene& prepared, uint32_t nodeWidth);

/// Builds the tree and prepares the lights.
PreparedScene prepareScene(Scene scene, BvhBuild build, unsigned threads);

}  // namespace sahl
