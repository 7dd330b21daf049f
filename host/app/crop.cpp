#include "app/crop.h"

#include "app/option_kinds.h"
#include "util/error.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr uint32_t MAX_SIDE = 32768;

CropWindow parseCrop(const std::string& text)
{
    std::vector<std::string> parts = CLI::detail::split(text, ',');
    if (parts.size() != 4) {
        throw CLI::ValidationError(
            fmt::format("--crop '{}' is no window; give X,Y,W,H in pixels, X and Y of its top left "
                        "corner",
                        text));
    }
    CropWindow crop;
    crop.x = parseNumber("--crop", parts[0], {0, MAX_SIDE - 1});
    crop.y = parseNumber("--crop", parts[1], {0, MAX_SIDE - 1});
    crop.width = parseNumber("--crop", parts[2], {1, MAX_SIDE});
    crop.height = parseNumber("--crop", parts[3], {1, MAX_SIDE});
    return crop;
}

}  // namespace

void addCropOption(CLI::App& command, std::optional<CropWindow>& crop)
{
    auto set = [&crop](const std::string& text) { crop = parseCrop(text); };
    command
        .add_option_function<std::string>(
            "--crop", set,
            withDefault("render only this window [pixels], from the top left;\n"
                        "its pixels are those of the full picture",
                        "all"))
        ->type_name("X,Y,W,H")
        ->group("Picture");
}

CropWindow clipCrop(const std::optional<CropWindow>& crop, uint32_t width, uint32_t height)
{
    if (!crop) return {0, 0, width, height};
    if (crop->x >= width || crop->y >= height) {
        throw usageError("--crop {} lies outside the picture of {} x {} pixels", cropText(*crop),
                         width, height);
    }
    CropWindow clipped = *crop;
    clipped.width = std::min(crop->width, width - crop->x);
    clipped.height = std::min(crop->height, height - crop->y);
    if (clipped.width != crop->width || clipped.height != crop->height) {
        warn(fmt::format("--crop {} reaches beyond the picture of {} x {} pixels; {} is rendered",
                         cropText(*crop), width, height, cropText(clipped)));
    }
    return clipped;
}

std::string cropText(const CropWindow& crop)
{
    return fmt::format("{},{},{},{}", crop.x, crop.y, crop.width, crop.height);
}

}  // namespace sahl
