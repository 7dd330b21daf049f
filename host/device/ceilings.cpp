#include "device/ceilings.h"

#include "kernels/spirv.h"
#include "shared/ceiling_types.h"
#include "util/error.h"
#include "vulkan/pipeline.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

constexpr uint64_t WANTED_BYTES = uint64_t{256} << 20;
constexpr uint64_t TEXEL_BYTES = 16;
constexpr uint32_t INVOCATIONS = 1 << 18;           // fill any device
constexpr uint32_t SOFTWARE_INVOCATIONS = 1 << 14;  // where they only cost
constexpr uint32_t ROUNDS = 256;  // of arithmetic in a dispatch: far below lavapipe's cap of loops
constexpr uint32_t MOST_DISPATCHES = 1 << 16;

struct Kernel {
    const char* name;
    const char* spirv;
    double workPerInvocation;  // bytes or operations
};

struct Bench {
    Context& context;
    CeilingJob job;
    Buffer source, target;
};

uint64_t bufferBytes(const PhysicalDevice& device)
{
    const uint64_t most =
        std::min<uint64_t>({WANTED_BYTES, device.properties.limits.maxStorageBufferRange,
                            device.maxAllocationBytes, mainHeapBytes(device) / 4});
    uint64_t bytes = uint64_t{INVOCATIONS} * TEXEL_BYTES;
    while (2 * bytes <= most) bytes *= 2;
    return bytes;
}

Bench makeBench(Context& context)
{
    const uint64_t bytes = bufferBytes(context.physical);
    CeilingJob job = {};
    job.invocations = context.physical.kind == "software" ? SOFTWARE_INVOCATIONS : INVOCATIONS;
    job.elements = static_cast<uint>(bytes / TEXEL_BYTES);
    job.rounds = ROUNDS;
    job.factor = 0.999f;
    job.summand = 0.001f;
    const VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    Bench bench = {context, job,
                   createBuffer(context, {"ceiling source", bytes, usage, HostUse::none}),
                   createBuffer(context, {"ceiling target", bytes, usage, HostUse::none})};
    // Memory that nobody wrote to may not be there yet.
    runCommands(context, "fill the buffers of ceilings", [&](VkCommandBuffer commands) {
        for (const Buffer* buffer : {&bench.source, &bench.target})
            vkCmdFillBuffer(commands, buffer->handle.get(), 0, bytes, 0x3f800001u);
        recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
    });
    return bench;
}

double secondsOf(const Bench& bench, const ComputePipeline& pipeline, uint32_t dispatches)
{
    const auto start = std::chrono::steady_clock::now();
    runCommands(bench.context, pipeline.name, [&](VkCommandBuffer commands) {
        for (uint32_t i = 0; i < dispatches; i++) {
            if (i > 0) recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
            recordDispatch(commands, pipeline, std::as_bytes(std::span(&bench.job, 1)),
                           {bench.job.invocations / CEILING_GROUP, 1, 1});
        }
    });
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    return seconds.count();
}

Ceiling measure(const Bench& bench, const Kernel& kernel, double seconds, uint32_t rounds)
{
    PipelineRequest request;
    request.name = std::string("ceiling of ") + kernel.name;
    request.spirv = kernelSpirv(kernel.spirv);
    request.bindings.assign(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    request.pushConstantBytes = sizeof(CeilingJob);
    ComputePipeline pipeline = createComputePipeline(bench.context, request);
    const std::array<const Buffer*, 2> buffers = {&bench.source, &bench.target};
    bindBuffers(bench.context, pipeline, buffers);

    secondsOf(bench, pipeline, 1);  // drivers compile when a kernel first runs
    uint32_t dispatches = 1;
    while (dispatches < MOST_DISPATCHES && secondsOf(bench, pipeline, dispatches) < seconds / 2)
        dispatches *= 2;
    Ceiling ceiling = {
        kernel.name, {}, kernel.workPerInvocation * bench.job.invocations * dispatches, ""};
    for (uint32_t round = 0; round < rounds; round++)
        ceiling.seconds.push_back(secondsOf(bench, pipeline, dispatches));
    return ceiling;
}

}  // namespace

double Ceiling::rate() const
{
    return seconds.empty() ? 0 : work / *std::min_element(seconds.begin(), seconds.end());
}

Ceilings measureCeilings(uint32_t index, double seconds, uint32_t rounds)
{
    std::shared_ptr<Instance> instance = openInstance(false);
    const std::vector<PhysicalDevice> devices = physicalDevices(*instance);
    if (index >= devices.size())
        throw Error(ErrorKind::noDevice,
                    fmt::format("there is no Vulkan device {}: {} found", index, devices.size()));
    if (!devices[index].unusable.empty())
        throw Error(ErrorKind::noDevice, fmt::format("device {}, '{}', cannot be used: {}", index,
                                                     devices[index].name, devices[index].unusable));
    const std::unique_ptr<Context> context = openContext(instance, devices[index]);
    const Bench bench = makeBench(*context);
    const double bytes = double(bench.source.bytes) / bench.job.invocations;
    const double operations = double(CEILING_OPERATIONS) * bench.job.rounds;
    const Kernel kernels[] = {{"read", "ceiling_read", bytes},
                              {"copy", "ceiling_copy", 2 * bytes},
                              {"arithmetic", "ceiling_arithmetic", operations},
                              {"fused", "ceiling_fused", operations}};
    Ceilings ceilings = {devices[index].name, devices[index].driver, bench.source.bytes, {}};
    for (const Kernel& kernel : kernels) {
        try {
            ceilings.measured.push_back(measure(bench, kernel, seconds, rounds));
        } catch (const Error& error) {
            ceilings.measured.push_back({kernel.name, {}, 0, error.what()});
            if (context->notResponding) break;
        }
    }
    return ceilings;
}

}  // namespace sahl
