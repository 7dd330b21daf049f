// Lets AddressSanitizer look for leaks of ours in programs that use a Vulkan driver. Drivers leak a
// little with every instance, and a leak whose library has been unloaded by the end of the program
// cannot be told from ours: so drivers and layers are kept loaded, and leaks from within them
// ignored.
#if defined(__SANITIZE_ADDRESS__)
#define SAHL_LEAK_CHECK
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SAHL_LEAK_CHECK
#endif
#endif

#ifdef SAHL_LEAK_CHECK

#include "util/error.h"
#include "vulkan/instance.h"

#include <gtest/gtest.h>

#include <dlfcn.h>
#include <link.h>

namespace {

int keepLoaded(dl_phdr_info* library, size_t, void*)
{
    // The flag stays with the library; the handle itself is of no use.
    dlopen(library->dlpi_name, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
}

class KeepDrivers : public ::testing::Environment {
    void SetUp() override
    {
        try {
            auto instance = sahl::openInstance(true);
            dl_iterate_phdr(keepLoaded, nullptr);
        } catch (const sahl::Error&) {
            // No driver or layer: the tests say so themselves.
        }
    }
};

[[maybe_unused]] auto* keepDrivers = ::testing::AddGlobalTestEnvironment(new KeepDrivers);

}  // namespace

extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libvulkan_\n"  // Mesa's drivers
           "leak:libvk_swiftshader\n"
           "leak:libLLVM\n"
           "leak:libVkLayer_\n";
}

#endif
