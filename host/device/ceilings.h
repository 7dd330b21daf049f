// What a Vulkan device can do at most, measured: for saying how near to that a kernel comes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// One of the things measured.
struct Ceiling {
    const char* name;             ///< "read", "copy", "arithmetic" or "fused"
    std::vector<double> seconds;  ///< of the rounds [s]
    double work = 0;              ///< of a round: bytes read and written, or operations
    std::string failure;          ///< why it could not be measured; then the rest says nothing

    /// Of the fastest round: bytes or operations a second.
    double rate() const;
};

struct Ceilings {
    std::string device, driver;
    uint64_t bufferBytes = 0;       ///< that are read, and written to
    std::vector<Ceiling> measured;  ///< in the order above
};

/// Measures
///   read        of a buffer, far larger than caches where the device allows that
///   copy        to another buffer; bytes are counted twice
///   arithmetic  multiplying and adding, as our kernels are made: neither is fused with the other
///   fused       the same where the driver may fuse both into one operation, counted as two
/// each `rounds` times, for at least `seconds` at a time; a first time does not count. What fails
/// is told in its place. Throws noDevice where the device cannot be opened.
///   index  of listVulkanDevices()
Ceilings measureCeilings(uint32_t index, double seconds, uint32_t rounds);

}  // namespace sahl
