// From Sahl's arrays to the textbook tracer's own structures: values are copied, nothing is
// computed but the camera's axes and lengths.
#pragma once

#include "oracle/textbook.h"
#include "oracle/textbook_phong.h"
#include "scene/scene.h"

namespace sahl::testing {

/// The scene as it is before its tree is built (scene.primitives filled).
textbook::World textbookWorld(const Scene& scene);

/// The same for the phong integrator.
textbook::PhongWorld textbookPhong(const Scene& scene);

}  // namespace sahl::testing
