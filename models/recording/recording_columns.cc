#include "models/recording/recording_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {
namespace {

using Values = Eigen::VectorXd;

constexpr const char* kTemperature = "temperature";
constexpr const char* kPosition = "position";

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

std::vector<std::string> OurNames() {
  std::vector<std::string> names;
  for (const RecordingColumn& column : RecordingColumns()) names.push_back(column.name);
  return names;
}

template <typename Columns>
void CheckNames(const Columns& given, std::string_view option, const Place& place) {
  // a column of ours on the left, theirs on the right
  const std::vector<std::string> known = OurNames();
  for (const auto& [ours, theirs] : given) {
    if (std::find(known.begin(), known.end(), ours) != known.end()) continue;
    Refuse(place, "{} {}={}: recordings have no column '{}'{}", option, Excerpt(ours),
           Excerpt(fmt::format("{}", theirs)), Excerpt(ours), Suggestion(ours, known));
  }
}

/// A name in the file that looks like `column`.
std::optional<std::string> LikelyName(const RecordingColumn& column,
                                      const std::vector<std::string>& names) {
  // hints from the likeliest on, of which the first that fits counts
  for (const std::string& hint : column.other_names) {
    for (const std::string& name : names) {
      std::string lower = name;
      std::transform(lower.begin(), lower.end(), lower.begin(),
                     [](unsigned char c) { return std::tolower(c); });
      const bool is_letter = hint.size() == 1;  // "t" fits t, t_s, t [s], but not torque
      const bool fits =
          is_letter ? lower.substr(0, 1) == hint && (lower.size() == 1 || !std::isalpha(lower[1]))
                    : lower.find(hint) != std::string::npos;
      if (fits) return Excerpt(name);
    }
  }
  return std::nullopt;
}

[[noreturn]] void RefuseMissing(const std::vector<const RecordingColumn*>& missing,
                                const std::vector<std::string>& names, const Place& place,
                                const std::string& there) {
  // what is lacking, and which names may be meant
  std::vector<std::string> lacking, remedy;
  for (const RecordingColumn* column : missing) {
    lacking.push_back(fmt::format("'{}'", column->name));
    remedy.push_back(column->name + "=" + LikelyName(*column, names).value_or("NAME"));
  }
  // a first row of numbers is no header
  if (std::any_of(names.begin(), names.end(), [](auto& name) { return ParseNumber(name); })) {
    Refuse(place,
           "has no column {}; its first row is '{}'. Where that is no header row, add one, for "
           "example time,position,velocity,torque",
           fmt::join(lacking, " and no "), Excerpt(fmt::format("{}", fmt::join(names, ","))));
  }
  const bool position =
      std::ranges::find(missing, kPosition, &RecordingColumn::name) != missing.end();
  Refuse(place, "has no column {}; it has: {}. Name them: --map {}{}",
         fmt::join(lacking, " and no "), there.empty() ? ExcerptOfList(names) : there,
         fmt::join(remedy, ","),
         position ? "; where only a velocity was logged, --map position=" : "");
}

/// Index of `theirs`, or the number of names where it is not there.
std::size_t IndexOf(const std::string& theirs, const std::vector<std::string>& names,
                    const Place& place) {
  const auto found = std::find(names.begin(), names.end(), theirs);
  if (found != names.end() && std::find(found + 1, names.end(), theirs) != names.end()) {
    Refuse(place, "has column '{}' twice; rename one", Excerpt(theirs));
  }
  return static_cast<std::size_t>(found - names.begin());
}

/// The unit that a column's name ends in where that is one of temperature: "degC" of motor_degC and of
/// "case [degC]", "K" of temp_K, not of gain_K; nothing of other names.
std::optional<std::string> TemperatureUnitIn(const std::string& name) {
  // brackets and blanks behind a unit are no part of it
  constexpr std::string_view separators = "_ [(/.-";
  std::string_view text = name;
  while (!text.empty() && std::string_view("]) ").find(text.back()) != std::string_view::npos) {
    text.remove_suffix(1);
  }

  // the unit must stand by itself, behind a separator
  for (const Unit& unit : Units()) {
    if (unit.base != "degC" || !text.ends_with(unit.name)) continue;
    const std::string_view before = text.substr(0, text.size() - unit.name.size());
    if (before.empty() || separators.find(before.back()) == std::string_view::npos) continue;
    // K may be anything: the rest must speak of a temperature
    std::string lower(before);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    const bool speaks = lower.find("temp") != std::string::npos || lower.substr(0, 2) == "t_" ||
                        lower.substr(0, 2) == "t ";
    if (unit.name != "K" || speaks) return std::string(unit.name);
  }
  return std::nullopt;
}

/// The one column whose name ends in a unit of temperature; nothing where there is none, or several.
std::optional<std::size_t> FindTemperature(const std::vector<std::string>& names) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!TemperatureUnitIn(names[i])) continue;
    // of two candidates neither is taken
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

