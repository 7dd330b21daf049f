// The programs under test.
#pragma once

namespace sahl::testing {

extern const char* const SAHL_PROGRAM;  ///< path of `sahl`
extern const char* const
    SAHL_FLIPPED_PROGRAM;  ///< the same with one bit of the reference's text flipped

}  // namespace sahl::testing
