// Tables for people.
#pragma once

#include <string>
#include <vector>

namespace warmjoint {

/// Cells as text: a header and rows of as many cells.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Columns aligned with blanks: the first `left` ones to the left, the others to the right.
std::string TableToText(const Table& table, size_t left);

/// The same as a Markdown table.
std::string TableToMarkdown(const Table& table, size_t left);

}  // namespace warmjoint
