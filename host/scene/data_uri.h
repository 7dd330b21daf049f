// URIs of glTF files: relative names of files, and content written out in base64.
#pragma once

#include "util/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

bool isDataUri(std::string_view uri);

/// The content of "data:[type][;key=value]*;base64,...". Throws badInput starting with `where` when
/// the URI has another form or is not base64.
std::vector<uint8_t> readDataUri(std::string_view uri, const std::string& where);

/// The name of the file that a relative URI stands for, with %20 and the like decoded. Throws
/// badInput starting with `where` for URIs with a scheme such as http:.
std::string fileNameOfUri(std::string_view uri, const std::string& where);

}  // namespace sahl
