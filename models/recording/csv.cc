#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/recording/assemble.h"
#include "models/recording/one_clock.h"
#include "models/recording/read_recording.h"
#include "models/recording/table_format.h"
#include "models/recording/units.h"

namespace warmjoint {
namespace {

[[noreturn]] void RefuseText(const Place& place, const ColumnSource& source,
                             const std::string& name, std::string_view text) {
  if (source.column->name == "time") {
    Refuse(
        place,
        "{} is '{}', which is neither a number nor a stamp as 2024-03-01T12:00:00.5, 12:00:00.5 or "
        "'0.5 s'; give one of these, or --rate HZ",
        Excerpt(name), Excerpt(text));
  }
  const bool has_comma = text.find(',') != std::string_view::npos;
  Refuse(place, "{} is '{}', which is not a number{}", Excerpt(name), Excerpt(text),
         has_comma ? "; write decimals with a point and thousands without a mark" : "");
}

/// Reads rows into the sources of `raw`.
class TableReader {
 public:
  TableReader(const TableFormat& table, RawColumns& raw) : table_(table), raw_(raw) {}

  /// NaN where a field holds no number; other columns may hold anything. Leaves out headers that stand again among the rows,
  /// and a last row that was cut. Throws BadInput for other rows that lack fields or have too many, and for text in a number.
  void Read(std::string_view rows);

 private:
  /// Reads the fields of one row into sample `sample`; the source whose field holds no number, or nullptr.
  const ColumnSource* ReadRow(Eigen::Index sample);

  const RecordingColumn* const time_ = &RecordingColumns().front();
  const TableFormat& table_;
  RawColumns& raw_;
  std::optional<bool> in_words_;  // whether times are stamps, once one was read
  std::vector<std::string_view> fields_;
};

const ColumnSource* TableReader::ReadRow(Eigen::Index sample) {
  for (ColumnSource& source : raw_.columns) {
    const std::string_view field = fields_[source.index];
    std::optional<double> value = ReadCell(field, table_.decimal_mark);
    if (source.column == time_ && !(value && std::isnan(*value))) {
      // stamps in words are no numbers, all of them or none
      const bool is_stamp = !value;
      if (is_stamp) value = ReadStamp(field);
      if (in_words_.value_or(is_stamp) != is_stamp) value.reset();
      if (value) in_words_ = is_stamp;
    }
    if (!value) return &source;
    source.values[sample] = *value;
  }
  return nullptr;
}

void TableReader::Read(std::string_view rows) {
  // a row has a separator or an end for each field, and digits for each that is read: blank lines take no room
  const auto lines = static_cast<std::size_t>(1 + std::count(rows.begin(), rows.end(), '\n'));
  const auto most = static_cast<Eigen::Index>(
      std::min(lines, 1 + rows.size() / (table_.columns + raw_.columns.size())));
  for (ColumnSource& source : raw_.columns) source.values.resize(most);
  raw_.line.reserve(static_cast<std::size_t>(most));

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
    const auto sample = static_cast<Eigen::Index>(raw_.line.size());
    const ColumnSource* const bad = fits ? ReadRow(sample) : nullptr;
    if (fits && !bad) {
      raw_.line.push_back(line);
    } else if (row == table_.header) {
      ++repeated;
    } else if (sample > 0 &&
               rows.find_first_not_of(std::string_view(" \t\r\n\0", 5)) == std::string_view::npos) {
      raw_.notes.push_back(fmt::format("line {}, the last, is no whole row and is left out", line));
      break;
    } else if (bad) {
      RefuseText({raw_.file, line}, *bad, table_.names[bad->index], fields_[bad->index]);
    } else {
      Refuse({raw_.file, line}, "has {} fields where the {} {}; complete or drop the row", count,
             table_.header_line > 0 ? "header has" : "rows before have", table_.columns);
    }
  }
  if (repeated > 0) {
    raw_.notes.push_back(fmt::format("{} more headers among the rows are left out", repeated));
  }

