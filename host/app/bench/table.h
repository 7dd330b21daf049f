// A table of text: the first column at the left, the others at the right of their widest entry.
#pragma once

#include <string>
#include <vector>

namespace sahl {

using TableRow = std::vector<std::string>;

/// Prints the rows, all as long as `head`, and flushes them.
void printTable(const TableRow& head, const std::vector<TableRow>& rows);

/// Three significant digits.
std::string shortNumber(double value);

/// 0.123 as "12 %".
std::string percent(double value);

}  // namespace sahl
