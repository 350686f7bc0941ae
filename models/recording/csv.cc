#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/recording/assemble.h"
#include "models/recording/one_clock.h"
#include "models/recording/read_recording.h"
#include "models/recording/table_format.h"
#include "models/recording/units.h"

namespace warmjoint {
namespace {

/// Why a cell of a column of numbers cannot be read.
std::string RefusalOf(const Place& place, const std::string& name, std::string_view text) {
  const bool has_comma = text.find(',') != std::string_view::npos;
  return fmt::format("{}:{}: {} is '{}', which is not a number{}", place.file, place.line,
                     Excerpt(name), Excerpt(text),
                     has_comma ? "; write decimals with a point and thousands without a mark" : "");
}

/// Reads rows into the wanted columns of a file.
class TableReader {
 public:
  TableReader(const TableFormat& table, const std::string& file,
              const std::vector<WantedColumn>& wanted, FileContent& content)
      : table_(table), file_(file), content_(content) {
    for (const WantedColumn& one : wanted) columns_.push_back({one});
  }

  /// NaN where a field holds no number; columns that are not wanted may hold anything. Leaves out headers that stand again among the
  /// rows, and a last row that was cut. A column with a text in place of a number gets its refusal. Throws BadInput for other rows that
  /// lack fields or have too many.
  void Read(std::string_view rows);

 private:
  struct Wanted {
    WantedColumn of;
    std::optional<bool> in_words{};  // whether times are stamps, once one was read
  };

  /// The number, or the stamp, in a field of the row that was split last.
  std::optional<double> ReadField(Wanted& column) const;
  /// Reads the fields of that row; false where one of a column that held numbers so far holds none.
  bool ReadRow();
  /// Gives those columns their refusal.
  void RefuseTexts(int line);

  const TableFormat& table_;
  const std::string& file_;
  FileContent& content_;
  std::vector<Wanted> columns_;
  std::vector<std::optional<double>> row_;
  std::vector<std::string_view> fields_;
};

std::optional<double> TableReader::ReadField(Wanted& column) const {
  const std::string_view field = fields_[column.of.index];
  std::optional<double> value = ReadCell(field, table_.decimal_mark);
  if (!column.of.is_time || (value && std::isnan(*value))) return value;
  // stamps in words are no numbers, all of them or none
  const bool is_stamp = !value;
  if (is_stamp) value = ReadStamp(field);
  if (column.in_words.value_or(is_stamp) != is_stamp) value.reset();
  if (value) column.in_words = is_stamp;
  return value;
}

bool TableReader::ReadRow() {
  row_.clear();
  bool is_whole = true;
  for (Wanted& column : columns_) {
    row_.push_back(ReadField(column));
    is_whole = is_whole && (row_.back() || !content_.columns[column.of.index].refusal.empty());
  }
  return is_whole;
}

void TableReader::RefuseTexts(int line) {
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    FileColumn& column = content_.columns[columns_[k].of.index];
    if (row_[k] || !column.refusal.empty()) continue;
    column.refusal = RefusalOf({file_, line}, column.name, fields_[columns_[k].of.index]);
  }
}

void TableReader::Read(std::string_view rows) {
  // a row has a separator or an end for each field, and digits for each that is read: blank lines take no room
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto lines = static_cast<std::size_t>(1 + std::count(rows.begin(), rows.end(), '\n'));
  const std::size_t most = std::min(lines, 1 + rows.size() / (table_.columns + columns_.size()));
  const auto values = [this](std::size_t k) -> Eigen::VectorXd& {
    return content_.columns[columns_[k].of.index].values;
  };
  for (std::size_t k = 0; k < columns_.size(); ++k)
    values(k).resize(static_cast<Eigen::Index>(most));
  content_.line.reserve(most);

  // one sample for each row
  int repeated = 0;  // headers among the rows
  for (int line = table_.data_line; !rows.empty(); ++line) {
    const std::string_view row = TakeLine(rows);
    if (IsBlankLine(row)) continue;
    const std::size_t count = SplitLine(row, table_.separator, fields_);
    // with or without a separator at the end
    const bool has_more = count == table_.columns + 1 && fields_.back().empty();
    const bool has_less = count + 1 == table_.columns && table_.names.back().empty();
    const bool fits = count == table_.columns || has_more || has_less;
    const bool is_whole = fits && ReadRow();
    const bool is_last = !content_.line.empty() && rows.find_first_not_of(std::string_view(
                                                       " \t\r\n\0", 5)) == std::string_view::npos;
    if (!is_whole && row == table_.header) {
      ++repeated;
      continue;
    }
    if (!is_whole && is_last) {
      content_.notes.push_back(
          fmt::format("line {}, the last, is no whole row and is left out", line));
      break;
    }
    if (!fits) {
      Refuse({file_, line}, "has {} fields where the {} {}; complete or drop the row", count,
             table_.header_line > 0 ? "header has" : "rows before have", table_.columns);
    }
    if (!is_whole) RefuseTexts(line);
    const auto sample = static_cast<Eigen::Index>(content_.line.size());
    content_.line.push_back(line);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      values(k)[sample] = row_[k].value_or(nothing);
    }
  }
  if (repeated > 0) {
    content_.notes.push_back(fmt::format("{} more headers among the rows are left out", repeated));
  }
  // no longer than the rows that were there
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    values(k).conservativeResize(static_cast<Eigen::Index>(content_.line.size()));
    content_.columns[columns_[k].of.index].in_words = columns_[k].in_words.value_or(false);
  }
}

