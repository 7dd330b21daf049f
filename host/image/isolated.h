// Work on untrusted input in a child process: a crash, hang or memory fault there becomes a text
// here. Nothing the work does reaches this process but what it writes into shared memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace sahl {

/// Zeroed memory that a forked child and its parent both see.
class SharedMemory {
public:
    explicit SharedMemory(size_t bytes);  ///< throws std::bad_alloc
    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    std::span<uint8_t> bytes() const { return {data_, size_}; }

private:
    uint8_t* data_;
    size_t size_;
};

struct IsolatedLimits {
    unsigned cpuSeconds = 1;   ///< processor time; ten times as much on the clock
    uint64_t extraMemory = 0;  ///< bytes above what the process has now
};

/// Runs `work` in a forked child that may compute, use that much more memory and end: no files, no
/// network, no programs. Returns "" when `work` returned, else a text for the user that says what
/// stopped it: what it threw, a crash, or a limit. `work` must start no thread.
std::string runIsolated(const IsolatedLimits& limits, const std::function<void()>& work);

}  // namespace sahl
