#include "compare/flip.h"

#include "compare/flip_color.h"
#include "compare/plane.h"
#include "util/parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

using std::numbers::pi;

constexpr double COLOR_EXPONENT = 0.7;                               // qc
constexpr double FEATURE_EXPONENT = 0.5;                             // qf
constexpr double REDISTRIBUTED_FROM = 0.4, REDISTRIBUTED_TO = 0.95;  // pc, pt
constexpr double FEATURE_WIDTH = 0.082;                              // w [degrees]

/// A contrast sensitivity function a1 exp(-b1 f^2) + a2 exp(-b2 f^2) of frequency f [1/degree].
struct Sensitivity {
    double a1, b1, a2, b2;
};

// Table 1: of lightness, of red against green, of blue against yellow.
constexpr std::array<Sensitivity, 3> SENSITIVITY = {
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};

using Planes = std::array<Plane, 3>;

template <class Function>
void forEachRow(const Image& image, unsigned threads, Function function)
{
    parallelFor(image.height, threads, [&](size_t y) {
        for (size_t i = y * image.width; i < (y + 1) * image.width; i++) function(i);
    });
}

Color3 colorAt(const Planes& planes, size_t i)
{
    return {planes[0].values[i], planes[1].values[i], planes[2].values[i]};
}

Planes opponentPlanes(const Image& image, unsigned threads)
{
    Planes planes;
    for (Plane& plane : planes) {
        plane = {image.width, image.height, std::vector<float>(image.rgb.size() / 3)};
    }
    forEachRow(image, threads, [&](size_t i) {
        const float* rgb = image.rgb.data() + 3 * i;
        const Color3 c = opponentFromLinear({rgb[0], rgb[1], rgb[2]});
        planes[0].values[i] = static_cast<float>(c.x);
        planes[1].values[i] = static_cast<float>(c.y);
        planes[2].values[i] = static_cast<float>(c.z);
    });
    return planes;
}

/// One of the two Gaussians that a channel's sensitivity is in space (Eq. 5), the largest value 1.
std::vector<double> sensitivityKernel(double b, int radius, double pixelsPerDegree)
{
    std::vector<double> kernel;
    for (int x = -radius; x <= radius; x++) {
        const double degrees = x / pixelsPerDegree;
        kernel.push_back(std::exp(-pi * pi * degrees * degrees / b));
    }
    return kernel;
}

/// Filters a channel as the eye does. The kernel is a weighted sum of two Gaussians of the
/// distance, so each of them can be done along rows and along columns.
Plane filterAsSeen(const Plane& plane, const Sensitivity& s, double pixelsPerDegree,
                   unsigned threads)
{
    constexpr double widest =
        0.04;  // of all channels: they share one radius, 3 standard deviations
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixelsPerDegree));
    struct Part {
        double weight;
        std::vector<double> kernel;
        double sum = 0;
    };
    Part parts[2] = {
        {s.a1 * std::sqrt(pi / s.b1), sensitivityKernel(s.b1, radius, pixelsPerDegree)},
        {s.a2 * std::sqrt(pi / s.b2), sensitivityKernel(s.b2, radius, pixelsPerDegree)}};
    double total = 0;
    for (Part& part : parts) {
        for (double value : part.kernel) part.sum += value;
        total += part.weight * part.sum * part.sum;
    }
    Plane result = {plane.width, plane.height, std::vector<float>(plane.values.size())};
    for (const Part& part : parts) {
        if (part.weight == 0) continue;
        std::vector<float> rows, columns;
        for (double value : part.kernel) {
            rows.push_back(static_cast<float>(value / part.sum));
            columns.push_back(static_cast<float>(value * part.weight * part.sum / total));
        }
        const Plane filtered = convolve(plane, rows, columns, threads);
        for (size_t i = 0; i < result.values.size(); i++) result.values[i] += filtered.values[i];
    }
    return result;
}

double clampUnit(double value)
{
    return std::clamp(value, 0.0, 1.0);
}

