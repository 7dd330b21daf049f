// What a scene has, so that kernels can leave out what it lacks.
#pragma once

#include "device/device.h"

namespace sahl {

/// FEATURE_* bits of shared/features.h.
uint32_t featuresOf(const DeviceScene& scene);

/// Whether a surface of that material gives light.
bool shines(const Material& material);

}  // namespace sahl
