#include "models/recording/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/recording/assemble.h"
#include "models/recording/clock.h"
#include "models/recording/table_format.h"

namespace warmjoint {
namespace {

[[noreturn]] void RefuseText(const Place& place, const ColumnSource& source,
                             const std::string& name, std::string_view text) {
  if (source.column->name == "time") {
    Refuse(
        place,
        "{} is '{}', which is neither a number nor a stamp as 2024-03-01T12:00:00.5, 12:00:00.5 or "
        "'0.5 s'; tools/convert reads other stamps",
        Excerpt(name), Excerpt(text));
  }
  const bool has_comma = text.find(',') != std::string_view::npos;
  Refuse(place, "{} is '{}', which is not a number{}", Excerpt(name), Excerpt(text),
         has_comma ? "; write decimals with a point and thousands without a mark" : "");
}

/// Reads rows into columns.
class TableReader {
 public:
  TableReader(const TableFormat& table, const std::string& file,
              const std::vector<ColumnSource>& sources)
      : table_(table),
        file_(file),
        sources_(sources),
        times_(static_cast<std::size_t>(std::ranges::count_if(
            sources, [](const ColumnSource& one) { return one.column->name == "time"; }))) {}

  /// The numbers of the sources, NaN where a field holds none; other columns may hold anything. Leaves out headers that stand
  /// again among the rows, and a last row that was cut. Throws BadInput for other rows that lack fields or have too many, and
  /// for text in a number.
  RawColumns Read(std::string_view rows);

 private:
  /// Reads the fields of one row into sample `sample`; the source whose field holds no number, or -1.
  std::ptrdiff_t ReadRow(Eigen::Index sample, RawColumns& raw);

  [[noreturn]] void RefuseRow(int line, std::size_t count, std::ptrdiff_t bad) const;

  const TableFormat& table_;
  const std::string& file_;
  const std::vector<ColumnSource>& sources_;
  const std::size_t times_;       // of the sources, which come first
  std::optional<bool> in_words_;  // whether they are stamps, once one was read
  std::vector<std::string_view> fields_;
};

std::ptrdiff_t TableReader::ReadRow(Eigen::Index sample, RawColumns& raw) {
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    const std::string_view field = fields_[sources_[k].index];
    std::optional<double> value = ReadCell(field, table_.decimal_mark);
    if (k < times_ && !(value && std::isnan(*value))) {
      // stamps in words are no numbers, all of them or none
      const bool is_stamp = !value;
      if (is_stamp) value = ReadStamp(field);
      if (in_words_.value_or(is_stamp) != is_stamp) value.reset();
      if (value) in_words_ = is_stamp;
    }
    if (!value) return static_cast<std::ptrdiff_t>(k);
    raw.values[k][sample] = *value;
  }
  return -1;
}

void TableReader::RefuseRow(int line, std::size_t count, std::ptrdiff_t bad) const {
  if (bad < 0) {
    Refuse({file_, line}, "has {} fields where the {} {}; complete or drop the row", count,
           table_.header_line > 0 ? "header has" : "rows before have", table_.columns);
  }
  const ColumnSource& source = sources_[static_cast<std::size_t>(bad)];
  RefuseText({file_, line}, source, table_.names[source.index], fields_[source.index]);
}

RawColumns TableReader::Read(std::string_view rows) {
  // a row has a separator or an end for each field, and digits for each that is read: blank lines take no room
  const auto lines = static_cast<std::size_t>(1 + std::count(rows.begin(), rows.end(), '\n'));
  const std::size_t most = std::min(lines, 1 + rows.size() / (table_.columns + sources_.size()));
  RawColumns raw;
  raw.file = file_;
  raw.values.assign(sources_.size(), Eigen::VectorXd(static_cast<Eigen::Index>(most)));
  raw.line.reserve(most);

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
    const auto sample = static_cast<Eigen::Index>(raw.line.size());
    const std::ptrdiff_t bad = fits ? ReadRow(sample, raw) : -1;
    if (fits && bad < 0) {
      raw.line.push_back(line);
    } else if (row == table_.header) {
      ++repeated;
    } else if (raw.line.empty() ||
               rows.find_first_not_of(std::string_view(" \t\r\n\0", 5)) != std::string_view::npos) {
      RefuseRow(line, count, bad);
    } else {
      raw.notes.push_back(fmt::format("line {}, the last, is no whole row and is left out", line));
      break;
    }
  }
  if (repeated > 0) {
    raw.notes.push_back(fmt::format("{} more headers among the rows are left out", repeated));
  }

  raw.stamps = in_words_.value_or(false);
  // no longer than the rows that were there
  for (Eigen::VectorXd& values : raw.values) {
    values.conservativeResize(static_cast<Eigen::Index>(raw.line.size()));
  }
  return raw;
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

}  // namespace

Measurements ReadCsv(const std::string& path, const ReadSettings& layout) {
  return ParseCsv(ReadWholeFile(path), InputName(path), layout);
}

Measurements ParseCsv(std::string_view text, const std::string& name, const ReadSettings& layout) {
  const std::optional<std::string> utf8 = FromUtf16(text);
  if (utf8) text = *utf8;
  TableFormat table = FindTable(text, name, !layout.columns.empty());
  TakeNames(layout.columns, name, table);

  // a row of units says what --unit does not
  FileContent content;
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    content.columns.push_back({table.names[k], table.units.empty() ? "" : table.units[k], {}});
  }
  const Place header{name, std::max(1, table.header_line)};
  const ReadSettings completed = WithAttributes(layout, content, header);
  const std::vector<ColumnSource> sources = FindColumns(table.names, completed, header);

  return AssembleMeasurements(TableReader(table, name, sources).Read(text.substr(table.data)),
                              sources, layout);
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

  // the shortest digits that read back as the same double
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(names, ","));
  for (Eigen::Index i = 0; i < measurements.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      fmt::format_to(std::back_inserter(text), "{}{}", k == 0 ? "" : ",", (*columns[k])[i]);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace warmjoint
