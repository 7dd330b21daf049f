// --crop: a window of the picture.
#pragma once

#include "image/image.h"

#include <CLI/CLI.hpp>

#include <optional>

namespace sahl {

/// In pixels of the full picture, from its top left corner.
struct CropWindow {
    uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// --crop X,Y,W,H, in the group "Picture".
void addCropOption(CLI::App& command, std::optional<CropWindow>& crop);

/// The part of the window that lies in a picture of that size, all of it without a window. Warns
/// when that is not all of the window; throws usage when it is nothing.
CropWindow clipCrop(const std::optional<CropWindow>& crop, uint32_t width, uint32_t height);

/// "X,Y,W,H"
std::string cropText(const CropWindow& crop);

}  // namespace sahl
