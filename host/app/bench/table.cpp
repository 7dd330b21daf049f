#include "app/bench/table.h"

#include "util/messages.h"

#include <algorithm>

namespace sahl {

void printTable(const TableRow& head, const std::vector<TableRow>& rows)
{
    std::vector<size_t> widths;
    for (size_t column = 0; column < head.size(); column++) {
        widths.push_back(head[column].size());
        for (const TableRow& row : rows) widths[column] = std::max(widths[column], row[column].size());
    }
    auto print = [&](const TableRow& row) {
        std::string line = fmt::format("{:<{}}", row[0], widths[0]);
        for (size_t column = 1; column < row.size(); column++)
            line += fmt::format("  {:>{}}", row[column], widths[column]);
        answerText(line + "\n");
    };
    print(head);
    for (const TableRow& row : rows) print(row);
    flushAnswers();
}

std::string shortNumber(double value)
{
    if (value >= 1000) return fmt::format("{:.0f}", value);
    return fmt::format("{:#.3g}", value);
}

std::string percent(double value)
{
    return fmt::format("{:.0f} %", 100 * value);
}

}  // namespace sahl
