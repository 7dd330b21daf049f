// Runs this program once more, as a process of its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sahl {

/// `sahl ARGUMENTS`, silent, with these variables set in its environment. Returns the seconds from before
/// its start to its end [s]. Throws noDevice, naming the arguments, when it fails.
double runSelf(const std::vector<std::string>& arguments,
               const std::vector<std::pair<std::string, std::string>>& environment);

}  // namespace sahl
