// Pictures for the witnesses' scripts, which have no reader of EXR files of their own.
//   read FILE [CHANNEL...]   to stdout: a line "WIDTH HEIGHT", R G B of every pixel, then the
//                            channels, float32 as this machine has it, top row first
//   write FILE WIDTH HEIGHT [CHANNEL...]   from stdin the same without the line, into an EXR file
// Exit code 3: a file cannot be used.

#include "image/exr_layers.h"
#include "image/image.h"
#include "util/error.h"

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace sahl {
namespace {

using Names = std::vector<std::string>;

void put(std::span<const float> values)
{
    if (std::fwrite(values.data(), sizeof(float), values.size(), stdout) != values.size()) {
        throw badInput("stdout: cannot be written");
    }
}

std::vector<float> take(size_t count)
{
    std::vector<float> values(count);
    if (std::fread(values.data(), sizeof(float), count, stdin) != count) {
        throw badInput("stdin: too few values");
    }
    return values;
}

void read(const fs::path& file, const Names& channels)
{
    Image image = readImage(file);
    std::printf("%u %u\n", image.width, image.height);
    put(image.rgb);
    if (channels.empty()) return;
    ExrPlanes planes = readExrPlanes(file, describeExr(file), channels);
    std::span<const uint32_t> words = planes.words();
    std::vector<float> values(words.size());
    std::memcpy(values.data(), words.data(), words.size_bytes());
    put(values);
}

void write(const fs::path& file, uint32_t width, uint32_t height, const Names& channels)
{
    const size_t pixels = size_t{width} * height;
    Image image = {width, height, take(3 * pixels)};
    std::vector<ImageChannel> more;
    for (const std::string& name : channels) more.push_back({name, take(pixels)});
    writeFileAtomically(file, encodeExr(image, {}, more));
}

void run(const Names& arguments)
{
    const size_t count = arguments.size();
    if (count >= 2 && arguments[0] == "read") {
        read(arguments[1], {arguments.begin() + 2, arguments.end()});
    } else if (count >= 4 && arguments[0] == "write") {
        auto side = [](const std::string& text) { return static_cast<uint32_t>(std::stoul(text)); };
        write(arguments[1], side(arguments[2]), side(arguments[3]),
              {arguments.begin() + 4, arguments.end()});
    } else {
        throw badInput("usage: read FILE [CHANNEL...] | write FILE WIDTH HEIGHT [CHANNEL...]");
    }
}

}  // namespace
}  // namespace sahl

int main(int argc, char** argv)
{
    try {
        sahl::run({argv + 1, argv + argc});
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "%s\n", fault.what());
        return 3;
    }
    return 0;
}
