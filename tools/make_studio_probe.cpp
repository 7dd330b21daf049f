// Writes a built-in probe, the studio unless named, as a picture, for other renderers and for a look at it.
#include "scene/probe.h"
#include "util/error.h"

#include <algorithm>
#include <cstdio>
#include <exception>

int main(int argc, char** argv)
{
    using namespace sahl;
    const fs::path target = argc == 2 || argc == 3 ? argv[1] : "";
    const std::string name = argc == 3 ? argv[2] : "studio";
    const bool known = std::count(BUILTIN_PROBES.begin(), BUILTIN_PROBES.end(), name) == 1;
    const bool asExr = target.extension() == ".exr";
    if (!known || (!asExr && target.extension() != ".pfm")) {
        std::fputs("usage: sahl_make_studio_probe FILE.pfm|FILE.exr [studio|cathedral|basilica]\n", stderr);
        return static_cast<int>(ErrorKind::usage);
    }
    try {
        const Image probe = makeBuiltinProbe(name);
        writeFileAtomically(target, asExr ? encodeExr(probe, {}) : encodePfm(probe));
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return static_cast<int>(error.kind);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
