#include "vulkan/instance.h"

#include "util/messages.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace sahl {

namespace {

constexpr const char* VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";

std::atomic<uint64_t> messageCount{0};

VKAPI_ATTR VkBool32 VKAPI_CALL printMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                            VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void*)
{
    messageCount++;
    say("vulkan validation: {}\n", data->pMessage);
    return VK_FALSE;
}

// Only what the layer says: messages of type GENERAL come from the loader, about drivers that are
// installed but find no hardware, and are no fault of ours.
VkDebugUtilsMessengerCreateInfoEXT messengerInfo()
{
    auto info = vulkanStruct<VkDebugUtilsMessengerCreateInfoEXT>(
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = printMessage;
    return info;
}

void loadLibrary()
{
    // Loading once is enough, and keeps the hooks that tests put on vkGetInstanceProcAddr.
    if (vkGetInstanceProcAddr == nullptr && volkInitialize() != VK_SUCCESS)
        throw Error(ErrorKind::noDevice,
                    "no Vulkan loader found (libvulkan.so.1); install it (Debian: libvulkan1 and "
                    "mesa-vulkan-drivers) or use --device cpu");
    if (vkEnumerateInstanceVersion == nullptr)
        throw Error(ErrorKind::noDevice,
                    "the Vulkan loader only knows Vulkan 1.0, 1.1 is needed; update libvulkan1 or "
                    "use --device cpu");
}

bool hasExtension(const char* layer, const char* name)
{
    auto extensions = enumerate<VkExtensionProperties>(
        "list instance extensions", [&](uint32_t* count, VkExtensionProperties* items) {
            return vkEnumerateInstanceExtensionProperties(layer, count, items);
        });
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

void requireValidationLayer()
{
    auto layers =
        enumerate<VkLayerProperties>("list instance layers", vkEnumerateInstanceLayerProperties);
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, VALIDATION_LAYER) == 0) return;
    throw Error(ErrorKind::noDevice,
                fmt::format("validation was asked for and {} is not installed; install it (Debian: "
                            "vulkan-validationlayers) or switch validation off",
                            VALIDATION_LAYER));
}

bool validationByEnvironment()
{
    const char* value = std::getenv("SAHL_VALIDATION");
    return value != nullptr && *value != '\0' && std::strcmp(value, "0") != 0;
}

VkResult createInstance(bool validation, VkInstance* handle)
{
    auto application = vulkanStruct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "sahl";
    application.apiVersion = VK_API_VERSION_1_1;

    std::vector<const char*> extensions;
    std::vector<const char*> layers;
    auto info = vulkanStruct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    if (hasExtension(nullptr, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        info.flags |= VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    }

    VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo();
    VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto features =
        vulkanStruct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    if (validation) {
        requireValidationLayer();
        layers.push_back(VALIDATION_LAYER);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        info.pNext = &messenger;  // sees the making and unmaking of the instance itself
        if (hasExtension(VALIDATION_LAYER, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME)) {
            extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
            features.enabledValidationFeatureCount = 1;
            features.pEnabledValidationFeatures = &synchronization;
            messenger.pNext = &features;
        }
    }
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    info.enabledLayerCount = static_cast<uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    return vkCreateInstance(&info, nullptr, handle);
}

// Extension functions belong to one instance, so they are asked of it and not kept in volk's
// globals.
template <class Function>
Function instanceFunction(VkInstance instance, const char* name)
{
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

void createMessenger(Instance& instance)
{
    auto create = instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(
        instance.handle, "vkCreateDebugUtilsMessengerEXT");
    VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo();
    VkResult result = create ? create(instance.handle, &info, nullptr, &instance.messenger)
                             : VK_ERROR_EXTENSION_NOT_PRESENT;
    check(result, "create the messenger of the validation layer");
}

std::shared_ptr<Instance> makeInstance(bool validation)
{
    auto instance = std::make_shared<Instance>();
    instance->validation = validation;
    VkInstance handle = VK_NULL_HANDLE;
    VkResult result = createInstance(validation, &handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ErrorKind::noDevice,
                    "no Vulkan driver found; install one (Debian: mesa-vulkan-drivers), look at "
                    "VK_DRIVER_FILES and VK_LOADER_DRIVERS_SELECT (VK_LOADER_DEBUG=error shows "
                    "what the loader tried), or use --device cpu");
    check(result, "create Vulkan instance");
    instance->handle = handle;
    volkLoadInstance(handle);
    if (validation) createMessenger(*instance);
    return instance;
}

/// Destroys the instance when another has been closed. The loader unloads drivers with the last instance, and
/// NVIDIA's was not found any more after some dozens of times.
void destroyLater(VkInstance handle)
{
    static std::mutex mutex;
    static VkInstance last = VK_NULL_HANDLE;
    std::lock_guard lock(mutex);
    std::swap(handle, last);
    if (handle != VK_NULL_HANDLE) vkDestroyInstance(handle, nullptr);
}

}  // namespace

Instance::~Instance()
{
    if (handle == VK_NULL_HANDLE) return;
    if (messenger != VK_NULL_HANDLE) {
        auto destroy = instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(
            handle, "vkDestroyDebugUtilsMessengerEXT");
        destroy(handle, messenger, nullptr);
    }
    destroyLater(handle);
}

std::shared_ptr<Instance> openInstance(bool validation)
{
    // Shared, because volk keeps the functions of one instance only.
    static std::mutex mutex;
    static std::weak_ptr<Instance> open[2];
    std::lock_guard lock(mutex);
    validation = validation || validationByEnvironment();
    if (std::shared_ptr<Instance> instance = open[validation].lock()) return instance;
    loadLibrary();
    std::shared_ptr<Instance> instance = makeInstance(validation);
    open[validation] = instance;
    return instance;
}

uint64_t vulkanMessageCount()
{
    return messageCount;
}

}  // namespace sahl
