#include "models/recording/recording_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/recording/stand_in.h"
#include "models/recording/time_names.h"

namespace warmjoint {
namespace {

using Values = Eigen::VectorXd;

constexpr const char* kTime = "time";
constexpr const char* kTemperature = "temperature";
constexpr const char* kPosition = "position";
constexpr const char* kVelocity = "velocity";
constexpr const char* kTorque = "torque";

/// Parts of the names that foreign files give to columns, in lower case, the likeliest first.
const std::map<std::string, std::vector<std::string>> kHints{
    {"time", {"time", "stamp", "zeit", "duration", "x_value", "t"}},
    {"position", {"pos", "angle", "winkel", "q", "theta"}},
    {"velocity", {"vel", "speed", "drehzahl", "geschwindigkeit", "qd", "dq", "omega", "v"}},
    {"torque",
     {"torque", "tau", "force", "effort", "moment", "current", "strom", "trq", "load", "iq", "pwm",
      "duty", "volt", "i"}},
    {"motor_position", {"motor"}},
    {"load", {"load"}},
    {"temperature", {"temp"}},
};

template <auto member>
const Values* Get(const Measurements& measurements) {
  const auto& values = measurements.*member;
  if constexpr (std::is_same_v<std::decay_t<decltype(values)>, Values>) {
    return values.size() > 0 ? &values : nullptr;
  } else {
    return values ? &*values : nullptr;
  }
}

/// The position, where it was logged.
const Values* LoggedPosition(const Measurements& measurements) {
  return measurements.position_integrated ? nullptr : Get<&Measurements::position>(measurements);
}

template <auto member>
void Set(Measurements& measurements, Values values) {
  measurements.*member = std::move(values);
}

template <typename Columns>
void CheckNames(const Columns& given, std::string_view option, const Place& place) {
  // a column of ours on the left, theirs on the right
  const std::vector<std::string> known = ColumnNames();
  for (const auto& [ours, theirs] : given) {
    if (std::find(known.begin(), known.end(), ours) != known.end()) continue;
    Refuse(place, "{} {}={}: recordings have no column '{}'{}", option, Excerpt(ours),
           Excerpt(fmt::format("{}", theirs)), Excerpt(ours), Suggestion(ours, known));
  }
}

/// A name in the file that looks like `column`.
std::optional<std::string> LikelyName(const RecordingColumn& column,
                                      const std::vector<std::string>& names) {
  // the first hint that fits counts
  for (const std::string& hint : kHints.at(column.name)) {
    for (const std::string& name : names) {
      const std::string lower = Lowercase(name);
      const bool is_letter = hint.size() == 1;  // "t" fits t, t_s, t [s], but not torque
      // a voltage is no velocity
      if (hint == "v" && SplitUnit(name, {"V"}).unit) continue;
      const bool fits =
          is_letter ? lower.substr(0, 1) == hint && (lower.size() == 1 || !std::isalpha(lower[1]))
                    : lower.find(hint) != std::string::npos;
      if (fits) return Excerpt(name);
    }
  }
  return std::nullopt;
}

/// missing: the columns that are needed, and others that the file may hold under another name; names: of all columns; free: of those that
/// no other column of ours has
[[noreturn]] void RefuseMissing(const std::vector<const RecordingColumn*>& missing,
                                const std::vector<std::string>& names,
                                const std::vector<std::string>& free, const Place& place,
                                const std::string& there) {
  // what is lacking, and which names may be meant
  std::vector<std::string> lacking, remedy, units;
  for (const RecordingColumn* column : missing) {
    const std::string likely = LikelyName(*column, free).value_or("NAME");
    if (column->required) lacking.push_back(fmt::format("'{}'", column->name));
    remedy.push_back(column->name + "=" + likely);
    const StandIn* const stand_in = column->name == kTorque ? StandInOf(likely) : nullptr;
    if (stand_in && !SplitUnit(likely).unit) {
      units.push_back(fmt::format("torque={}", stand_in->Unit()));
    }
    // v_deg says by what the velocity changes the position
    const auto distance = SplitUnit(likely, {"rad", "m"}).unit;
    if (column->name == kVelocity && distance) {
      units.push_back(fmt::format("velocity={}/s", distance->name));
    }
  }
  const std::string unit = units.empty() ? "" : fmt::format(" --unit {}", fmt::join(units, ","));
  // for a shell, which must not split names
  std::string pairs = fmt::format("{}", fmt::join(remedy, ","));
  if (pairs.find_first_of(" ()[]&;|*'") != std::string::npos) pairs = "'" + pairs + "'";
  const auto lacks = [&](std::string_view name) {
    return std::ranges::find(missing, name, &RecordingColumn::name) != missing.end();
  };
  Refuse(place, "has no column {}; it has: {}. Name them: --map {}{}{}{}",
         fmt::join(lacking, " and no "), there.empty() ? ExcerptOfList(names) : there, pairs, unit,
         lacks("time") ? ", or give --rate HZ where none is time" : "",
         lacks(kPosition) ? "; where only a velocity was logged, --map position=" : "");
}

/// Length of the groups that all of several columns lie in, with their separators.
std::size_t LengthOfGroups(const std::vector<FileColumn>& columns) {
  std::string common = columns.size() < 2 ? "" : columns.front().name;
  for (const FileColumn& one : columns) {
    // as far as both are alike, and no further than a group
    common.erase(std::ranges::mismatch(common, one.name).in1, common.end());
    common.erase(common.find_last_of("./") + 1);
  }
  return common.size();
}

/// A name whose separators are dots.
std::string Plain(std::string name) {
  std::ranges::replace(name, '/', '.');
  return name.starts_with('.') ? name.substr(1) : name;
}

/// What is searched for our columns.
struct Header {
  const std::vector<FileColumn>& columns;
  const ReadSettings& layout;
  const Place& place;
  std::vector<std::string> names{};  // of the columns, without groups that all lie in
  std::vector<bool> given{};         // whether `map` gives the column to one of ours
};

/// Indices of the columns for which `fits` holds.
template <typename Fits>
std::vector<std::size_t> Where(const Header& header, Fits&& fits) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < header.names.size(); ++i) {
    if (fits(i)) found.push_back(i);
  }
  return found;
}

