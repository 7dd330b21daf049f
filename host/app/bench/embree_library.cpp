#include "app/bench/embree_library.h"

#include "app/bench/embree.h"

#include <fmt/format.h>

#include <type_traits>

#include <dlfcn.h>

namespace sahl {

namespace {

constexpr const char* FILE_NAME = "libembree3.so.3";

bool findAll(void* file, EmbreeLibrary& library)
{
    auto find = [file](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(file, name));
        return function != nullptr;
    };
    return find(library.newDevice, "rtcNewDevice") && find(library.releaseDevice, "rtcReleaseDevice") &&
           find(library.getDeviceProperty, "rtcGetDeviceProperty") &&
           find(library.newScene, "rtcNewScene") && find(library.releaseScene, "rtcReleaseScene") &&
           find(library.setSceneBuildQuality, "rtcSetSceneBuildQuality") &&
           find(library.commitScene, "rtcCommitScene") && find(library.newGeometry, "rtcNewGeometry") &&
           find(library.setNewGeometryBuffer, "rtcSetNewGeometryBuffer") &&
           find(library.commitGeometry, "rtcCommitGeometry") &&
           find(library.attachGeometry, "rtcAttachGeometry") &&
           find(library.releaseGeometry, "rtcReleaseGeometry") &&
           find(library.intersect1, "rtcIntersect1") && find(library.occluded1, "rtcOccluded1") &&
           find(library.newBvh, "rtcNewBVH") && find(library.buildBvh, "rtcBuildBVH") &&
           find(library.releaseBvh, "rtcReleaseBVH") &&
           find(library.threadLocalAlloc, "rtcThreadLocalAlloc");
}

}  // namespace

const EmbreeLibrary* embreeLibrary()
{
    static const EmbreeLibrary* const found = []() -> const EmbreeLibrary* {
        static EmbreeLibrary library;
        void* const file = dlopen(FILE_NAME, RTLD_NOW | RTLD_LOCAL);  // stays until the end of the process
        return file != nullptr && findAll(file, library) ? &library : nullptr;
    }();
    return found;
}

std::string embreeVersion()
{
    const EmbreeLibrary* const library = embreeLibrary();
    if (library == nullptr) return {};
    RTCDevice device = library->newDevice("threads=1");
    const long version = library->getDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
    library->releaseDevice(device);
    return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

std::string whyNoEmbree()
{
    if (embreeLibrary() != nullptr) return {};
    return fmt::format("{} cannot be loaded; install Embree 3 (libembree3-3)", FILE_NAME);
}

}  // namespace sahl