/// The names that are given, one for each column; one that is empty in every row, behind a separator at its end, needs none.
void TakeNames(std::vector<std::string> given, const std::string& file, TableFormat& table) {
  if (given.empty()) return;
  if (given.size() + 1 == table.columns && table.rows_end_empty) given.emplace_back();
  if (given.size() != table.columns) {
    Refuse({file, table.data_line}, "has {} columns where --columns names {}; a name may be empty",
           table.columns, given.size());
  }
  table.names = std::move(given);
}

constexpr std::string_view kNote = "# note: ", kDoubt = "# doubt: ";  // lines above a table

/// What a log of ours says of itself.
struct WhatIsSaid {
  std::vector<std::string> notes, doubts;
};

/// What stands in the first lines of a table that RecordingToCsv wrote.
WhatIsSaid TakeSaid(std::string_view text) {
  WhatIsSaid said;
  for (;;) {
    const std::string_view line = TakeLine(text);
    if (line.starts_with(kNote)) {
      said.notes.emplace_back(line.substr(kNote.size()));
    } else if (line.starts_with(kDoubt)) {
      said.doubts.emplace_back(line.substr(kDoubt.size()));
    } else {
      return said;
    }
  }
}

/// Names and units of a table's columns.
std::vector<FileColumn> ColumnsOf(const TableFormat& table) {
  std::vector<FileColumn> columns;
  for (const std::string& column : table.names) columns.push_back({column});
  for (std::size_t k = 0; k < table.units.size(); ++k) columns[k].unit = table.units[k];
  return columns;
}

/// All columns of numbers or stamps by their own names.
FileContent ReadAllColumns(const TableFormat& table, std::string_view text,
                           const std::string& file) {
  FileContent content;
  content.columns = ColumnsOf(table);
  std::vector<WantedColumn> all;
  for (std::size_t k = 0; k < table.columns; ++k) all.push_back({k, true});
  TableReader(table, file, all, content).Read(text.substr(table.data));
  for (FileColumn& column : content.columns) {
    if (column.in_words) column.unit = "s";
  }
  return content;
}

/// Without the columns that hold texts, and notes say which.
FileContent WithoutTexts(FileContent content) {
  std::erase_if(content.columns, [&](const FileColumn& column) {
    if (column.refusal.empty()) return false;
    content.notes.push_back(
        fmt::format("column '{}' is left out: {}", Excerpt(column.name), column.refusal));
    return true;
  });
  return content;
}

