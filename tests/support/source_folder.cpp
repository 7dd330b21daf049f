#include "support/source_folder.h"

namespace sahl::testing {

std::filesystem::path sourceFolder()
{
    return SOURCE_FOLDER;
}

}  // namespace sahl::testing
