// Tables for people.
#pragma once

#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// Cells as text: a header and rows of as many cells.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Columns aligned with blanks: the first `left` ones to the left, the others to the right. A table wider than
/// `width` columns becomes narrower: where all columns are words, the last one is broken into lines; else the
/// columns of numbers follow in several tables, each beginning with the first `left` columns.
std::string TableToText(const Table& table, size_t left, int width);

/// The same as a Markdown table.
std::string TableToMarkdown(const Table& table, size_t left);

}  // namespace warmjoint::inline tools
