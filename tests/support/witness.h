// Pictures whose mean is known in closed form: how far they are off, in standard errors. What is
// shown here becomes the table of `tools/test --witnesses`.
#pragma once

#include "film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace sahl::testing {

struct Mean {
    double value = 0, standardError = 0;
};

/// Mean of the green channel over the frame, with the standard error from the sums of squares. For
/// grey pictures by independent samples, of which luminance is green.
inline Mean greyFrameMean(const Film& film)
{
    double sum = 0, sum2 = 0, n = 0;
    for (const auto& half : film.half) {
        for (const HalfPixel& pixel : half) {
            sum += pixel.sum[1].toDouble();
            sum2 += pixel.sumY2.toDouble();
            n += pixel.samples;
        }
    }
    const double mean = sum / n;
    return {mean, std::sqrt(std::max(0.0, sum2 / n - mean * mean) / n)};
}

/// A row of the table: the running test, measured and expected values, and their distance in
/// standard errors; where all samples are alike there are none, and the relative difference stands
/// instead.
inline void showWitness(const Mean& mean, double expected, const std::string& which = "")
{
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const double difference = mean.value - expected;
    const bool alike = mean.standardError < 1e-6 * expected;
    std::printf("witness;%s.%s%s%s;%.6g;%.6g;%.2g;", test->test_suite_name(), test->name(),
                which.empty() ? "" : ", ", which.c_str(), expected, mean.value, mean.standardError);
    if (alike)
        std::printf("alike, off by %.0e\n", difference / expected);
    else
        std::printf("%+.2f\n", difference / mean.standardError);
}

}  // namespace sahl::testing
