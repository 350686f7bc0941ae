#include "models/recording/recording_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/foundation/letter_case.h"
#include "models/foundation/nearest_name.h"

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
      const std::string lower = Lowercase(name);
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
  // for a shell, which must not split names
  std::string pairs = fmt::format("{}", fmt::join(remedy, ","));
  if (pairs.find_first_of(" ()[]&;|*'") != std::string::npos) pairs = "'" + pairs + "'";
  const auto lacks = [&](std::string_view name) {
    return std::ranges::find(missing, name, &RecordingColumn::name) != missing.end();
  };
  Refuse(place, "has no column {}; it has: {}. Name them: --map {}{}{}",
         fmt::join(lacking, " and no "), there.empty() ? ExcerptOfList(names) : there, pairs,
         lacks("time") ? ", or give --rate HZ where none is time" : "",
         lacks(kPosition) ? "; where only a velocity was logged, --map position=" : "");
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

/// Name and unit of a temperature; no unit where the name tells none. K may be anything, as F and C: the rest must speak of a temperature.
NameAndUnit SplitTemperature(const std::string& name) {
  NameAndUnit split = SplitUnit(name, {"degC"});
  const std::string stem = Lowercase(split.stem);
  const bool speaks = stem.find("temp") != std::string::npos || stem == "t" ||
                      stem.starts_with("t_") || stem.starts_with("t ");
  const std::string_view behind = std::string_view(name).substr(split.stem.size());
  const auto is_of_unit = [](unsigned char c) { return std::isalpha(c) || c >= 0x80; };
  if (split.unit && !speaks && std::ranges::count_if(behind, is_of_unit) == 1) split.unit.reset();
  return split;
}

/// Name and unit of a file's column that is one of ours.
NameAndUnit Split(const RecordingColumn& column, const std::string& name, JointKind joint) {
  return column.name == kTemperature ? SplitTemperature(name)
                                     : SplitUnit(name, column.Units(joint));
}

/// The one name for which `fits` holds; the number of names where there is none, or several.
template <typename Fits>
std::size_t OnlyOne(const std::vector<std::string>& names, Fits&& fits) {
  const auto found = std::ranges::find_if(names, fits);
  if (found == names.end() || std::find_if(found + 1, names.end(), fits) != names.end()) {
    return names.size();
  }
  return static_cast<std::size_t>(found - names.begin());
}

/// The unit of a column, and who says so: an option, the file beside the name, or the name.
void TakeUnit(const std::string& name, const ReadSettings& layout, const Place& place,
              ColumnSource& source) {
  const RecordingColumn& column = *source.column;
  const std::vector<std::string>& bases = column.Units(layout.joint);
  const auto given = layout.unit.find(column.name);
  const NameAndUnit any = SplitUnit(name);
  if (given != layout.unit.end()) {
    source.unit = FindUnit(given->second, bases, column.name, place);
    source.unit_from = UnitFrom::given;
  } else if (const auto unit = Split(column, name, layout.joint).unit) {
    source.unit = *unit;
    source.unit_from = UnitFrom::name;
  } else if (any.is_sure) {
    source.unit = FindUnit(any.unit->name, bases, column.name, place);
  }
  // a count is of no size by itself
  if (!source.unit.name.starts_with("counts") || layout.scale.contains(column.name)) return;
  Refuse(place, "{} in counts needs the {} of one: --scale {}=FACTOR", column.name, bases.front(),
         column.name);
}

