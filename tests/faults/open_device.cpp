// Opens the device that its argument names and says what came of it; a program of its own, so that
// the tests can run it in broken environments.
//   on stdout: KIND of the opened device, then the note; on stderr: the error. Exit code: the
//   error's.
#include "device/device.h"
#include "util/error.h"

int main(int argumentCount, char** arguments)
{
    try {
        std::string note;
        auto device = sahl::openDevice(argumentCount > 1 ? arguments[1] : "auto", {}, note);
        fmt::print("{}: {}\n", device->info().kind, note);
        return 0;
    } catch (const sahl::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.kind);
    }
}
