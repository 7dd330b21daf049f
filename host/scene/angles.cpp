#include "scene/angles.h"

#include <cmath>

namespace sahl {

namespace {

constexpr double RADIANS_PER_DEGREE = 0.017453292519943295;

/// Taylor series about 0 for |x| <= pi/4 [rad]; the first omitted term is below 1e-19.
double sinSeries(double x)
{
    double x2 = x * x;
    double sum = 0;
    for (int n = 17; n >= 3; n -= 2) sum = (1 + sum) * (-x2 / (n * (n - 1)));
    return x + x * sum;
}

double cosSeries(double x)
{
    double x2 = x * x;
    double sum = 0;
    for (int n = 18; n >= 2; n -= 2) sum = (1 + sum) * (-x2 / (n * (n - 1)));
    return 1 + sum;
}

/// sin(degrees + 90 * quarters)
double shiftedSine(double degrees, int quarters)
{
    // fmod and floor are exact by definition, so this reduction loses nothing.
    double turn = std::fmod(degrees, 360.0);
    double quarter = std::floor(turn / 90 + 0.5);
    double x = (turn - 90 * quarter) * RADIANS_PER_DEGREE;
    switch ((static_cast<int>(quarter) + quarters + 8) % 4) {
    case 0:
        return sinSeries(x);
    case 1:
        return cosSeries(x);
    case 2:
        return -sinSeries(x);
    default:
        return -cosSeries(x);
    }
}

}  // namespace

double sinDeg(double degrees)
{
    return shiftedSine(degrees, 0);
}
double cosDeg(double degrees)
{
    return shiftedSine(degrees, 1);
}

}  // namespace sahl
