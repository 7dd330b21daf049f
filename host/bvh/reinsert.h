// A built tree made better, for as long as that is worth it.
#pragma once

#include "bvh/draft.h"

namespace sahl {

/// When to stop: where so many rounds in a row make the tree cheaper by less than this share. A round gives a
/// quarter of all nodes their turn.
struct ReinsertionEnd {
    uint rounds;
    double gain;
};

/// Scans gain next to nothing and have one round; Sponza's cost falls by a fifth.
constexpr ReinsertionEnd WHILE_IT_PAYS = {1, 0.01};

/// For trees that many rays will walk through.
constexpr ReinsertionEnd TO_THE_END = {4, 1e-3};

/// Makes the draft of a built tree cheaper. It stays as it was where that is not worth it from the start, and where the
/// better tree would have more than `levels` inner nodes one after another. The result does not depend on `threads`.
void improveByReinsertion(Draft& draft, std::span<const Box> boxes, uint levels, ReinsertionEnd end,
                          unsigned threads);

}  // namespace sahl
