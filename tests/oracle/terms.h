// One small scene for every term of the path tracer's text, in which that term carries at least
// half of the light.
#pragma once

#include "scene/scene.h"

#include <ostream>
#include <vector>

namespace sahl::testing {

struct Term {
    const char* name;  ///< a word, for the test's name
    Scene (*make)();
    void (*disturb)(Scene& scene, float by);  ///< puts a relative error `by` into the term
    const char* error;                        ///< what disturb changes
    bool inBlocks = false;  ///< the error moves light about and leaves the mean as it is
};

/// For GoogleTest's messages.
inline void PrintTo(const Term& term, std::ostream* out)
{
    *out << term.name;
}

std::vector<Term> materialTerms();
std::vector<Term> roughTerms();   ///< rough and layered materials
std::vector<Term> lightTerms();   ///< lamps, probes
std::vector<Term> cameraTerms();  ///< cameras, shapes
std::vector<Term> instanceTerms();
std::vector<Term> phongTerms();   ///< of the phong integrator, without noise

}  // namespace sahl::testing
