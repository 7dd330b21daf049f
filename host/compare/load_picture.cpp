// Pictures from files of every kind that a comparison takes.
#include "compare/compare.h"
#include "film/replicates.h"
#include "image/exr_layers.h"
#include "image/png_read.h"
#include "image/tone_map.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>

namespace sahl {

namespace {

/// The first bytes tell what a file is; its name may say anything.
std::string formatOf(const fs::path& path)
{
    std::array<char, 4> head = {};
    std::ifstream(path, std::ios::binary).read(head.data(), head.size());
    const std::string_view magic(head.data(), head.size());
    if (magic == "\x89PNG") return "PNG";
    if (magic == "\x76\x2f\x31\x01") return "EXR";
    if (magic.starts_with("PF") || magic.starts_with("Pf")) return "PFM";
    return magic.starts_with("#?") ? "HDR" : "packed";
}

void readPngInto(const fs::path& path, LoadedPicture& picture)
{
    PngPicture png = readPngPicture(path);
    if (png.hadAlpha) warn(fmt::format("{}: its alpha is left out", path.string()));
    picture.displayReferred = true;
    picture.image = std::move(png.srgb);
    picture.metadata = std::move(png.metadata);
    for (float& value : picture.image.rgb) value = static_cast<float>(linearFromSrgb(value));
}

/// A channel of the file; empty when it has none of that name that holds floats.
std::vector<float> readLayer(const fs::path& path, const ExrDescription& described,
                             const std::string& name)
{
    const auto found = described.channels.find(name);
    if (found == described.channels.end() || found->second.kind != ExrKind::real ||
        !found->second.fullResolution) {
        return {};
    }
    const ExrPlanes planes = readExrPlanes(path, described, {&name, 1});
    std::vector<float> values;
    values.reserve(planes.words().size());
    for (uint32_t word : planes.words()) values.push_back(std::bit_cast<float>(word));
    return values;
}

void readLayersInto(const fs::path& path, LoadedPicture& picture)
{
    const ExrDescription described = describeExr(path);
    if (described.width != picture.image.width || described.height != picture.image.height) {
        throw badInput("{}: is another file than a moment ago; try again", path.string());
    }
    picture.variance = readLayer(path, described, "variance.Y");
    picture.samples = readLayer(path, described, "samples.Y");
    picture.metadata = described.metadata;
}

}  // namespace

double LoadedPicture::replicates(size_t pixel) const
{
    const auto over = metadata.find("sahl.varianceOver");
    const uint32_t size = over != metadata.end() ? replicateSizeIn(over->second) : 1;
    return std::ceil(samples[pixel] / static_cast<float>(size));
}

LoadedPicture loadPicture(const fs::path& path)
{
    requireRegularFile(path);
    LoadedPicture picture;
    picture.name = path.string();
    picture.format = formatOf(path);
    if (picture.format == "PNG") {
        readPngInto(path, picture);
        return picture;
    }
    picture.image = readImage(path);
    if (picture.format == "EXR") readLayersInto(path, picture);
    if (picture.format == "packed") {
        warn(fmt::format(
            "{}: of a packed picture only R, G and B are read; unpack it for a verdict by its "
            "variance",
            path.string()));
    }
    return picture;
}

}  // namespace sahl
