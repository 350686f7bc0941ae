#include "models/recording/table_format.h"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <map>
#include <set>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/units.h"

namespace warmjoint {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kMostFields = 10'000;
constexpr std::size_t kLinesOfALook = 1000;

/// A field without blanks and without a pair of quotes.
std::string_view Stripped(std::string_view field) {
  // most have neither, and begin and end behind both in ASCII
  if (!field.empty() && field.front() > '"' && field.back() > '"') return field;
  field = Trimmed(field);
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? field.substr(1, field.size() - 2) : field;
}

bool IsComment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  return first != std::string_view::npos && (line[first] == '#' || line[first] == '%');
}

/// A line of the look.
struct Line {
  std::string_view text;
  std::size_t begin = 0;  // byte
  int number = 0;
};

/// What a line holds if it is split in some way.
struct Shape {
  std::size_t fields = 0;      // 0: a blank line or a comment
  int numbers = 0, texts = 0;  // other fields are empty, or words for no number

  /// Rows of a table hold more than one number, or one and nothing else but fields without.
  bool IsRow() const { return numbers > 1 || (numbers == 1 && texts == 0 && fields > 1); }
  bool IsEmpty() const { return numbers + texts == 0; }
};

bool IsNumber(std::string_view field, char mark) {
  const std::optional<double> number = ReadCell(field, mark);
  return (number && *number == *number) || ReadStamp(field);
}

Shape ShapeOf(std::string_view line, char separator, char mark,
              std::vector<std::string_view>& fields) {
  Shape shape;
  if (IsBlankLine(line)) return shape;
  shape.fields = SplitLine(line, separator, fields);
  for (const std::string_view field : fields) {
    if (IsNumber(field, mark)) {
      ++shape.numbers;
    } else if (!ReadCell(field, mark)) {
      ++shape.texts;
    }
  }
  return shape;
}

/// A way to split the lines, and where its rows begin.
struct Look {
  char separator = ',', mark = '.';
  std::vector<Shape> shapes{};         // of each line
  std::size_t first = 0, columns = 0;  // line of the first row, and its fields
  long score = 0;                      // numbers less other texts of all rows
};

/// Finds the rows: as many fields as most rows have, from the first on that another follows. Where no line is a row of numbers,
/// they begin behind the first that is no comment, the header.
void FindRows(Look& look) {
  std::map<std::size_t, int> rows;  // by their number of fields
  std::vector<std::size_t> filled;  // lines with more than empty fields
  for (std::size_t i = 0; i < look.shapes.size(); ++i) {
    rows[look.shapes[i].fields] += look.shapes[i].IsRow();
    if (!look.shapes[i].IsEmpty()) filled.push_back(i);
  }
  look.columns =
      std::ranges::max_element(rows, {}, [](const auto& one) { return one.second; })->first;
  const auto is_row = [&](std::size_t i) {
    return look.shapes[i].IsRow() && look.shapes[i].fields == look.columns;
  };
  // a row by itself may be an entry of a preamble
  auto first = std::ranges::adjacent_find(
      filled, [&](std::size_t one, std::size_t next) { return is_row(one) && is_row(next); });
  if (first == filled.end()) first = std::ranges::find_if(filled, is_row);
  if (first != filled.end()) {
    look.first = *first;
    for (const std::size_t i : filled) {
      if (is_row(i)) look.score += look.shapes[i].numbers - look.shapes[i].texts;
    }
    return;
  }
  const auto header = std::ranges::find_if(look.shapes, &Shape::fields);
  look.first = static_cast<std::size_t>(header - look.shapes.begin()) + 1;
  look.columns = header->fields;
  // less than any look with rows
  look.score = std::numeric_limits<long>::min() + (look.columns > 1);
}

/// The way to split the lines by which most fields are numbers. One line at least is not blank.
Look BestLook(const std::vector<Line>& lines) {
  std::optional<Look> best;
  std::vector<std::string_view> fields;
  for (const char separator : {'\t', ';', ',', '|', ' '}) {
    for (const char mark : {'.', ','}) {
      if (separator == mark) continue;
      Look look{separator, mark};
      for (const Line& line : lines) {
        look.shapes.push_back(ShapeOf(line.text, separator, mark, fields));
      }
      FindRows(look);
      if (!best || look.score > best->score) best = std::move(look);
    }
  }
  return *best;
}