/// The column that a user calls so, or none.
std::vector<std::size_t> Named(const Header& header, const std::string& name) {
  const auto& [columns, layout, place, names, given] = header;
  const auto exact =
      Where(header, [&](std::size_t i) { return names[i] == name || columns[i].name == name; });
  if (exact.size() > 1) Refuse(place, "has column '{}' twice; rename one", Excerpt(name));
  if (exact.size() == 1) return exact;
  const std::string plain = Plain(name);
  const auto alike = Where(header, [&](std::size_t i) {
    return Plain(names[i]) == plain || Plain(columns[i].name) == plain;
  });
  return alike.size() == 1 ? alike : exact;
}

/// Name and unit of a file's column that is one of ours.
NameAndUnit Split(const RecordingColumn& column, const std::string& name, JointKind joint) {
  NameAndUnit split = SplitUnit(name, column.Units(joint));
  if (column.name != kTemperature) return split;
  // K may be anything, as F and C: the rest must speak of a temperature
  const std::string stem = Lowercase(split.stem);
  const bool speaks = stem.find("temp") != std::string::npos || stem == "t" ||
                      stem.starts_with("t_") || stem.starts_with("t ");
  const std::string_view behind = std::string_view(name).substr(split.stem.size());
  const auto is_of_unit = [](unsigned char c) { return std::isalpha(c) || c >= 0x80; };
  if (split.unit && !speaks && std::ranges::count_if(behind, is_of_unit) == 1) split.unit.reset();
  return split;
}

