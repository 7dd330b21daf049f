#include "image/histogram.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

namespace {

constexpr int DOT = 2;  // of letters
constexpr int LINE = GLYPH_HEIGHT * DOT;
constexpr int BAR_WIDTH = 4;
constexpr int PLOT_HEIGHT = 200;
constexpr int LEFT = 9 * GLYPH_WIDTH * DOT;  // room for the counts
constexpr int RIGHT = 3 * LINE;              // and for half of the last value
constexpr int ABOVE = 2 * LINE;
constexpr int BELOW = 3 * LINE;
constexpr Colour8 BAR = {49, 104, 142};
constexpr Colour8 GRID = {221, 221, 221};
constexpr Colour8 INK = {40, 40, 40};

Histogram countIn(std::span<const float> values, double low, double high, size_t bins)
{
    Histogram histogram = {low, high, std::vector<uint64_t>(bins)};
    const Axis axis = {low, high, false};
    for (float value : values) {
        const double position = axis.position(double{value}) * static_cast<double>(bins);
        histogram.counts[std::min(static_cast<size_t>(position), bins - 1)]++;
    }
    return histogram;
}

int centred(const std::string& text, int x)
{
    return x - (textWidth(text, DOT) - DOT) / 2;
}

/// One plot whose upper left corner is at (0, top).
void drawPlot(Image8& image, int top, const HistogramPlot& plot)
{
    const Histogram& histogram = plot.histogram;
    const int width = BAR_WIDTH * static_cast<int>(histogram.counts.size());
    const int base = top + ABOVE + PLOT_HEIGHT;
    const uint64_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    // Half a count below 1, so that one value has a height.
    const Axis counts = {0.5, std::max(1.0, static_cast<double>(most)), true};
    auto heightOf = [&](double count) {
        return static_cast<int>(std::lround(counts.position(count) * PLOT_HEIGHT));
    };

    drawText(image, centred(plot.title, LEFT + width / 2), top + LINE / 2, plot.title, DOT, INK);
    const Axis fromOne = {1, counts.high, true};
    for (const Tick& tick : ticksOf(fromOne, 1.5 * LINE / PLOT_HEIGHT)) {
        const int y = base - heightOf(tick.value);
        fillRectangle(image, LEFT, y, width, 1, GRID);
        drawText(image, LEFT - DOT * 3 - textWidth(tick.label, DOT), y - 7 * DOT / 2, tick.label,
                 DOT, INK);
    }
    for (size_t i = 0; i < histogram.counts.size(); i++) {
        if (histogram.counts[i] == 0) continue;
        const int height = heightOf(static_cast<double>(histogram.counts[i]));
        fillRectangle(image, LEFT + BAR_WIDTH * static_cast<int>(i), base - height, BAR_WIDTH,
                      height, BAR);
    }
    fillRectangle(image, LEFT, base, width, 1, INK);
    const Axis values = {histogram.low, histogram.high, false};
    for (const Tick& tick : ticksOf(values, 10.0 * GLYPH_WIDTH * DOT / width)) {
        const int x = LEFT + static_cast<int>(std::lround(values.position(tick.value) * width));
        fillRectangle(image, x, base, 1, LINE / 2, INK);
        drawText(image, centred(tick.label, x), base + LINE * 3 / 4, tick.label, DOT, INK);
    }
}

}  // namespace

Histogram histogramOfRange(std::span<const float> values, size_t bins)
{
    assert(!values.empty() && bins > 0);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return countIn(values, double{*low}, double{*high}, bins);
}

Histogram histogramOfUnit(std::span<const float> values, size_t bins)
{
    assert(bins > 0);
    return countIn(values, 0, 1, bins);
}

Image8 plotHistograms(std::span<const HistogramPlot> plots)
{
    constexpr int plotHeight = ABOVE + PLOT_HEIGHT + BELOW;
    size_t bins = 0;
    for (const HistogramPlot& plot : plots) bins = std::max(bins, plot.histogram.counts.size());
    Image8 image =
        filledImage(static_cast<uint32_t>(LEFT + BAR_WIDTH * static_cast<int>(bins) + RIGHT),
                    static_cast<uint32_t>(plotHeight) * static_cast<uint32_t>(plots.size()), WHITE);
    int top = 0;
    for (const HistogramPlot& plot : plots) {
        drawPlot(image, top, plot);
        top += plotHeight;
    }
    return image;
}

}  // namespace sahl
