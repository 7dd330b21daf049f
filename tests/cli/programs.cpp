#include "cli/programs.h"

namespace sahl::testing {

const char* const SAHL_PROGRAM = PROGRAM_PATH;
const char* const SAHL_FLIPPED_PROGRAM = FLIPPED_PROGRAM_PATH;

}  // namespace sahl::testing
