#include "compare/distributions.h"

#include <cmath>
#include <numbers>

namespace sahl {

namespace {

/// The continued fraction of the incomplete beta function, by the method of Lentz. DLMF 8.17.22.
/// Converges fast for x < (a + 1) / (a + b + 2).
double betaFraction(double a, double b, double x)
{
    constexpr double tiny = 1e-300;
    double c = 1;
    double d = 1 - (a + b) * x / (a + 1);
    d = 1 / (std::fabs(d) < tiny ? tiny : d);
    double result = d;
    auto step = [&](double coefficient) {
        d = 1 + coefficient * d;
        d = 1 / (std::fabs(d) < tiny ? tiny : d);
        c = 1 + coefficient / c;
        if (std::fabs(c) < tiny) c = tiny;
        result *= c * d;
        return std::fabs(c * d - 1);
    };
    for (int m = 1; m <= 10000; m++) {
        step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
        if (step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))) < 1e-15) break;
    }
    return result;
}

/// The regularized incomplete beta function I_x(a, b).
double regularizedBeta(double a, double b, double x)
{
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x));
    if (x < (a + 1) / (a + b + 2)) return front * betaFraction(a, b, x) / a;
    return 1 - front * betaFraction(b, a, 1 - x) / b;
}

/// From here on nobody can tell Student's distribution from the normal one.
constexpr double NEARLY_NORMAL = 1e7;

/// Of a function that falls from p > target at 0: where it meets the target.
template <class Function>
double meet(double target, Function function)
{
    double lo = 0, hi = 1;
    while (function(hi) > target && hi < 1e300) {
        lo = hi;
        hi *= 2;
    }
    for (int i = 0; i < 200 && lo < hi; i++) {
        const double middle = 0.5 * (lo + hi);
        if (middle <= lo || middle >= hi) break;
        (function(middle) > target ? lo : hi) = middle;
    }
    return hi;
}

}  // namespace

double normalCdf(double z)
{
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double normalQuantile(double p)
{
    if (p < 0.5) return -normalQuantile(1 - p);
    return meet(1 - p, [](double z) { return normalCdf(-z); });
}

double studentTwoSided(double t, double degrees)
{
    if (degrees >= NEARLY_NORMAL) return 2 * normalCdf(-std::fabs(t));
    return regularizedBeta(degrees / 2, 0.5, degrees / (degrees + t * t));
}

double studentCritical(double p, double degrees)
{
    return meet(p, [degrees](double t) { return studentTwoSided(t, degrees); });
}

}  // namespace sahl
