// Writes the built-in studio probe as a picture, for other renderers and for a look at it.
#include "scene/probe.h"
#include "util/error.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv)
{
    using namespace sahl;
    const fs::path target = argc == 2 ? argv[1] : "";
    const bool asExr = target.extension() == ".exr";
    if (!asExr && target.extension() != ".pfm") {
        std::fputs("usage: sahl_make_studio_probe studio.pfm|studio.exr\n", stderr);
        return static_cast<int>(ErrorKind::usage);
    }
    try {
        const Image studio = makeStudioProbe(STUDIO_WIDTH, STUDIO_HEIGHT);
        writeFileAtomically(target, asExr ? encodeExr(studio, {}) : encodePfm(studio));
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return static_cast<int>(error.kind);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