/// A text as UTF-8, as far as it can be read. from: as iconv calls its encoding.
std::string Converted(std::string_view text, const char* from) {
  std::string utf8(2 * text.size() + 4, '\0');  // no character of theirs takes more
  const iconv_t converter = iconv_open("UTF-8", from);
  char* in = const_cast<char*>(text.data());
  char* out = utf8.data();
  std::size_t left = text.size(), room = utf8.size();
  constexpr auto failed = static_cast<std::size_t>(-1);
  while (iconv(converter, &in, &left, &out, &room) == failed && errno == EILSEQ && left > 1) {
    // what is no character is left out
    in += 2;
    left -= 2;
  }
  iconv_close(converter);
  utf8.resize(utf8.size() - room);
  return utf8;
}

std::string Utf8(std::string_view name) {
  return FirstBrokenByte(name) ? Converted(name, "ISO-8859-1") : std::string(name);
}

/// The fields of a line above the rows, as many as those have; nothing where no separator gives so many. Such a line may lack a
/// separator at its end, or have one more, and may be split by other separators than the rows.
std::optional<std::vector<std::string>> FieldsAbove(std::string_view line, const TableFormat& table,
                                                    bool rows_end_empty) {
  // without the marks of a comment
  if (IsComment(line)) {
    line.remove_prefix(line.find_first_of("#%"));
    line.remove_prefix(std::min(line.find_first_not_of("#%"), line.size()));
  }
  std::vector<std::string_view> fields;
  for (const char separator : {table.separator, '\t', ';', ',', '|', ' '}) {
    if (SplitLine(line, separator, fields) > kMostFields) continue;
    // a unit behind a blank belongs to the name before it
    std::vector<std::string> names;
    for (const std::string_view field : fields) {
      const bool is_unit = separator == ' ' && !names.empty() && MeantUnit(field) &&
                           (field.front() == '[' || field.front() == '(');
      if (is_unit) names.back() += " " + Utf8(field);
      if (!is_unit) names.push_back(Utf8(field));
    }
    // a separator at the end of either
    if (names.size() == table.columns + 1 && names.back().empty()) names.pop_back();
    if (names.size() + 1 == table.columns && rows_end_empty) names.emplace_back();
    if (names.size() == table.columns) return names;
  }
  return std::nullopt;
}

/// The units of a row of them, as "s,rad,rad/s,Nm" or "[s];[-];[Nm]"; nothing where less than half of the fields are units.
std::optional<std::vector<std::string>> UnitsOf(std::vector<std::string> fields) {
  std::ptrdiff_t units = 0, others = 0;
  for (std::string& field : fields) {
    if (field == "-" || field == "[-]") field.clear();
    if (!field.empty()) ++(MeantUnit(field) ? units : others);
  }
  if (units == 0 || units < others) return std::nullopt;
  return fields;
}

/// Whether names are too few to tell columns apart: several are empty, or two are equal.
bool AreAlike(std::vector<std::string> names) {
  const bool has_gaps = std::ranges::count(names, std::string()) > 1;
  std::ranges::sort(names);
  const auto equal = [](const std::string& a, const std::string& b) {
    return !a.empty() && a == b;
  };
  return has_gaps || std::ranges::adjacent_find(names, equal) != names.end();
}

/// Names with those of a row above in front of them; a cell that is empty there goes on with the one to its left, as merged cells do.
/// Nothing where that row has numbers, or fewer than two names.
std::optional<std::vector<std::string>> JoinedNames(const std::vector<std::string>& above,
                                                    std::vector<std::string> names, char mark) {
  std::set<std::string> different;
  for (const std::string& name : above) {
    if (IsNumber(name, mark)) return std::nullopt;
    if (!name.empty()) different.insert(name);
  }
  if (different.size() < 2) return std::nullopt;
  std::string group;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!above[k].empty()) group = above[k];
    if (group.empty() || (above[k].empty() && names[k].empty())) continue;
    names[k] = names[k].empty() ? group : group + "/" + names[k];
  }
  return names;
}

/// Takes the names of further rows above those that were found, as long as names are alike.
void TakeGroups(const std::vector<Line>& lines, std::size_t header, TableFormat& table) {
  constexpr std::size_t most = 4;  // why: a joint, a quantity and a unit each have a row at most
  for (std::size_t i = header; i-- > 0 && header - i <= most && AreAlike(table.names);) {
    const auto above = FieldsAbove(lines[i].text, table, table.rows_end_empty);
    if (!above || IsBlankLine(lines[i].text)) return;
    auto names = JoinedNames(*above, table.names, table.decimal_mark);
    if (!names) return;
    table.names = std::move(*names);
  }
}