/// The shortest digits that read back as the same double, below what is said of them. columns: of one length.
std::string ToText(const WhatIsSaid& said, const std::vector<std::string>& names,
                   const std::vector<const Eigen::VectorXd*>& columns) {
  fmt::memory_buffer text;
  const auto line = [&text](std::string_view mark, const std::string& sentence) {
    fmt::format_to(std::back_inserter(text), "{}{}\n", mark, sentence);
  };
  for (const std::string& note : said.notes) line(kNote, note);
  for (const std::string& doubt : said.doubts) line(kDoubt, doubt);
  fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(names, ","));
  const Eigen::Index samples = columns.empty() ? 0 : columns.front()->size();
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      fmt::format_to(std::back_inserter(text), "{}{}", k == 0 ? "" : ",", (*columns[k])[i]);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace

Measurements ReadCsv(const std::string& path, const ReadSettings& layout) {
  return ParseCsv(ReadWholeFile(path), InputName(path), layout);
}

FileContent ParseColumns(std::string_view text, const std::string& name, const ReadSettings& layout,
                         const WantedColumns& wanted) {
  const std::optional<std::string> utf8 = FromUtf16(text);
  if (utf8) text = *utf8;
  TableFormat table = FindTable(text, name, !layout.columns.empty());
  TakeNames(layout.columns, name, table);
  const bool is_timed = layout.rate > 0 || layout.map.contains("time");
  if (!is_timed && HasSeveralClocks(table.names)) {
    return OnOneClock(WithoutTexts(ReadAllColumns(table, text, name)));
  }
  const WhatIsSaid said = TakeSaid(text);
  FileContent content{.notes = said.notes, .doubts = said.doubts, .columns = ColumnsOf(table)};
  const auto columns = wanted(content, {name, std::max(1, table.header_line)}, "");
  TableReader(table, name, columns, content).Read(text.substr(table.data));
  return content;
}

std::vector<Measurements> ParseRecordings(std::string_view text, const std::string& name,
                                          const ReadSettings& layout) {
  return AssembleContent(ParseColumns(text, name, layout, ColumnsOfJoint(layout)), name, layout);
}

Measurements ParseCsv(std::string_view text, const std::string& name, const ReadSettings& layout) {
  return OnlyOne(ParseRecordings(text, name, layout));
}

FileContent ParseTable(std::string_view text, const std::string& name,
                       const std::vector<std::string>& names) {
  const std::optional<std::string> utf8 = FromUtf16(text);
  if (utf8) text = *utf8;
  TableFormat table = FindTable(text, name, !names.empty());
  TakeNames(names, name, table);
  FileContent content = WithoutTexts(ReadAllColumns(table, text, name));
  return HasSeveralClocks(table.names) ? OnOneClock(std::move(content)) : content;
}

std::string RecordingToCsv(const Measurements& measurements) {
  // the columns that are there
  std::vector<std::string> names;
  std::vector<const Eigen::VectorXd*> columns;
  for (const RecordingColumn& column : RecordingColumns()) {
    if (const Eigen::VectorXd* values = column.get(measurements)) {
      names.push_back(column.name);
      columns.push_back(values);
    }
  }
  return ToText({measurements.notes, measurements.doubts}, names, columns);
}

std::string ColumnsToCsv(const FileContent& content) {
  std::vector<std::string> names;
  std::vector<const Eigen::VectorXd*> columns;
  for (const FileColumn& column : content.columns) {
    // a name with a separator stands in quotes, which cannot hold others
    std::string name = column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
    if (name.find_first_of("\"\r\n") != std::string::npos) {
      Refuse({"convert"}, "the name {} cannot stand in a table of text; write .h5", Excerpt(name));
    }
    names.push_back(name.find_first_of(",#%") != std::string::npos ? "\"" + name + "\"" : name);
    columns.push_back(&column.values);
  }
  return ToText({content.notes, content.doubts}, names, columns);
}

}  // namespace warmjoint
