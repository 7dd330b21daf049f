// Fork, confine, run, wait. Confinement: resource limits everywhere, and a filter of system calls
// where the kernel offers one.
#include "image/isolated.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

namespace sahl {

namespace {

constexpr int EXIT_DONE = 0;
constexpr int EXIT_THREW = 1;

constexpr unsigned CLOCK_PER_CPU = 10;  // a busy machine must not look like a hanging decoder
constexpr size_t MESSAGE_BYTES = 512;

void limitResource(decltype(RLIMIT_CPU) resource, uint64_t value)
{
    rlimit limit = {};
    if (::getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max = std::min<rlim_t>(value, limit.rlim_max);
    ::setrlimit(resource, &limit);
}

/// Bytes of address space in use. A limit on it must come on top of what the parent had mapped:
/// graphics drivers and sanitizers reserve terabytes.
uint64_t addressSpaceInUse()
{
    char text[32] = {};
    int fd = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (fd < 0) return 0;
    ssize_t got = ::read(fd, text, sizeof text - 1);
    ::close(fd);
    uint64_t pages = got > 0 ? std::strtoull(text, nullptr, 10) : 0;
    return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

#if defined(__x86_64__)
constexpr uint32_t MACHINE = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr uint32_t MACHINE = AUDIT_ARCH_AARCH64;
#else
constexpr uint32_t MACHINE = 0;  // not tried out there
#endif

/// From now on every system call fails with EPERM but those that memory, the clock, signals and the
/// end of a process need, and those on open files: there is none but /dev/null, and sanitizers
/// probe memory through pipes. Kernels without filters refuse, and the resource limits have to do.
void forbidSystemCalls()
{
    constexpr std::array allowed = {
        SYS_mmap,        SYS_munmap,        SYS_mremap,       SYS_mprotect,
        SYS_madvise,     SYS_brk,           SYS_futex,        SYS_exit,
        SYS_exit_group,  SYS_clock_gettime, SYS_getpid,       SYS_gettid,
        SYS_tgkill,      SYS_rt_sigreturn,  SYS_rt_sigaction, SYS_rt_sigprocmask,
        SYS_sigaltstack, SYS_pipe2,         SYS_read,         SYS_write,
        SYS_close,
    };
    std::vector<sock_filter> program = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, MACHINE, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
    };
    for (auto call : allowed) {
        program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<uint32_t>(call), 0, 1));
        program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    }
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
    const sock_fprog filter = {static_cast<unsigned short>(program.size()), program.data()};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) {
        ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
    }
}

/// /dev/null instead of the standard streams (glibc reports damaged heaps there), nothing else
/// open.
void closeFiles()
{
    int null = ::open("/dev/null", O_RDWR);
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (null < 0 || ::dup2(null, stream) < 0) ::close(stream);
    }
    constexpr int first = STDERR_FILENO + 1;
    if (::close_range(first, ~0u, 0) != 0) {
        for (int fd = first; fd < 1024; fd++) ::close(fd);
    }
}

/// Makes this child harmless. What may be inherited from the parent (handlers that would print a
/// report, buffered output) is put out of reach.
void confine(const IsolatedLimits& limits)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGXCPU}) {
        ::signal(signal, SIG_DFL);
    }
    // Ctrl-C reaches the whole process group; the parent decides what it means.
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
    closeFiles();

    limitResource(RLIMIT_CORE, 0);
    limitResource(RLIMIT_FSIZE, 0);
    limitResource(RLIMIT_CPU, limits.cpuSeconds);
    if (uint64_t used = addressSpaceInUse(); used > 0) {
        limitResource(RLIMIT_AS, used + limits.extraMemory);
    }
    ::alarm(limits.cpuSeconds * CLOCK_PER_CPU);
    if (MACHINE != 0) forbidSystemCalls();
}

/// Copies what was thrown, printable characters only: it may quote the file.
void storeMessage(std::span<uint8_t> message, const char* text)
{
    for (size_t i = 0; i + 1 < message.size() && text[i] != '\0'; i++) {
        message[i] = text[i] >= ' ' && text[i] <= '~' ? static_cast<uint8_t>(text[i]) : '?';
    }
}

[[noreturn]] void runChild(const IsolatedLimits& limits, const std::function<void()>& work,
                           std::span<uint8_t> message)
{
    int status = EXIT_THREW;
    try {
        confine(limits);
        work();
        status = EXIT_DONE;
    } catch (const std::bad_alloc&) {
        storeMessage(message, "it needs more memory than a picture of this size should");
    } catch (const std::exception& error) {
        storeMessage(message, error.what());
    } catch (...) {
        storeMessage(message, "the decoder failed");
    }
    ::_exit(status);  // not exit(): buffers and handlers are the parent's
}

std::string describeEnd(int status, unsigned cpuSeconds, const char* message)
{
    if (WIFEXITED(status)) {
        if (WEXITSTATUS(status) == EXIT_DONE) return "";
        return *message != '\0' ? message : "the decoder failed on it: the file is damaged";
    }
    int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL) {
        return fmt::format("the decoder was stopped after {} s: the file is damaged", cpuSeconds);
    }
    return fmt::format("the decoder crashed on it ({}): the file is damaged", ::strsignal(signal));
}

}  // namespace

SharedMemory::SharedMemory(size_t bytes) : data_(nullptr), size_(bytes)
{
    void* memory =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<uint8_t*>(memory);
}

SharedMemory::~SharedMemory()
{
    ::munmap(data_, size_);
}

std::string runIsolated(const IsolatedLimits& limits, const std::function<void()>& work)
{
    SharedMemory message(MESSAGE_BYTES);
    pid_t child = ::fork();
    if (child < 0) return fmt::format("no process to decode it in: {}", std::strerror(errno));
    if (child == 0) runChild(limits, work, message.bytes());

    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR)
            return fmt::format("lost the process that decodes it: {}", std::strerror(errno));
    }
    message.bytes().back() = 0;
    return describeEnd(status, limits.cpuSeconds,
                       reinterpret_cast<const char*>(message.bytes().data()));
}

}  // namespace sahl