/// Takes names and units from the lines above the first row, the nearest first: nothing but blank lines and comments may stand
/// between. A comment is the header where no other line is.
void TakeHeader(const std::vector<Line>& lines, const Look& look, const std::string& file,
                bool is_named, TableFormat& table) {
  // units need names, above them or given: "sec,nanosec,x,y" alone is a header
  const auto has_names_above = [&](std::size_t i) {
    return is_named ||
           std::ranges::any_of(
               lines.begin(), lines.begin() + static_cast<long>(i), [&](const Line& line) {
                 return FieldsAbove(line.text, table, table.rows_end_empty).has_value();
               });
  };
  for (std::size_t i = look.first; i-- > 0;) {
    const Line& line = lines[i];
    const bool is_comment = IsComment(line.text);
    if (IsBlankLine(line.text) && !is_comment) continue;
    auto fields = FieldsAbove(line.text, table, table.rows_end_empty);
    const bool may_be_units = fields && table.units.empty() && has_names_above(i);
    if (auto units = may_be_units ? UnitsOf(*fields) : std::nullopt) {
      table.units = std::move(*units);
      continue;
    }
    if (fields && (!is_comment || table.names.empty())) {
      table.header = line.text;
      table.header_line = line.number;
      table.names = std::move(*fields);
      if (!is_comment) TakeGroups(lines, i, table);
    }
    if (is_comment) continue;
    // a line of several fields that are not those of the rows, where the header should stand
    if (!table.names.empty() || is_named || look.shapes[i].fields < 2) return;
    Refuse({file, line.number},
           "has {} fields where the rows below it have {}; complete or drop it, or name the "
           "columns, for "
           "example --columns time,position,velocity,torque",
           look.shapes[i].fields, table.columns);
  }
}

/// Takes the names of channels that TwinCAT writes above rows of their properties, "Name;position;Name;torque", which are no samples, though
/// some hold numbers; false where there are none.
bool TakeChannels(const std::vector<Line>& lines, Look& look, TableFormat& table) {
  for (std::size_t i = look.first; i-- > 0;) {
    auto fields = FieldsAbove(lines[i].text, table, false);
    const auto is_name = [](const std::string& field) { return EqualIgnoringCase(field, "name"); };
    if (!fields || !is_name(fields->front()) || std::ranges::count_if(*fields, is_name) < 2)
      continue;
    table.header = lines[i].text;
    table.header_line = lines[i].number;
    table.names = std::move(*fields);
    std::vector<std::string_view> row;
    const auto is_sample = [&] {
      SplitLine(lines[look.first].text, table.separator, row);
      return IsNumber(row.front(), table.decimal_mark);
    };
    while (look.first + 1 < lines.size() && !is_sample()) ++look.first;
    return true;
  }
  return false;
}

/// Refuses a decimal comma for which nothing speaks: behind it stand three digits in all numbers, as between thousands.
void CheckDecimalComma(const std::vector<Line>& lines, const Look& look, const std::string& file) {
  std::string doubtful;
  std::vector<std::string_view> fields;
  for (std::size_t i = look.first; i < lines.size(); ++i) {
    if (!look.shapes[i].IsRow()) continue;
    SplitLine(lines[i].text, look.separator, fields);
    for (const std::string_view field : fields) {
      const std::size_t comma = field.find(',');
      if (comma == std::string_view::npos || !ReadCell(field, ',')) continue;
      const bool is_small = ParseNumber(field.substr(0, comma)).value_or(0) == 0;
      if (is_small || field.size() - field.rfind(',') != 4) return;
      doubtful = field;
    }
  }
  if (doubtful.empty()) return;
  Refuse(
      {file, lines[look.first].number},
      "its numbers, as {}, may have a decimal comma or a comma between thousands; write decimals "
      "with a point and thousands without a mark",
      doubtful);
}

/// Whether the first row of numbers is a header that has numbers among its names: where it has a text, the next has a number.
bool IsHeader(std::string_view first, std::string_view next, const Look& look) {
  std::vector<std::string_view> names, numbers;
  SplitLine(first, look.separator, names);
  SplitLine(next, look.separator, numbers);
  for (std::size_t k = 0; k < std::min(names.size(), numbers.size()); ++k) {
    const bool is_text = !ReadCell(names[k], look.mark) || (k == 0 && names[k].empty());
    if (is_text && !IsNumber(names[k], look.mark) && IsNumber(numbers[k], look.mark)) return true;
  }
  return false;
}

}  // namespace

