// The normal and Student's distributions, as far as tests of means need them.
#pragma once

namespace sahl {

/// P(Z <= z), and the z for which it is p, 0 < p < 1.
double normalCdf(double z);
double normalQuantile(double p);

/// P(|T| >= |t|) with `degrees` > 0 degrees of freedom, not necessarily a whole number.
double studentTwoSided(double t, double degrees);

/// The t >= 0 for which studentTwoSided is p, 0 < p < 1.
double studentCritical(double p, double degrees);

}  // namespace sahl
