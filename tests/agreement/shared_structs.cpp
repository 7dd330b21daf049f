// Every field of every struct that crosses to the device arrives where the shader reads it.

#include "agreement/agreement_spirv.h"
#include "shared/adaptive_types.h"
#include "shared/scene_types.h"
#include "shared/wave_types.h"
#include "support/device_test.h"
#include "vulkan/run_compute.h"

namespace sahl::testing {
namespace {

class SharedStructs : public DeviceTest {};

/// Two elements of T; the words of the second are numbered onwards from `next`.
template <class T>
std::vector<std::byte> numbered(uint32_t& next, std::vector<uint32_t>& expected)
{
    std::vector<uint32_t> words(2 * sizeof(T) / 4);
    for (size_t i = words.size() / 2; i < words.size(); i++) {
        // As floats these are ordinary numbers near 1, so that no driver changes them.
        words[i] = 0x3f800000u + next++;
        expected.push_back(words[i]);
    }
    auto bytes = std::as_bytes(std::span(words));
    return {bytes.begin(), bytes.end()};
}

TEST_F(SharedStructs, areReadBackFieldByField)
{
    uint32_t next = 1;
    std::vector<uint32_t> expected;
    std::vector<std::vector<std::byte>> arrays = {
        numbered<BvhNode>(next, expected),    numbered<Primitive>(next, expected),
        numbered<TriangleCorners>(next, expected), numbered<Material>(next, expected),
        numbered<Light>(next, expected),      numbered<Frame>(next, expected),
        numbered<PixelBlock>(next, expected), numbered<SuspendedPath>(next, expected),
        numbered<ObjectInstance>(next, expected), numbered<Texture>(next, expected)};
    std::vector<std::byte> job = numbered<Dispatch>(next, expected);
    job.erase(job.begin(), job.begin() + sizeof(Dispatch));

    std::vector<uint32_t> words(expected.size());
    std::vector<std::span<std::byte>> spans(arrays.begin(), arrays.end());
    spans.push_back(std::as_writable_bytes(std::span(words)));
    auto context = openFirstContext();
    ComputeParameters parameters;
    parameters.pushConstants = job;
    runCompute(*context, testSpirv("structs"), spans, parameters);
    for (size_t i = 0; i < expected.size(); i++) EXPECT_EQ(words[i], expected[i]) << "word " << i;
}

TEST_F(SharedStructs, ofAdaptiveSamplingAreReadBackFieldByField)
{
    uint32_t next = 1;
    std::vector<uint32_t> expected;
    std::vector<std::vector<std::byte>> arrays = {numbered<AdaptivePixel>(next, expected),
                                                  numbered<AdaptiveCounts>(next, expected),
                                                  numbered<PixelEstimate>(next, expected)};
    std::vector<std::byte> job = numbered<AdaptiveDispatch>(next, expected);
    job.erase(job.begin(), job.begin() + sizeof(AdaptiveDispatch));

    std::vector<uint32_t> words(expected.size());
    std::vector<std::span<std::byte>> spans(arrays.begin(), arrays.end());
    spans.push_back(std::as_writable_bytes(std::span(words)));
    auto context = openFirstContext();
    ComputeParameters parameters;
    parameters.pushConstants = job;
    runCompute(*context, testSpirv("adaptive_structs"), spans, parameters);
    for (size_t i = 0; i < expected.size(); i++) EXPECT_EQ(words[i], expected[i]) << "word " << i;
}

TEST_F(SharedStructs, ofWavesAreReadBackFieldByField)
{
    uint32_t next = 1;
    std::vector<uint32_t> expected;
    std::vector<std::vector<std::byte>> arrays = {numbered<WaveCounts>(next, expected),
                                                  numbered<WaveWalk>(next, expected)};
    std::vector<std::byte> job = numbered<WaveDispatch>(next, expected);
    job.erase(job.begin(), job.begin() + sizeof(WaveDispatch));

    std::vector<uint32_t> words(expected.size());
    std::vector<std::span<std::byte>> spans(arrays.begin(), arrays.end());
    spans.push_back(std::as_writable_bytes(std::span(words)));
    auto context = openFirstContext();
    ComputeParameters parameters;
    parameters.pushConstants = job;
    runCompute(*context, testSpirv("wave_structs"), spans, parameters);
    for (size_t i = 0; i < expected.size(); i++) EXPECT_EQ(words[i], expected[i]) << "word " << i;
}

}  // namespace
}  // namespace sahl::testing
