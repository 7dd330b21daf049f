// Colours for numbers, and pictures of scalar fields in them with a scale at the side.
#pragma once

#include "image/axis.h"
#include "image/drawing.h"

#include <span>

namespace sahl {

enum class ColorMap {
    viridis,  ///< dark blue to yellow, even to the eye: Smith and van der Walt 2015, for matplotlib
    grey,     ///< black to white, the number times 255
};

/// `position` in [0,1]. viridis: the nearest of the 256 colours that its authors published.
Colour8 colorOf(ColorMap map, double position);

/// A scalar field, top row first. NaN where there is no value; on a logarithmic axis there is none
/// at 0 and below either.
struct ScalarField {
    uint32_t width = 0, height = 0;
    std::vector<float> values;
};

struct FalseColors {
    ColorMap map = ColorMap::viridis;
    Axis axis;  ///< what the ends of the map stand for; values beyond have the ends' colours
    bool scale = true;  ///< a bar of the colours with numbers, right of the picture
};

/// The axis from the smallest to the largest finite value; logarithmic: from the smallest above 0.
/// Both ends are the same when there are less than two values.
Axis axisOf(std::span<const float> values, bool logarithmic);

/// One pixel a value, black where there is none. With a scale the picture is wider, and a small one
/// higher, than the field.
Image8 falseColorImage(const ScalarField& field, const FalseColors& colors);

}  // namespace sahl
