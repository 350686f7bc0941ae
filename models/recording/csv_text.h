// Separated text as rows of fields, without copying them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "models/recording/assemble.h"

namespace warmjoint::inline models {

/// A file of separated values: a header row, then numbers. The separator (comma, semicolon or tab)
/// is taken from the header. Byte-order mark, Windows line ends, blank lines, lines that start with
/// '#' and quoted fields are understood.
class CsvText {
 public:
  /// Keeps a view of `text`. Throws BadInput where there is no header.
  CsvText(std::string_view text, std::string file);

  const std::vector<std::string>& names() const { return names_; }
  Place header_place() const { return {file_, header_line_}; }

  /// The numbers of the columns at `indices`; other columns may hold anything. Throws BadInput for
  /// a row that lacks fields or has too many, and for text in a number.
  RawColumns ReadColumns(const std::vector<std::size_t>& indices) const;

 private:
  std::string file_;
  std::string_view rows_;  // what follows the header
  char separator_ = ',';
  int header_line_ = 0;
  std::vector<std::string> names_;
};

}  // namespace warmjoint::inline models