/// The column that `map` says; two whose sum is the time, as time=secs+nsecs; none for an empty name.
std::vector<std::size_t> FindMapped(const Header& header, const std::string& column,
                                    const std::string& theirs) {
  if (theirs.empty()) return {};
  std::vector<std::size_t> found = Named(header, theirs);
  for (std::size_t plus = 0; found.empty() && column == "time"; ++plus) {
    plus = theirs.find('+', plus);
    if (plus == std::string::npos) break;
    const auto first = Named(header, theirs.substr(0, plus)),
               second = Named(header, theirs.substr(plus + 1));
    if (!first.empty() && !second.empty()) found = {first[0], second[0]};
  }
  if (!found.empty()) return found;
  Refuse(header.place, "has no column '{}' (for {}){}", Excerpt(theirs), column,
         Suggestion(theirs, header.names));
}

/// Marks the columns that `map` gives to one of ours: none is found for another, and none is given twice.
void MarkGiven(Header& header) {
  header.given.assign(header.names.size(), false);
  for (const RecordingColumn& column : RecordingColumns()) {
    const auto mapped = header.layout.map.find(column.name);
    if (mapped == header.layout.map.end()) continue;
    for (const std::size_t i : FindMapped(header, column.name, mapped->second)) {
      if (header.given[i]) {
        Refuse(header.place, "--map gives '{}' to {} and to another column; give it to one",
               Excerpt(header.names[i]), column.name);
      }
      header.given[i] = true;
    }
  }
}

/// The names of all columns without groups that all lie in, and which of them `map` gives away.
Header HeaderOf(const std::vector<FileColumn>& columns, const ReadSettings& layout,
                const Place& place) {
  Header header{columns, layout, place};
  const std::size_t groups = LengthOfGroups(columns);
  for (const FileColumn& one : columns) header.names.push_back(one.name.substr(groups));
  MarkGiven(header);
  return header;
}

/// The time by its name in any spelling, among the columns that are not given away.
std::vector<std::size_t> TimeOf(const Header& header) {
  std::vector<std::string> names = header.names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (header.given[i]) names[i].clear();
  }
  return FindTime(names, {kTime});
}

/// The columns of a file that are one of ours.
std::vector<std::size_t> Find(const Header& header, const RecordingColumn& column) {
  const auto mapped = header.layout.map.find(column.name);
  if (mapped != header.layout.map.end()) return FindMapped(header, column.name, mapped->second);
  std::vector<std::size_t> found = Named(header, column.name);
  std::erase_if(found, [&](std::size_t i) { return header.given[i]; });
  if (!found.empty()) return found;
  // our name in other letters or with a unit; a temperature by its unit alone
  const auto where = [&](auto&& fits) {
    return Where(header, [&](std::size_t i) {
      return !header.given[i] && fits(Split(column, header.names[i], header.layout.joint));
    });
  };
  found = where([&](const NameAndUnit& split) { return Lowercase(split.stem) == column.name; });
  if (found.size() != 1 && column.name == kTemperature) {
    found = where([](const NameAndUnit& split) { return split.unit.has_value(); });
  }
  if (found.size() != 1 && column.name == kTime) found = TimeOf(header);
  return found.size() == 1 || column.name == kTime ? found : std::vector<std::size_t>();
}

/// Refuses a torque of which nobody says the unit, and whose name says that it is something else. A factor makes it a torque,
/// other than one that turns it.
void AskForUnit(const Header& header, const RecordingColumn& column, const std::string& name) {
  const auto scale = header.layout.scale.find(column.name);
  const bool is_scaled = scale != header.layout.scale.end() && std::abs(scale->second) != 1;
  const StandIn* const stand_in = column.name != kTorque || is_scaled ? nullptr : StandInOf(name);
  if (!stand_in || name == column.name) return;
  const std::string torque = column.Units(header.layout.joint).front();
  Refuse(header.place,
         "torque from '{}', by its name {}, and nobody says its unit: --unit torque={} ({}); "
         "--unit torque={} where it is a torque",
         Excerpt(name), stand_in->name, stand_in->Unit(), stand_in->units, torque);
}

