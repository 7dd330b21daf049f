#include "image/line_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

constexpr int DOT = 2;  // of letters
constexpr int LINE = GLYPH_HEIGHT * DOT;
constexpr int PLOT_WIDTH = 560, PLOT_HEIGHT = 240;
constexpr int LEFT = 9 * GLYPH_WIDTH * DOT, RIGHT = 16 * GLYPH_WIDTH * DOT;  // numbers; names of lines
constexpr int ABOVE = 2 * LINE, BELOW = 3 * LINE;
constexpr Colour8 GRID = {221, 221, 221};
constexpr Colour8 INK = {40, 40, 40};
constexpr Colour8 COLOURS[] = {{49, 104, 142}, {200, 80, 40}, {40, 140, 80}, {140, 80, 160}};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

struct Point {
    int x, y;
};

void drawSegment(Image8& image, Point a, Point b, Colour8 colour)
{
    const int steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1});
    for (int i = 0; i <= steps; i++) {
        const int x = a.x + (b.x - a.x) * i / steps, y = a.y + (b.y - a.y) * i / steps;
        fillRectangle(image, x, y, 2, 2, colour);
    }
}

/// One chart whose upper left corner is at (0, top).
void drawChart(Image8& image, int top, const LineChart& chart)
{
    Range x, y;
    for (const ChartLine& line : chart.lines) {
        for (const auto& [px, py] : line.points) {
            x.add(px);
            y.add(py);
        }
    }
    drawText(image, LEFT, top + LINE / 2, chart.title, DOT, INK);
    if (!(x.low <= x.high)) return;
    const Axis across = {x.low, x.high, true}, up = {std::min(y.low, y.high / 10), y.high, true};
    const int base = top + ABOVE + PLOT_HEIGHT;
    auto place = [&](double px, double py) {
        return Point{LEFT + static_cast<int>(std::lround(across.position(px) * PLOT_WIDTH)),
                     base - static_cast<int>(std::lround(up.position(py) * PLOT_HEIGHT))};
    };
    for (const Tick& tick : ticksOf(up, 1.5 * LINE / PLOT_HEIGHT)) {
        const int height = place(x.low, tick.value).y;
        fillRectangle(image, LEFT, height, PLOT_WIDTH, 1, GRID);
        drawText(image, LEFT - DOT * 3 - textWidth(tick.label, DOT), height - 7 * DOT / 2, tick.label, DOT, INK);
    }
    for (const Tick& tick : ticksOf(across, 9.0 * GLYPH_WIDTH * DOT / PLOT_WIDTH)) {
        const int at = place(tick.value, up.low).x;
        fillRectangle(image, at, base, 1, LINE / 2, INK);
        drawText(image, at - textWidth(tick.label, DOT) / 2, base + LINE * 3 / 4, tick.label, DOT, INK);
    }
    for (size_t i = 0; i < chart.lines.size(); i++) {
        const ChartLine& line = chart.lines[i];
        if (line.points.empty()) continue;
        const Colour8 colour = COLOURS[i % std::size(COLOURS)];
        Point last = place(line.points[0].first, line.points[0].second);
        for (const auto& [px, py] : line.points) {
            const Point point = place(px, py);
            drawSegment(image, last, point, colour);
            fillRectangle(image, point.x - 2, point.y - 2, 6, 6, colour);
            last = point;
        }
        const int row = top + ABOVE + static_cast<int>(i) * 3 * LINE / 2;
        fillRectangle(image, LEFT + PLOT_WIDTH + LINE, row + 5, LINE, 4, colour);
        drawText(image, LEFT + PLOT_WIDTH + 2 * LINE + DOT * 3, row, line.name, DOT, INK);
    }
    fillRectangle(image, LEFT, base, PLOT_WIDTH, 1, INK);
}

}  // namespace

Image8 drawCharts(std::span<const LineChart> charts)
{
    constexpr int HEIGHT = ABOVE + PLOT_HEIGHT + BELOW;
    Image8 image = filledImage(LEFT + PLOT_WIDTH + RIGHT, HEIGHT * static_cast<uint32_t>(charts.size()), WHITE);
    int top = 0;
    for (const LineChart& chart : charts) {
        drawChart(image, top, chart);
        top += HEIGHT;
    }
    return image;
}

}  // namespace sahl
