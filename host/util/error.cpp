#include "util/error.h"

#include "util/messages.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <vector>

namespace sahl {

namespace {
std::atomic<bool> quietFlag{false};
}

size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); j++) {
            size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row[b.size()];
}

void warn(const std::string& text)
{
    if (!quietFlag) say("sahl: warning: {}\n", text);
}

void setQuiet(bool quiet)
{
    quietFlag = quiet;
}
bool isQuiet()
{
    return quietFlag;
}

}  // namespace sahl
