#include "util/memory.h"

#include "util/error.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace sahl {

namespace {

constexpr uint64_t UNLIMITED = std::numeric_limits<uint64_t>::max();

/// MemAvailable of /proc/meminfo [bytes].
uint64_t freeOnMachine()
{
    std::ifstream file("/proc/meminfo");
    std::string word;
    while (file >> word) {
        uint64_t kibibytes = 0;
        if (word == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024;
    }
    return UNLIMITED;
}

/// The number in a file that holds nothing else; "max" and a missing file are no limit.
uint64_t numberIn(const std::string& path)
{
    std::ifstream file(path);
    uint64_t number = 0;
    return file >> number ? number : UNLIMITED;
}

/// The least limit of the process's control groups, from its own up to the root [bytes].
uint64_t controlGroupLimit()
{
    uint64_t limit = UNLIMITED;
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        size_t controllers = line.find(':');
        size_t path = line.find(':', controllers + 1);
        if (path == std::string::npos) continue;
        bool unified = line.substr(controllers, 2) == "::";
        if (!unified && line.find("memory") > path) continue;
        std::string root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        std::string name = unified ? "/memory.max" : "/memory.limit_in_bytes";
        std::string group = line.substr(path + 1);
        while (true) {
            limit = std::min(limit, numberIn(root + group + name));
            size_t slash = group.rfind('/');
            if (slash == std::string::npos || group == "/") break;
            group.resize(slash);
        }
    }
    return limit;
}

uint64_t addressSpaceLimit()
{
    rlimit limit = {};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return UNLIMITED;
    return limit.rlim_cur;
}

double gibibytes(uint64_t bytes)
{
    return double(bytes) / double(uint64_t{1} << 30);
}

}  // namespace

uint64_t availableMemory()
{
    return std::min({freeOnMachine(), controlGroupLimit(), addressSpaceLimit()});
}

void returnLargeBlocks()
{
#ifdef __GLIBC__
    // Left alone, glibc raises the first of these to 32 MiB as soon as blocks that large are freed.
    mallopt(M_MMAP_THRESHOLD, 8 << 20);
    mallopt(M_TRIM_THRESHOLD, 16 << 20);
#endif
}

void returnFreedMemory()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

void requireMemory(uint64_t bytes, const std::string& what, const std::string& help)
{
    uint64_t available = availableMemory();
    if (bytes <= available) return;
    throw Error(ErrorKind::deviceLost,
                fmt::format("{} needs {:.1f} GiB of memory, {:.1f} GiB are available; {}", what,
                            gibibytes(bytes), gibibytes(available), help));
}

}  // namespace sahl
