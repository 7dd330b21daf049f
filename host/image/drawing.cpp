#include "image/drawing.h"

#include <algorithm>

namespace sahl {

namespace {

/// Seven rows of five dots.
struct Glyph {
    char letter;
    const char* rows;
};

// clang-format off
constexpr Glyph GLYPHS[] = {
    {'0', ".###. #...# #..## #.#.# ##..# #...# .###."},
    {'1', "..#.. .##.. ..#.. ..#.. ..#.. ..#.. .###."},
    {'2', ".###. #...# ....# ..##. .#... #.... #####"},
    {'3', ".###. #...# ....# ..##. ....# #...# .###."},
    {'4', "...#. ..##. .#.#. #..#. ##### ...#. ...#."},
    {'5', "##### #.... ####. ....# ....# #...# .###."},
    {'6', "..##. .#... #.... ####. #...# #...# .###."},
    {'7', "##### ....# ...#. ..#.. ..#.. .#... .#..."},
    {'8', ".###. #...# #...# .###. #...# #...# .###."},
    {'9', ".###. #...# #...# .#### ....# ...#. .##.."},
    {'.', "..... ..... ..... ..... ..... .##.. .##.."},
    {'-', "..... ..... ..... .###. ..... ..... ....."},
    {'+', "..... ..#.. ..#.. ##### ..#.. ..#.. ....."},
    {':', "..... .##.. .##.. ..... .##.. .##.. ....."},
    {' ', "..... ..... ..... ..... ..... ..... ....."},
    {'A', ".###. #...# #...# ##### #...# #...# #...#"},
    {'B', "####. #...# #...# ####. #...# #...# ####."},
    {'C', ".###. #...# #.... #.... #.... #...# .###."},
    {'D', "####. #...# #...# #...# #...# #...# ####."},
    {'E', "##### #.... #.... ####. #.... #.... #####"},
    {'F', "##### #.... #.... ####. #.... #.... #...."},
    {'G', ".###. #...# #.... #.### #...# #...# .####"},
    {'H', "#...# #...# #...# ##### #...# #...# #...#"},
    {'I', ".###. ..#.. ..#.. ..#.. ..#.. ..#.. .###."},
    {'J', "....# ....# ....# ....# ....# #...# .###."},
    {'K', "#...# #..#. #.#.. ##... #.#.. #..#. #...#"},
    {'L', "#.... #.... #.... #.... #.... #.... #####"},
    {'M', "#...# ##.## #.#.# #.#.# #...# #...# #...#"},
    {'N', "#...# ##..# ##..# #.#.# #..## #..## #...#"},
    {'O', ".###. #...# #...# #...# #...# #...# .###."},
    {'P', "####. #...# #...# ####. #.... #.... #...."},
    {'Q', ".###. #...# #...# #...# #.#.# #..#. .##.#"},
    {'R', "####. #...# #...# ####. #.#.. #..#. #...#"},
    {'S', ".#### #.... #.... .###. ....# ....# ####."},
    {'T', "##### ..#.. ..#.. ..#.. ..#.. ..#.. ..#.."},
    {'U', "#...# #...# #...# #...# #...# #...# .###."},
    {'V', "#...# #...# #...# #...# .#.#. .#.#. ..#.."},
    {'W', "#...# #...# #...# #.#.# #.#.# ##.## #...#"},
    {'X', "#...# #...# .#.#. ..#.. .#.#. #...# #...#"},
    {'Y', "#...# #...# .#.#. ..#.. ..#.. ..#.. ..#.."},
    {'Z', "##### ....# ...#. ..#.. .#... #.... #####"},
};
constexpr Glyph UNKNOWN = {'?', "##### #...# #...# #...# #...# #...# #####"};
// clang-format on

const Glyph& glyphOf(char letter)
{
    const char capital =
        letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    for (const Glyph& glyph : GLYPHS) {
        if (glyph.letter == capital) return glyph;
    }
    return UNKNOWN;
}

std::ptrdiff_t offsetOf(const Image8& image, int column, int row)
{
    return std::ptrdiff_t{3} * (std::ptrdiff_t{row} * image.width + column);
}

}  // namespace

Image8 filledImage(uint32_t width, uint32_t height, Colour8 colour)
{
    Image8 image = {width, height, {}};
    image.rgb.reserve(size_t{3} * width * height);
    for (size_t i = 0; i < size_t{width} * height; i++) {
        image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
    }
    return image;
}

void fillRectangle(Image8& image, int x, int y, int width, int height, Colour8 colour)
{
    const int right = std::min(x + width, static_cast<int>(image.width));
    const int bottom = std::min(y + height, static_cast<int>(image.height));
    for (int row = std::max(y, 0); row < bottom; row++) {
        for (int column = std::max(x, 0); column < right; column++) {
            std::copy(colour.begin(), colour.end(),
                      image.rgb.begin() + offsetOf(image, column, row));
        }
    }
}

void drawImage(Image8& image, const Image8& source, int x, int y)
{
    // Columns of the source that lie in the picture.
    const int first = std::max(0, -x);
    const int last = std::min(static_cast<int>(source.width), static_cast<int>(image.width) - x);
    for (int row = 0; row < static_cast<int>(source.height) && first < last; row++) {
        if (y + row < 0 || y + row >= static_cast<int>(image.height)) continue;
        std::copy(source.rgb.begin() + offsetOf(source, first, row),
                  source.rgb.begin() + offsetOf(source, last, row),
                  image.rgb.begin() + offsetOf(image, x + first, y + row));
    }
}

void drawText(Image8& image, int x, int y, std::string_view text, int size, Colour8 colour)
{
    for (char letter : text) {
        const char* rows = glyphOf(letter).rows;
        for (int row = 0; row < 7; row++) {
            for (int column = 0; column < 5; column++) {
                if (rows[6 * row + column] != '#') continue;
                fillRectangle(image, x + column * size, y + row * size, size, size, colour);
            }
        }
        x += GLYPH_WIDTH * size;
    }
}

int textWidth(std::string_view text, int size)
{
    return static_cast<int>(text.size()) * GLYPH_WIDTH * size;
}

}  // namespace sahl