/// Whether a log does without positions: its velocity tells them, and no other column may be meant, or none is wanted.
bool DoWithout(const RecordingColumn& position, const std::vector<ColumnSource>& sources,
               const std::vector<std::string>& names, const ReadSettings& layout) {
  std::vector<std::string> others = names;
  bool has_velocity = false;
  for (const ColumnSource& source : sources) {
    others[source.index].clear();
    has_velocity = has_velocity || source.column->name == "velocity";
  }
  return has_velocity && !layout.unit.contains(position.name) &&
         (layout.map.contains(position.name) || !LikelyName(position, others));
}

}  // namespace

const std::vector<RecordingColumn>& RecordingColumns() {
  // name, whether it is needed, units of rotary and linear joints, other names, and where it lies
  using M = Measurements;
  static const std::vector<RecordingColumn> columns{
      {"time", true, {"s"}, {"s"}, {"time", "stamp", "t"}, Get<&M::time>, Set<&M::time>},
      {kPosition,
       true,
       {"rad"},
       {"m"},
       {"pos", "angle", "q", "theta"},
       LoggedPosition,
       Set<&M::position>},
      {"velocity",
       false,
       {"rad/s"},
       {"m/s"},
       {"vel", "speed", "qd", "dq"},
       Get<&M::velocity>,
       Set<&M::velocity>},
      {"torque",
       true,
       {"N.m", "A", "V", "%", "raw"},
       {"N", "A", "V", "%", "raw"},
       {"torque", "tau", "force", "effort", "current", "trq", "load", "i"},
       Get<&M::torque>,
       Set<&M::torque>},
      {"motor_position",
       false,
       {"rad"},
       {"rad"},
       {"motor"},
       Get<&M::motor_position>,
       Set<&M::motor_position>},
      {"load", false, {"N.m"}, {"N"}, {"load"}, Get<&M::load>, Set<&M::load>},
      {kTemperature,
       false,
       {"degC"},
       {"degC"},
       {"temp"},
       Get<&M::temperature>,
       Set<&M::temperature>},
  };
  return columns;
}

std::string UnitOf(const RecordingColumn& column, const Measurements& measurements) {
  if (column.name == "torque") return measurements.torque_unit;
  return column.Units(measurements.joint).front();
}

std::vector<ColumnSource> FindColumns(const std::vector<std::string>& names,
                                      const ReadSettings& layout, const Place& place,
                                      const std::string& there) {
  // options that name no column of ours are mistakes, whatever the file holds
  CheckNames(layout.map, "--map", place);
  CheckNames(layout.unit, "--unit", place);
  CheckNames(layout.scale, "--scale", place);

  std::vector<ColumnSource> sources;
  std::vector<const RecordingColumn*> missing;
  for (const RecordingColumn& column : RecordingColumns()) {
    // an empty name leaves an optional column out
    const auto mapped = layout.map.find(column.name);
    const bool is_mapped = mapped != layout.map.end();
    const std::string theirs = is_mapped ? mapped->second : column.name;
    std::size_t index = theirs.empty() ? names.size() : IndexOf(theirs, names, place);
    const bool is_temperature = column.name == kTemperature;
    if (is_temperature && !is_mapped && index == names.size()) {
      index = FindTemperature(names).value_or(index);
    }
    const auto unit = layout.unit.find(column.name);

    // there: in the unit that is given, that its name tells, or that is usual
    if (index < names.size()) {
      const std::vector<std::string>& bases = column.Units(layout.joint);
      const std::string usual =
          (is_temperature ? TemperatureUnitIn(names[index]) : std::nullopt).value_or(bases.front());
      const std::string& name = unit == layout.unit.end() ? usual : unit->second;
      sources.push_back({&column, index, FindUnit(name, bases, column.name, place)});
      if (!is_mapped && names[index] != column.name) sources.back().found_as = names[index];
    } else if (is_mapped && !theirs.empty()) {
      Refuse(place, "has no column '{}' (for {}){}", Excerpt(theirs), column.name,
             Suggestion(theirs, names));
    } else if (column.required) {
      missing.push_back(&column);
    } else if (unit != layout.unit.end()) {
      Refuse(place, "--unit {}={}: the file has no {}; drop it or --map it", column.name,
             unit->second, column.name);
    }
  }
  std::erase_if(missing, [&](const RecordingColumn* column) {
    return column->name == kPosition && DoWithout(*column, sources, names, layout);
  });
  if (!missing.empty()) RefuseMissing(missing, names, place, there);
  return sources;
}

}  // namespace warmjoint
