#include "compare/plane.h"

#include "util/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

namespace {

/// out[x] = sum of kernel[k] * in[x + k - radius], in place of pixels beyond the ends the last
/// ones.
void convolveRow(std::span<const float> in, std::span<float> out, std::span<const float> kernel,
                 std::vector<float>& padded)
{
    const size_t radius = kernel.size() / 2;
    padded.assign(in.size() + 2 * radius, in.front());
    std::copy(in.begin(), in.end(), padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill(padded.end() - static_cast<std::ptrdiff_t>(radius), padded.end(), in.back());
    std::fill(out.begin(), out.end(), 0.0f);
    for (size_t k = 0; k < kernel.size(); k++) {
        const float weight = kernel[k];
        const float* from = padded.data() + k;
        for (size_t x = 0; x < out.size(); x++) out[x] += weight * from[x];
    }
}

void addRow(std::span<const float> in, std::span<float> out, float weight)
{
    for (size_t x = 0; x < out.size(); x++) out[x] += weight * in[x];
}

}  // namespace

Plane convolve(const Plane& plane, std::span<const float> alongRows,
               std::span<const float> alongColumns, unsigned threads)
{
    assert(alongRows.size() % 2 == 1 && alongColumns.size() % 2 == 1);
    const size_t width = plane.width;
    const auto height = static_cast<std::ptrdiff_t>(plane.height);
    Plane rows = {plane.width, plane.height, std::vector<float>(plane.values.size())};
    auto row = [width](auto& of, std::ptrdiff_t y) {
        return std::span(of.values).subspan(static_cast<size_t>(y) * width, width);
    };
    parallelFor(plane.height, threads, [&](size_t y) {
        std::vector<float> padded;
        const auto at = static_cast<std::ptrdiff_t>(y);
        convolveRow(row(plane, at), row(rows, at), alongRows, padded);
    });
    Plane result = {plane.width, plane.height, std::vector<float>(plane.values.size())};
    const auto radius = static_cast<std::ptrdiff_t>(alongColumns.size() / 2);
    parallelFor(plane.height, threads, [&](size_t y) {
        for (size_t k = 0; k < alongColumns.size(); k++) {
            std::ptrdiff_t from = static_cast<std::ptrdiff_t>(y + k) - radius;
            from = std::clamp<std::ptrdiff_t>(from, 0, height - 1);
            addRow(row(rows, from), row(result, static_cast<std::ptrdiff_t>(y)), alongColumns[k]);
        }
    });
    return result;
}

std::vector<float> gaussianKernel(double sigma, int radius)
{
    double sum = 0;
    for (int x = -radius; x <= radius; x++) sum += std::exp(-x * x / (2 * sigma * sigma));
    std::vector<float> kernel;
    for (int x = -radius; x <= radius; x++) {
        kernel.push_back(static_cast<float>(std::exp(-x * x / (2 * sigma * sigma)) / sum));
    }
    return kernel;
}

}  // namespace sahl