/// The unit of a column, and who says so: an option, the file beside the name, or the name.
void TakeUnit(const Header& header, ColumnSource& source) {
  const RecordingColumn& column = *source.column;
  const std::string& name = header.names[source.index];
  const std::vector<std::string>& bases = column.Units(header.layout.joint);
  const auto take = [&](std::string_view unit, UnitFrom from) {
    source.unit = FindUnit(unit, bases, column.name, header.place);
    source.unit_from = from;
  };
  const auto given = header.layout.unit.find(column.name);
  const NameAndUnit any = SplitUnit(name);
  const auto behind = Split(column, name, header.layout.joint).unit;
  // the name of a part of the time may be its unit, as nsecs
  const auto in_name = source.is_added && !behind ? MeantUnit(UnitOfPart(name), bases) : behind;
  if (given != header.layout.unit.end() && !source.is_added) {
    take(given->second, UnitFrom::option);
  } else if (const std::string& unit = header.columns[source.index].unit; !unit.empty()) {
    take(unit, UnitFrom::file);
  } else if (in_name || any.is_sure) {
    take(in_name ? in_name->name : any.unit->name, UnitFrom::name);
  } else {
    take(bases.front(), UnitFrom::nobody);
    AskForUnit(header, column, name);
  }
  // a count is of no size by itself
  if (!source.unit.name.starts_with("counts") || header.layout.scale.contains(column.name)) return;
  Refuse(header.place, "{} in counts needs the {} of one: --scale {}=FACTOR", column.name,
         bases.front(), column.name);
}

/// The same quantity of other joints: names that differ in one number, as q[1] from q[3].
std::vector<std::string> OfOtherJoints(const std::string& name,
                                       const std::vector<std::string>& names) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::vector<std::string> others;
  for (const std::string& other : names) {
    // what differs between a common beginning and a common end, with all digits of a number
    auto [from, other_from] = std::ranges::mismatch(name, other);
    while (from != name.begin() && is_digit(*std::prev(from))) --from, --other_from;
    auto end = name.end(), other_end = other.end();
    while (end != from && other_end != other_from && *std::prev(end) == *std::prev(other_end) &&
           !is_digit(*std::prev(end))) {
      --end, --other_end;
    }
    const bool differ = from != end && other_from != other_end && name != other;
    if (differ && std::all_of(from, end, is_digit) &&
        std::all_of(other_from, other_end, is_digit)) {
      others.push_back(other);
    }
  }
  return others;
}

/// Whether a log does without positions: its velocity tells them, and no other column may be meant, or none is wanted.
bool DoWithout(const Header& header, const RecordingColumn& position,
               const std::vector<ColumnSource>& sources) {
  std::vector<std::string> others = header.names;
  bool has_velocity = false;
  for (const ColumnSource& source : sources) {
    others[source.index].clear();
    has_velocity = has_velocity || source.column->name == "velocity";
  }
  return has_velocity && !header.layout.unit.contains(position.name) &&
         (header.layout.map.contains(position.name) || !LikelyName(position, others));
}

}  // namespace

const std::vector<RecordingColumn>& RecordingColumns() {
  // name, whether it is needed, units of rotary and linear joints, and where it lies
  using M = Measurements;
  static const std::vector<RecordingColumn> columns{
      {kTime, true, {"s"}, {"s"}, Get<&M::time>, Set<&M::time>},
      {kPosition, true, {"rad"}, {"m"}, LoggedPosition, Set<&M::position>},
      {"velocity", false, {"rad/s"}, {"m/s"}, Get<&M::velocity>, Set<&M::velocity>},
      {"torque",
       true,
       {"N.m", "A", "V", "%", "raw"},
       {"N", "A", "V", "%", "raw"},
       Get<&M::torque>,
       Set<&M::torque>},
      {"motor_position", false, {"rad"}, {"rad"}, Get<&M::motor_position>, Set<&M::motor_position>},
      {"load", false, {"N.m"}, {"N"}, Get<&M::load>, Set<&M::load>},
      {kTemperature, false, {"degC"}, {"degC"}, Get<&M::temperature>, Set<&M::temperature>},
  };
  return columns;
}

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names;
  for (const RecordingColumn& column : RecordingColumns()) names.push_back(column.name);
  return names;
}

