// HDR-FLIP: LDR-FLIP over a range of exposures that the reference gives.
#include "compare/flip.h"
#include "compare/luminance.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// The fit of the ACES curve by K. Narkowicz (2016), without its exposure of 0.6:
/// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
constexpr double K0 = 0.6 * 0.6 * 2.51, K1 = 0.6 * 0.03;
constexpr double K3 = 0.6 * 0.6 * 2.43, K4 = 0.6 * 0.59, K5 = 0.14;

double toneMapped(double x)
{
    if (!(x > 0)) return 0;
    // Divided by x^2: nothing overflows for bright pixels.
    return std::clamp((K0 + K1 / x) / (K3 + K4 / x + K5 / x / x), 0.0, 1.0);
}

/// The value that is tone mapped to 0.85: the positive root of a quadratic equation.
double brightInput()
{
    constexpr double t = 0.85;
    const double a = K0 - t * K3, b = K1 - t * K4, c = -t * K5;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

double medianOf(std::vector<double>& values)
{
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

Image exposed(const Image& image, double stops)
{
    const double gain = std::exp2(stops);
    Image result = image;
    for (float& value : result.rgb) value = static_cast<float>(toneMapped(value * gain));
    return result;
}

}  // namespace

std::vector<double> hdrFlipExposures(const Image& reference)
{
    std::vector<double> luminances;
    for (size_t i = 0; i < reference.rgb.size(); i += 3) {
        luminances.push_back(luminance(reference.rgb.data() + i, 0));
    }
    double median = medianOf(luminances);
    const double largest = luminances.back();
    if (!(largest > 0)) return {0};
    if (!(median > 0)) {
        std::erase_if(luminances, [](double y) { return !(y > 0); });
        median = medianOf(luminances);
    }
    const double first = std::log2(brightInput() / largest);
    const double last = std::log2(brightInput() / median);
    const int count = std::max(2, static_cast<int>(std::ceil(last - first)));
    std::vector<double> exposures;
    for (int i = 0; i < count; i++) exposures.push_back(first + i * (last - first) / (count - 1));
    return exposures;
}

std::vector<float> hdrFlipMap(const Image& reference, const Image& test,
                              const std::vector<double>& exposures, double pixelsPerDegree,
                              unsigned threads)
{
    std::vector<float> map(reference.rgb.size() / 3);
    for (double stops : exposures) {
        const std::vector<float> single =
            ldrFlipMap(exposed(reference, stops), exposed(test, stops), pixelsPerDegree, threads);
        for (size_t i = 0; i < map.size(); i++) map[i] = std::max(map[i], single[i]);
    }
    return map;
}

}  // namespace sahl
