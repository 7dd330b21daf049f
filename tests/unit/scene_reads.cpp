// By which kind of buffers kernels read a scene.
#include "device/scene_reads.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

PhysicalDevice deviceWithImages(const std::string& driver)
{
    PhysicalDevice device = {};
    device.driver = driver;
    device.rgba32uiTexelBuffers = true;
    device.rgba32uiImageBuffers = true;
    device.properties.limits.maxPerStageDescriptorStorageImages = 4;
    return device;
}

const char* const LAVAPIPE = "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)";

TEST(SceneReads, takeImagesForTexelsWhereTheDriverCallsAFunctionForThose)
{
    EXPECT_EQ(sceneReads(deviceWithImages(LAVAPIPE), true), SceneReads::images);
    EXPECT_EQ(sceneReads(deviceWithImages("NVIDIA 570.1"), true), SceneReads::texels);
}

TEST(SceneReads, areOfStorageBuffersWhereTheseAreChosen)
{
    EXPECT_EQ(sceneReads(deviceWithImages(LAVAPIPE), false), SceneReads::storage);
}

TEST(SceneReads, doWithoutImagesWhereThereAreNone)
{
    PhysicalDevice tooFew = deviceWithImages(LAVAPIPE);
    tooFew.properties.limits.maxPerStageDescriptorStorageImages = 1;
    EXPECT_EQ(sceneReads(tooFew, true), SceneReads::texels);
    PhysicalDevice withoutFormat = deviceWithImages(LAVAPIPE);
    withoutFormat.rgba32uiImageBuffers = false;
    EXPECT_EQ(sceneReads(withoutFormat, true), SceneReads::texels);
}

TEST(SceneReads, haveNodesAndPrimitivesAloneAsImages)
{
    for (uint32_t binding = 0; binding < SCENE_BUFFER_COUNT; binding++) {
        const bool ofTree = binding == BINDING_NODES || binding == BINDING_PRIMITIVES;
        EXPECT_EQ(arrayType(SceneReads::images, binding) == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, ofTree) << binding;
        EXPECT_EQ(arrayType(SceneReads::texels, binding), VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) << binding;
    }
    EXPECT_EQ(arrayType(SceneReads::storage, BINDING_NODES), VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    EXPECT_EQ(arrayType(SceneReads::storage, BINDING_INSTANCES), VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
}

}  // namespace
}  // namespace sahl::testing
