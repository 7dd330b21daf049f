#include "compare/ssim.h"

#include "util/parallel.h"

#include <cassert>

namespace sahl {

namespace {

constexpr double C1 = 0.01 * 0.01;
constexpr double C2 = 0.03 * 0.03;

/// Weighted moments of a window.
struct Moments {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
};

double similarity(const Moments& m)
{
    const double varianceA = m.aa - m.a * m.a, varianceB = m.bb - m.b * m.b;
    const double covariance = m.ab - m.a * m.b;
    return (2 * m.a * m.b + C1) * (2 * covariance + C2) /
           ((m.a * m.a + m.b * m.b + C1) * (varianceA + varianceB + C2));
}

/// Of the window whose top left pixel this is. In double: variances are small differences.
Moments momentsAt(const Plane& a, const Plane& b, size_t left, size_t top,
                  std::span<const float> kernel)
{
    Moments m;
    for (size_t y = 0; y < SSIM_WINDOW; y++) {
        const size_t row = (top + y) * a.width + left;
        for (size_t x = 0; x < SSIM_WINDOW; x++) {
            const double weight = double(kernel[x]) * kernel[y];
            const double va = a.values[row + x], vb = b.values[row + x];
            m.a += weight * va;
            m.b += weight * vb;
            m.aa += weight * va * va;
            m.bb += weight * vb * vb;
            m.ab += weight * va * vb;
        }
    }
    return m;
}

}  // namespace

std::vector<float> ssimMap(const Plane& a, const Plane& b, unsigned threads)
{
    assert(a.width == b.width && a.height == b.height);
    if (a.width < SSIM_WINDOW || a.height < SSIM_WINDOW) return {};
    const std::vector<float> kernel = gaussianKernel(1.5, SSIM_WINDOW / 2);
    const size_t columns = a.width - SSIM_WINDOW + 1, rows = a.height - SSIM_WINDOW + 1;
    std::vector<float> map(columns * rows);
    parallelFor(rows, threads, [&](size_t y) {
        for (size_t x = 0; x < columns; x++) {
            map[y * columns + x] = static_cast<float>(similarity(momentsAt(a, b, x, y, kernel)));
        }
    });
    return map;
}

}  // namespace sahl
