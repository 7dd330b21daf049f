// Embree's functions, found in its library when first asked for. Read by embree*.cpp only.
#pragma once

#include <embree3/rtcore.h>

namespace sahl {

struct EmbreeLibrary {
    decltype(&::rtcNewDevice) newDevice = nullptr;
    decltype(&::rtcReleaseDevice) releaseDevice = nullptr;
    decltype(&::rtcGetDeviceProperty) getDeviceProperty = nullptr;
    decltype(&::rtcNewScene) newScene = nullptr;
    decltype(&::rtcReleaseScene) releaseScene = nullptr;
    decltype(&::rtcSetSceneBuildQuality) setSceneBuildQuality = nullptr;
    decltype(&::rtcCommitScene) commitScene = nullptr;
    decltype(&::rtcNewGeometry) newGeometry = nullptr;
    decltype(&::rtcSetNewGeometryBuffer) setNewGeometryBuffer = nullptr;
    decltype(&::rtcCommitGeometry) commitGeometry = nullptr;
    decltype(&::rtcAttachGeometry) attachGeometry = nullptr;
    decltype(&::rtcReleaseGeometry) releaseGeometry = nullptr;
    decltype(&::rtcIntersect1) intersect1 = nullptr;
    decltype(&::rtcOccluded1) occluded1 = nullptr;
    decltype(&::rtcNewBVH) newBvh = nullptr;
    decltype(&::rtcBuildBVH) buildBvh = nullptr;
    decltype(&::rtcReleaseBVH) releaseBvh = nullptr;
    decltype(&::rtcThreadLocalAlloc) threadLocalAlloc = nullptr;
};

/// Null where the library or one of the functions is missing.
const EmbreeLibrary* embreeLibrary();

}  // namespace sahl