std::string_view TakeLine(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

bool IsBlankLine(std::string_view line) {
  return line.find_first_not_of(kBlanks) == std::string_view::npos || IsComment(line);
}

std::size_t SplitLine(std::string_view line, char separator,
                      std::vector<std::string_view>& fields) {
  fields.clear();
  if (separator == ' ') line = Trimmed(line);
  std::size_t begin = 0, count = 0;
  const auto take = [&](std::size_t end) {
    if (count++ < kMostFields) fields.push_back(Stripped(line.substr(begin, end - begin)));
    begin = end + 1;
    // of a run of blanks the last counts
    while (separator == ' ' && begin < line.size() && line[begin] == ' ') ++begin;
  };
  // only a separator outside of quotes parts two fields
  const bool has_quotes = line.find('"') != std::string_view::npos;
  if (!has_quotes) {
    for (std::size_t end; (end = line.find(separator, begin)) != std::string_view::npos;) take(end);
  } else {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"') quoted = !quoted;
      if (line[i] == separator && !quoted && i >= begin) take(i);
    }
  }
  take(line.size());
  return count;
}

std::optional<double> ReadCell(std::string_view field, char decimal_mark) {
  // the usual number first
  if (decimal_mark == '.' || field.find_first_of(",.") == std::string_view::npos) {
    if (const std::optional<double> number = ParseNumber(field)) return number;
  } else if (field.find('.') == std::string_view::npos && field.back() != ',') {
    std::string text(field);
    std::ranges::replace(text, ',', '.');
    if (const std::optional<double> number = ParseNumber(text)) return number;
  }
  // words for a number that is not there
  constexpr std::array<std::string_view, 11> words{"na", "n/a", "null", "none",    "nil",  "-",
                                                   "--", "---", "#n/a", "#div/0!", "#num!"};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (field.empty()) return nan;
  if (field.size() > 12) return std::nullopt;
  const std::string word = Lowercase(field);
  const std::size_t sharp = word.find("1.#");
  const bool is_infinite = word.find("inf") != std::string::npos;
  if (std::ranges::find(words, word) != words.end() || (sharp <= 1 && !is_infinite)) return nan;
  return std::nullopt;
}

std::optional<std::string> FromUtf16(std::string_view text) {
  // a byte-order mark, or plain characters with a zero byte each
  const std::string_view mark = text.substr(0, 2), next = text.substr(0, 4);
  const bool has_zeros = next.size() == 4 && (next[0] == 0) != (next[1] == 0) &&
                         (next[0] == 0) == (next[2] == 0) && (next[1] == 0) == (next[3] == 0);
  if (mark != "\xFF\xFE" && mark != "\xFE\xFF" && !has_zeros) return std::nullopt;
  const bool is_little = mark == "\xFF\xFE" || (has_zeros && next[1] == 0);
  return Converted(text, is_little ? "UTF-16LE" : "UTF-16BE");
}

TableFormat FindTable(std::string_view text, const std::string& file, bool is_named) {
  // the lines of the look, none of which is a directive to Excel
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string_view rest = text;
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  std::vector<Line> lines;
  for (int number = 1; !rest.empty() && lines.size() < kLinesOfALook; ++number) {
    const std::size_t begin = text.size() - rest.size();
    const std::string_view line = TakeLine(rest);
    const bool is_directive = line.starts_with("sep=") || line.starts_with("\"sep=");
    if (!is_directive) lines.push_back({line, begin, number});
  }

  if (std::ranges::all_of(lines, IsBlankLine, &Line::text)) {
    Refuse({file}, "is empty; it must hold a header row and one row for each sample");
  }

  // how they are split, and where the rows begin
  Look look = BestLook(lines);
  const auto has_rows = [&] { return look.first < lines.size(); };
  const Line& first = lines[has_rows() ? look.first : look.first - 1];
  TableFormat table;
  table.separator = look.separator;
  table.decimal_mark = look.mark;
  table.columns = look.columns;
  std::vector<std::string_view> row;
  SplitLine(first.text, look.separator, row);
  table.rows_end_empty = row.back().empty();
  if (table.columns > kMostFields) {
    Refuse({file, first.number}, "has {} columns; {} at most: leave out those that are not needed",
           table.columns, kMostFields);
  }
  if (has_rows() && look.mark == ',') CheckDecimalComma(lines, look, file);

  // what stands above them; the first of them may be a header of names that are numbers, too
  if (!TakeChannels(lines, look, table)) TakeHeader(lines, look, file, is_named, table);
  if (table.names.empty() && look.first + 1 < lines.size() &&
      IsHeader(first.text, lines[look.first + 1].text, look)) {
    ++look.first;
    TakeHeader(lines, look, file, is_named, table);
  }
  if (table.names.empty() && !is_named) {
    Refuse({file, first.number},
           "has no header row: it begins with '{}'. Name its {} columns, for example --columns "
           "time,position,velocity,torque; where none is time give --rate HZ",
           Excerpt(first.text), table.columns);
  }
  table.data = has_rows() ? lines[look.first].begin : text.size() - rest.size();
  table.data_line = has_rows() ? lines[look.first].number : lines.back().number + 1;
  return table;
}

}  // namespace warmjoint
