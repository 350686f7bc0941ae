#include "models/recording/csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/assemble.h"

namespace warmjoint {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kMostFields = 10'000;

/// Takes one line off the front of `rest`.
std::string_view TakeLine(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool IsEmpty(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  return first == std::string_view::npos || line[first] == '#';
}

std::string_view Stripped(std::string_view field) {
  const std::size_t first = field.find_first_not_of(kBlanks);
  // without blanks, and without a pair of quotes
  if (first == std::string_view::npos) return {};
  field = field.substr(first, field.find_last_not_of(kBlanks) - first + 1);
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? field.substr(1, field.size() - 2) : field;
}

/// Splits a line at separators outside quotes. Returns the number of fields, of which kMostFields are kept.
std::size_t Split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0, count = 0;
  const auto take = [&](std::size_t end) {
    if (count++ < kMostFields) fields.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  };
  // only a separator outside of quotes parts two fields
  const bool has_quotes = line.find('"') != std::string_view::npos;
  if (!has_quotes) {
    for (std::size_t end; (end = line.find(separator, begin)) != std::string_view::npos;) take(end);
  } else {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"') quoted = !quoted;
      if (line[i] == separator && !quoted) take(i);
    }
  }
  take(line.size());
  return count;
}

char SeparatorOf(std::string_view header) {
  for (const char separator : {'\t', ';'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

[[noreturn]] void RefuseText(const Place& place, const std::string& column, std::string_view text) {
  if (text.empty()) Refuse(place, "{} is empty; every sample needs a number", Excerpt(column));
  const bool has_comma = text.find(',') != std::string_view::npos;
  Refuse(place, "{} is '{}', which is not a number{}", Excerpt(column), Excerpt(text),
         has_comma ? "; write decimals with a point" : "");
}

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

CsvText::CsvText(std::string_view text, std::string file) : file_(std::move(file)), rows_(text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (rows_.substr(0, 3) == byte_order_mark) rows_.remove_prefix(3);

  // the header is the first line that is neither empty nor a comment
  std::string_view header;
  while (!rows_.empty() && IsEmpty(header)) {
    header = TakeLine(rows_);
    ++header_line_;
  }
  if (IsEmpty(header)) {
    Refuse({file_}, "is empty; it must hold a header row and one row for each sample");
  }

  // its names, which are not all numbers
  separator_ = SeparatorOf(header);
  std::vector<std::string_view> fields;
  const std::size_t columns = Split(header, separator_, fields);
  if (columns > kMostFields) {
    Refuse(header_place(), "has {} columns; {} at most: leave out those that are not needed",
           columns, kMostFields);
  }
  for (const std::string_view field : fields) names_.emplace_back(Stripped(field));
  if (std::all_of(names_.begin(), names_.end(), [](auto& name) { return ParseNumber(name); })) {
    Refuse(header_place(),
           "holds numbers where the header row must stand; add one, for example "
           "time,position,velocity,torque");
  }
}

RawColumns CsvText::ReadColumns(const std::vector<std::size_t>& indices) const {
  // a row has a separator or an end for each field, and digits for each that is read: blank lines take no room
  const auto lines = static_cast<std::size_t>(1 + std::count(rows_.begin(), rows_.end(), '\n'));
  const std::size_t rows = std::min(lines, 1 + rows_.size() / (names_.size() + indices.size()));
  RawColumns raw{file_, {}, {indices.size(), Eigen::VectorXd(rows)}};
  raw.line.reserve(rows);

  // one sample for each row
  std::string_view rest = rows_;
  std::vector<std::string_view> fields;
  for (int line = header_line_ + 1; !rest.empty(); ++line) {
    const std::string_view row = TakeLine(rest);
    if (IsEmpty(row)) continue;
    const std::size_t count = Split(row, separator_, fields);
    if (count != names_.size()) {
      Refuse({file_, line}, "has {} fields where the header has {}; complete or drop the row",
             count, names_.size());
    }

    // the columns that are asked for
    const auto sample = static_cast<Eigen::Index>(raw.line.size());
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const std::string_view text = Stripped(fields[indices[k]]);
      const std::optional<double> value = ParseNumber(text);
      if (!value) RefuseText({file_, line}, names_[indices[k]], text);
      raw.values[k][sample] = *value;
    }
    raw.line.push_back(line);
  }

  // no longer than the rows that were there
  for (Eigen::VectorXd& values : raw.values) {
    values.conservativeResize(static_cast<Eigen::Index>(raw.line.size()));
  }
  return raw;
}

}  // namespace

Measurements ReadCsv(const std::string& path, const ReadSettings& layout) {
  return ParseCsv(ReadWholeFile(path), InputName(path), layout);
}

Measurements ParseCsv(std::string_view text, const std::string& name, const ReadSettings& layout) {
  // the header tells where the columns are, and only those are read
  const CsvText csv(text, name);
  const std::vector<ColumnSource> sources = FindColumns(csv.names(), layout, csv.header_place());

  std::vector<std::size_t> indices;
  for (const ColumnSource& source : sources) indices.push_back(source.index);
  return AssembleMeasurements(csv.ReadColumns(indices), sources, layout);
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