/// Two columns whose sum is time: the index of each. time=secs+nsecs.
std::optional<std::pair<std::size_t, std::size_t>> FindSum(const std::string& theirs,
                                                           const std::vector<std::string>& names,
                                                           const Place& place) {
  for (std::size_t plus = 0; (plus = theirs.find('+', plus)) != std::string::npos; ++plus) {
    const std::size_t first = IndexOf(theirs.substr(0, plus), names, place);
    const std::size_t second = IndexOf(theirs.substr(plus + 1), names, place);
    if (first < names.size() && second < names.size()) return std::pair{first, second};
  }
  return std::nullopt;
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
      {"time",
       true,
       {"s"},
       {"s"},
       {"time", "stamp", "zeit", "duration", "x_value", "t"},
       Get<&M::time>,
       Set<&M::time>},
      {kPosition,
       true,
       {"rad"},
       {"m"},
       {"pos", "angle", "winkel", "q", "theta"},
       LoggedPosition,
       Set<&M::position>},
      {"velocity",
       false,
       {"rad/s"},
       {"m/s"},
       {"vel", "speed", "drehzahl", "geschwindigkeit", "qd", "dq"},
       Get<&M::velocity>,
       Set<&M::velocity>},
      {"torque",
       true,
       {"N.m", "A", "V", "%", "raw"},
       {"N", "A", "V", "%", "raw"},
       {"torque", "tau", "force", "effort", "moment", "current", "strom", "trq", "load", "i"},
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

std::size_t FindColumn(const RecordingColumn& column, const std::vector<std::string>& names,
                       const ReadSettings& layout, const Place& place) {
  // an empty name leaves an optional column out
  const auto mapped = layout.map.find(column.name);
  if (mapped != layout.map.end()) {
    return mapped->second.empty() ? names.size() : IndexOf(mapped->second, names, place);
  }
  const std::size_t ours = IndexOf(column.name, names, place);
  if (ours < names.size()) return ours;
  // our name in other letters or with a unit; a temperature by its unit alone
  const std::size_t alike = OnlyOne(names, [&](const std::string& name) {
    return Lowercase(Split(column, name, layout.joint).stem) == column.name;
  });
  if (alike < names.size() || column.name != kTemperature) return alike;
  return OnlyOne(names,
                 [](const std::string& name) { return SplitTemperature(name).unit.has_value(); });
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
    // a rate that is given makes the time
    if (column.name == "time" && layout.rate > 0) continue;
    const auto mapped = layout.map.find(column.name);
    const std::string theirs = mapped == layout.map.end() ? "" : mapped->second;
    std::size_t index = FindColumn(column, names, layout, place), added = names.size();
    const auto sum = column.name == "time" && index == names.size() ? FindSum(theirs, names, place)
                                                                    : std::nullopt;
    if (sum) std::tie(index, added) = *sum;

    if (index < names.size()) {
      const Unit usual = FindUnit(column.Units(layout.joint).front(), {}, column.name, place);
      sources.push_back({&column, index, usual});
      TakeUnit(names[index], layout, place, sources.back());
      const bool is_found = mapped == layout.map.end() && column.name == kTemperature;
      if (is_found && names[index] != column.name) sources.back().found_as = names[index];
    } else if (!theirs.empty()) {
      Refuse(place, "has no column '{}' (for {}){}", Excerpt(theirs), column.name,
             Suggestion(theirs, names));
    } else if (column.required) {
      missing.push_back(&column);
    } else if (const auto unit = layout.unit.find(column.name); unit != layout.unit.end()) {
      Refuse(place, "--unit {}={}: the file has no {}; drop it or --map it", column.name,
             unit->second, column.name);
    }
    // the unit of what is added stands in its name
    if (added < names.size()) {
      sources.push_back({&column, added, sources.back().unit});
      sources.back().is_added = true;
      const auto whole = MeantUnit(names[added], {"s"}), part = SplitUnit(names[added], {"s"}).unit;
      if (whole || part) sources.back().unit = whole ? *whole : *part;
      if (whole || part) sources.back().unit_from = UnitFrom::name;
    }
  }
  std::erase_if(missing, [&](const RecordingColumn* column) {
    return column->name == kPosition && DoWithout(*column, sources, names, layout);
  });
  if (!missing.empty()) RefuseMissing(missing, names, place, there);
  return sources;
}

}  // namespace warmjoint
