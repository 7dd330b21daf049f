// Slow and good: for trees that many rays will walk through.
#pragma once

#include "bvh/draft.h"

namespace sahl {

/// Makes the draft of a built tree cheaper. It stays as it was where the better tree would have more than
/// `levels` inner nodes one after another. The result does not depend on `threads`.
void improveByReinsertion(Draft& draft, std::span<const Box> boxes, uint levels, unsigned threads);

}  // namespace sahl
