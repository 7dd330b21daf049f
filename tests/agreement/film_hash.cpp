// Prints a hash of the built-in scene's film as the CPU reference computes it. The build compiles the
// reference with and without optimisation, CI with two compilers: all must print film_hash.txt.

#include "support/render_scenes.h"

#include <fmt/format.h>

namespace {

/// FNV-1a over the numbers' bytes, lowest first.
struct Hash {
    uint64_t value = 0xcbf29ce484222325u;
    void add(uint64_t number)
    {
        for (int shift = 0; shift < 64; shift += 8) value = (value ^ (number >> shift & 0xff)) * 0x100000001b3u;
    }
};

}  // namespace

int main()
{
    using namespace sahl;
    PreparedScene scene = prepareScene(builtInScene(sahl::testing::smallPicture(96, 64, 20)), BvhBuild::sweep, 2);
    Film film = sahl::testing::renderFilm(*makeCpuDevice({}), scene);
    Hash hash;
    for (const auto& half : film.half) {
        for (const HalfPixel& pixel : half) {
            for (const Fixed64x64& sum : {pixel.sum[0], pixel.sum[1], pixel.sum[2], pixel.sumY2}) {
                hash.add(sum.whole);
                hash.add(sum.fraction);
            }
            hash.add(pixel.samples);
        }
    }
    for (uint32_t digest : film.digest) hash.add(digest);
    hash.add(film.counters.boxTests);
    hash.add(film.counters.primitiveTests);
    fmt::print("{:016x}\n", hash.value);
}