/// What is left of the picture at this distance, in the space of differences.
Planes seenColors(const Planes& opponent, const Image& image, double pixelsPerDegree,
                  unsigned threads)
{
    Planes planes;
    for (size_t c = 0; c < 3; c++) {
        planes[c] = filterAsSeen(opponent[c], SENSITIVITY[c], pixelsPerDegree, threads);
    }
    forEachRow(image, threads, [&](size_t i) {
        const Color3 rgb = linearFromOpponent(colorAt(planes, i));
        const Color3 lab =
            huntLabFromLinear({clampUnit(rgb.x), clampUnit(rgb.y), clampUnit(rgb.z)});
        planes[0].values[i] = static_cast<float>(lab.x);
        planes[1].values[i] = static_cast<float>(lab.y);
        planes[2].values[i] = static_cast<float>(lab.z);
    });
    return planes;
}

/// Positive values are made to sum up to 1 and negative ones to -1.
std::vector<float> balanced(const std::vector<double>& kernel)
{
    double positive = 0, negative = 0;
    for (double value : kernel) (value > 0 ? positive : negative) += std::fabs(value);
    std::vector<float> result;
    for (double value : kernel) {
        result.push_back(static_cast<float>(value / (value > 0 ? positive : negative)));
    }
    return result;
}

struct Features {
    std::vector<float> edges, points;  // of each pixel, in [0,1]
};

std::vector<float> magnitude(const Plane& x, const Plane& y)
{
    std::vector<float> result(x.values.size());
    for (size_t i = 0; i < result.size(); i++) result[i] = std::hypot(x.values[i], y.values[i]);
    return result;
}

/// First and second derivatives of a Gaussian, along both axes, of lightness in [0,1] (Sec. 4.2).
Features findFeatures(const Plane& opponentY, double pixelsPerDegree, unsigned threads)
{
    const double sigma = 0.5 * FEATURE_WIDTH * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> first, second;
    for (int x = -radius; x <= radius; x++) {
        const double gauss = std::exp(-x * x / (2 * sigma * sigma));
        first.push_back(-x * gauss);
        second.push_back((x * x / (sigma * sigma) - 1) * gauss);
    }
    const std::vector<float> along = gaussianKernel(sigma, radius);
    Plane y = opponentY;
    for (float& value : y.values) value = (value + 16) / 116;
    auto both = [&](const std::vector<float>& kernel) {
        return magnitude(convolve(y, kernel, along, threads), convolve(y, along, kernel, threads));
    };
    return {both(balanced(first)), both(balanced(second))};
}

/// The largest colour difference that there is, to the power of qc: between green and blue.
double largestColorError()
{
    const double distance =
        hyabDistance(huntLabFromLinear({0, 1, 0}), huntLabFromLinear({0, 0, 1}));
    return std::pow(distance, COLOR_EXPONENT);
}

/// Into [0,1], with most of the range for small differences (Eq. 11).
double redistributed(double error, double largest)
{
    const double knee = REDISTRIBUTED_FROM * largest;
    if (error < knee) return error * REDISTRIBUTED_TO / knee;
    return REDISTRIBUTED_TO + (error - knee) / (largest - knee) * (1 - REDISTRIBUTED_TO);
}

struct Seen {
    Planes colors;
    Features features;
};

Seen lookAt(const Image& image, double pixelsPerDegree, unsigned threads)
{
    const Planes opponent = opponentPlanes(image, threads);
    return {seenColors(opponent, image, pixelsPerDegree, threads),
            findFeatures(opponent[0], pixelsPerDegree, threads)};
}

}  // namespace

std::vector<float> ldrFlipMap(const Image& reference, const Image& test, double pixelsPerDegree,
                              unsigned threads)
{
    assert(reference.width == test.width && reference.height == test.height);
    const Seen r = lookAt(reference, pixelsPerDegree, threads);
    const Seen t = lookAt(test, pixelsPerDegree, threads);
    const double largest = largestColorError();
    std::vector<float> map(reference.rgb.size() / 3);
    forEachRow(reference, threads, [&](size_t i) {
        const double distance = hyabDistance(colorAt(r.colors, i), colorAt(t.colors, i));
        const double color = redistributed(std::pow(distance, COLOR_EXPONENT), largest);
        const double edges = std::fabs(double(r.features.edges[i]) - t.features.edges[i]);
        const double points = std::fabs(double(r.features.points[i]) - t.features.points[i]);
        const double feature =
            std::pow(std::max(edges, points) / std::numbers::sqrt2, FEATURE_EXPONENT);
        map[i] = static_cast<float>(clampUnit(std::pow(color, 1 - feature)));
    });
    return map;
}

}  // namespace sahl