  raw_.stamps = in_words_.value_or(false);
  // no longer than the rows that were there
  for (ColumnSource& source : raw_.columns) {
    source.values.conservativeResize(static_cast<Eigen::Index>(raw_.line.size()));
  }
}

/// The names that are given, one for each column.
void TakeNames(const std::vector<std::string>& given, const std::string& file, TableFormat& table) {
  if (given.empty()) return;
  if (given.size() != table.columns) {
    Refuse({file, table.data_line}, "has {} columns where --columns names {}; a name may be empty",
           table.columns, given.size());
  }
  table.names = given;
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

/// The first text of each column that is neither a number nor a stamp, with its line; columns without one have none.
std::vector<std::pair<int, std::string>> TextsOf(const TableFormat& table, std::string_view rows) {
  std::vector<std::pair<int, std::string>> texts(table.columns);
  std::vector<std::string_view> fields;
  for (int line = table.data_line; !rows.empty(); ++line) {
    const std::string_view row = TakeLine(rows);
    if (IsBlankLine(row) || row == table.header) continue;
    SplitLine(row, table.separator, fields);
    for (std::size_t k = 0; k < std::min(fields.size(), table.columns); ++k) {
      const bool is_read = !texts[k].second.empty() || ReadCell(fields[k], table.decimal_mark) ||
                           ReadStamp(fields[k]);
      if (!is_read) texts[k] = {line, std::string(fields[k])};
    }
  }
  return texts;
}

/// All columns of numbers or stamps by their own names. Those that hold texts are left out, and notes say which.
FileContent ReadAllColumns(const TableFormat& table, std::string_view text,
                           const std::string& file) {
  const std::string_view rows = text.substr(table.data);
  const auto texts = TextsOf(table, rows);
  std::vector<FileColumn> columns = ColumnsOf(table);
  // stamps may stand in any column, as times do
  const RecordingColumn* const time = &RecordingColumns().front();
  FileContent content;
  for (std::size_t k = 0; k < table.columns; ++k) {
    if (!texts[k].second.empty()) {
      content.notes.push_back(fmt::format("column '{}' is left out: line {} holds the text '{}'",
                                          Excerpt(columns[k].name), texts[k].first,
                                          Excerpt(texts[k].second)));
      continue;
    }
    RawColumns one{file, {{.column = time, .index = k}}};
    TableReader(table, one).Read(rows);
    if (one.stamps) columns[k].unit = "s";
    columns[k].values = std::move(one.columns.front().values);
    content.columns.push_back(std::move(columns[k]));
    if (content.columns.size() == 1) {
      std::ranges::move(one.notes, std::back_inserter(content.notes));
    }
  }
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

std::vector<Measurements> ParseRecordings(std::string_view text, const std::string& name,
                                          const ReadSettings& layout) {
  const std::optional<std::string> utf8 = FromUtf16(text);
  if (utf8) text = *utf8;
  const WhatIsSaid said = TakeSaid(text);
  TableFormat table = FindTable(text, name, !layout.columns.empty());
  TakeNames(layout.columns, name, table);
  const bool is_timed = layout.rate > 0 || layout.map.contains("time");
  if (!is_timed && HasSeveralClocks(table.names)) {
    return AssembleContent(OnOneClock(ReadAllColumns(table, text, name)), name, layout);
  }

  const std::vector<FileColumn> columns = ColumnsOf(table);
  const Place place{name, std::max(1, table.header_line)};
  RawColumns raw{name, FindColumns(columns, WithClock(columns, layout, place), place)};
  raw.notes = said.notes;
  raw.doubts = said.doubts;
  TableReader(table, raw).Read(text.substr(table.data));
  return AssembleRecordings(std::move(raw), columns, layout);
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
  FileContent content = ReadAllColumns(table, text, name);
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
