// Sine and cosine of degrees from + - * alone, so that cameras, rotations and procedural shapes
// have the same bits whatever the C library.
#pragma once

namespace sahl {

/// Error below 2e-16; exact at multiples of 90 degrees. `degrees` must be finite.
double sinDeg(double degrees);
double cosDeg(double degrees);

}  // namespace sahl
