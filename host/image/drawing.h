// Rectangles and short words in 8-bit pictures: what scales and plots are made of.
#pragma once

#include "image/image.h"

#include <array>
#include <string_view>

namespace sahl {

using Colour8 = std::array<uint8_t, 3>;  // sRGB

constexpr Colour8 BLACK = {0, 0, 0};
constexpr Colour8 WHITE = {255, 255, 255};

/// A picture of one colour.
Image8 filledImage(uint32_t width, uint32_t height, Colour8 colour);

/// Fills the pixels of x ... x + width - 1, y ... y + height - 1 that lie in the picture.
void fillRectangle(Image8& image, int x, int y, int width, int height, Colour8 colour);

/// Copies `source` into the picture, its upper left corner to (x, y); what lies outside is cut off.
void drawImage(Image8& image, const Image8& source, int x, int y);

// Letters are 5 x 7 dots in cells of 6 x 8, each dot `size` x `size` pixels.
constexpr int GLYPH_WIDTH = 6;
constexpr int GLYPH_HEIGHT = 8;

/// Writes digits, lower case letters, blanks and ".-+:" from (x, y) on, the upper left corner of
/// the first cell. Anything else becomes a box.
void drawText(Image8& image, int x, int y, std::string_view text, int size, Colour8 colour);

/// Width of a text [pixels].
int textWidth(std::string_view text, int size);

}  // namespace sahl
