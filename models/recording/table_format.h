// How the table of a text file stands.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// A table of text, as its first lines tell it: a preamble of any lines, a row of names, perhaps a row of units, rows of
/// numbers. Lines that begin with # or % are comments; a row of names may stand in one. Names that repeat take in those of the row
/// above them, "knee/torque" of "knee" and "torque", where that tells them apart.
struct TableFormat {
  char separator = ',';            // comma, semicolon, tab, stroke, or a blank for runs of blanks
  char decimal_mark = '.';         // or a comma
  std::size_t columns = 0;         // of a row
  std::string_view header;         // the line of the names; empty where there is none
  int header_line = 0;             // 0: there is none
  std::vector<std::string> names;  // [columns], UTF-8; empty where there is no header
  std::vector<std::string>
      units;  // [columns] each empty where the row says none; empty without such a row
  bool rows_end_empty = false;  // the first row ends with a separator and nothing behind it
  std::size_t data = 0;         // byte at which the rows of numbers begin
  int data_line = 1;            // its line
};

/// One look at the first thousand lines of a file. Throws BadInput for a file without a row, for rows that do not fit the
/// header above them, and for numbers as 1,234 where nothing tells thousands from decimals.
/// is_named: the columns have names from elsewhere, so that the file needs no header.
TableFormat FindTable(std::string_view text, const std::string& file, bool is_named);

/// The text as UTF-8 without a byte-order mark where it is UTF-16; otherwise nothing.
std::optional<std::string> FromUtf16(std::string_view text);

/// Takes one line off the front of `rest`, without its end.
std::string_view TakeLine(std::string_view& rest);

/// Whether a line is blank or a comment.
bool IsBlankLine(std::string_view line);

/// Splits a line at separators outside of quotes, or at runs of blanks, into fields without blanks and quotes around them.
/// Returns the number of fields, of which 10,000 are kept.
std::size_t SplitLine(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// The number that a field holds, NaN where it holds none: empty, or a word for that, as nan, null, -1.#IND or #N/A. Nothing for
/// other texts.
std::optional<double> ReadCell(std::string_view field, char decimal_mark);

}  // namespace warmjoint