std::string UnitOf(const RecordingColumn& column, const Measurements& measurements) {
  if (column.name == "torque") return measurements.torque_unit;
  return column.Units(measurements.joint).front();
}

std::vector<ColumnSource> FindColumns(const std::vector<FileColumn>& columns,
                                      const ReadSettings& layout, const Place& place,
                                      const std::string& there) {
  // options that name no column of ours are mistakes, whatever the file holds
  CheckNames(layout.map, "--map", place);
  CheckNames(layout.unit, "--unit", place);
  CheckNames(layout.scale, "--scale", place);
  const Header header = HeaderOf(columns, layout, place);

  std::vector<ColumnSource> sources;
  std::vector<const RecordingColumn*> missing;
  for (const RecordingColumn& column : RecordingColumns()) {
    // a rate that is given makes the time
    if (column.name == kTime && layout.rate > 0) continue;
    const std::vector<std::size_t> found = Find(header, column);
    for (const std::size_t index : found) {
      const bool is_added = !sources.empty() && sources.back().column == &column;
      sources.push_back({.column = &column, .index = index, .is_added = is_added});
      TakeUnit(header, sources.back());
      if (column.name == kPosition) {
        sources.back().of_other_joints = OfOtherJoints(header.names[index], header.names);
      }
      const bool is_found = column.name == kTemperature && !layout.map.contains(column.name);
      if (is_found && header.names[index] != column.name) {
        sources.back().found_as = header.names[index];
      }
    }
    const auto unit = layout.unit.find(column.name);
    if (found.empty() && column.required) {
      missing.push_back(&column);
    } else if (found.empty() && unit != layout.unit.end()) {
      Refuse(place, "--unit {}={}: the file has no {}; drop it or --map it", column.name,
             unit->second, column.name);
    }
  }
  std::erase_if(missing, [&](const RecordingColumn* column) {
    return column->name == kPosition && DoWithout(header, *column, sources);
  });
  if (missing.empty()) return sources;
  std::vector<std::string> free;
  for (std::size_t i = 0; i < header.names.size(); ++i) {
    if (!header.given[i]) free.push_back(header.names[i]);
  }
  // a velocity under another name is worth naming, too, in the order of the columns
  const RecordingColumn& velocity =
      *std::ranges::find(RecordingColumns(), kVelocity, &RecordingColumn::name);
  const bool is_open =
      std::ranges::none_of(sources,
                           [&](const ColumnSource& one) { return one.column == &velocity; }) &&
      !layout.map.contains(kVelocity);
  if (is_open && LikelyName(velocity, free)) missing.push_back(&velocity);
  std::ranges::sort(missing);
  RefuseMissing(missing, header.names, free, place, there);
}

std::vector<WantedColumn> FindMappedColumns(const std::vector<FileColumn>& columns,
                                            const ReadSettings& layout, const Place& place) {
  const Header header = HeaderOf(columns, layout, place);
  std::vector<WantedColumn> found;
  for (const auto& [ours, theirs] : layout.map) {
    for (const std::size_t index : FindMapped(header, ours, theirs)) {
      found.push_back({index, ours == kTime});
    }
  }
  return found;
}

bool IsTableOfSpeeds(const std::vector<FileColumn>& columns, const ReadSettings& layout,
                     const Place& place) {
  if (layout.rate > 0) return false;
  const Header header = HeaderOf(columns, layout, place);
  // what there is, by name or by what looks like it
  bool has_speed = false, has_torque = false, has_more = false;
  for (const RecordingColumn& column : RecordingColumns()) {
    const bool is_there = !Find(header, column).empty();
    if (column.name == "velocity") has_speed = is_there;
    if (column.name == "torque") has_torque = is_there;
    if (column.name != "time" && column.name != kPosition) continue;
    has_more = has_more || is_there || layout.map.contains(column.name) ||
               LikelyName(column, header.names);
  }
  return has_speed && has_torque && !has_more;
}

}  // namespace warmjoint
