#include "models/robot_log/robot_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

#include "models/foundation/excerpt.h"
#include "models/recording/time_names.h"
#include "models/robot_log/column_pattern.h"

namespace warmjoint {
namespace {

using Words = std::vector<std::string>;

// words of column names, the likeliest first
const Words kPositions{"q", "pos", "position", "positions", "angle", "theta", "winkel"};
const Words kTorques{"torque", "tau",        "trq",   "effort", "eff",     "moment",
                     "force",  "drehmoment", "mom",   "load",   "current", "currents",
                     "iq",     "cur",        "strom", "i"};
const Words kCurrents{"current", "currents", "iq", "cur", "strom", "i"};
/// What a controller asked for, which no friction of the joint is in but that of its own model.
const Words kAskedFor{"target",  "desired",   "des",  "ref",      "reference", "cmd",
                      "command", "commanded", "goal", "setpoint", "soll"};
/// Of another place, or what is made of both.
const Words kElsewhere{"control", "external", "ext", "limit",    "max",
                       "min",     "error",    "err", "friction", "gravity"};
const Words kTimes{"time", "timestamp", "t", "stamp", "zeit"};

bool Holds(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The words of a name in lower case: of letters that stand together.
Words WordsIn(const std::string& name) {
  Words words;
  bool inside = false;
  for (const char c : name) {
    const bool letter = IsLetter(c);
    if (letter && !inside) words.emplace_back();
    if (letter) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    inside = letter;
  }
  return words;
}

/// Columns whose names differ in what tells the joint alone.
struct Family {
  std::string key;        // with {} in its place
  Words columns;          // one for each joint, in their order
  Words joints;           // whose they are; empty: by number, from the base outwards
  std::size_t first = 0;  // of the numbers
};

/// The joints' names without a word "joint" at their end or front, which descriptions have and loggers leave out; as they are where that
/// leaves no letter, or the name of another.
Words ShortNames(const Words& joints) {
  Words found;
  for (const std::string& joint : joints) {
    std::string name = joint;
    for (const char stroke : {'_', '-', '.', '/', ' '}) {
      const std::string end = std::string(1, stroke) + "joint",
                        front = std::string("joint") + stroke;
      if (name.ends_with(end)) name.resize(name.size() - end.size());
      if (name.starts_with(front)) name.erase(0, front.size());
    }
    found.push_back(std::ranges::any_of(name, IsLetter) ? name : joint);
  }
  const Words all = found;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool is_other =
        std::ranges::count(joints, all[j]) > 0 || std::ranges::count(all, all[j]) > 1;
    if (is_other) found[j] = joints[j];
  }
  return found;
}

/// Where a column's name holds a joint's; npos where it does not, or as a part of another number ("joint1" in "joint10").
std::size_t PlaceOfName(const std::string& joint, const std::string& column) {
  const std::size_t at = column.find(joint), end = at + joint.size();
  if (at == std::string::npos) return at;
  return end < column.size() && IsDigit(column[end]) ? std::string::npos : at;
}

/// The same of a word or several by themselves ("lift" is not in "forklift").
std::size_t PlaceOfWords(const std::string& joint, const std::string& column) {
  const auto inside = [&](std::size_t i) {
    return i < column.size() && (IsLetter(column[i]) || IsDigit(column[i]));
  };
  std::size_t at = column.find(joint);
  while (at != std::string::npos && ((at > 0 && inside(at - 1)) || inside(at + joint.size()))) {
    at = column.find(joint, at + 1);
  }
  return at;
}

/// By the joints' names, in columns that hold none by their short ones.
std::vector<Family> NamedFamilies(const Words& names, const Words& joints) {
  std::map<std::string, std::map<std::size_t, std::string>> found;
  const auto take = [&](const std::string& column, const Words& spoken, auto&& place) {
    bool holds_one = false;
    for (std::size_t j = 0; j < spoken.size(); ++j) {
      const std::size_t at = place(spoken[j], column);
      if (at == std::string::npos) continue;
      found[column.substr(0, at) + "{}" + column.substr(at + spoken[j].size())][j] = column;
      holds_one = true;
    }
    return holds_one;
  };
  const Words shorts = ShortNames(joints);
  for (const std::string& column : names) {
    if (!take(column, joints, PlaceOfName)) take(column, shorts, PlaceOfWords);
  }
  std::vector<Family> families;
  for (const auto& [key, members] : found) {
    Family family{key, {}, {}, 0};
    for (const auto& [joint, name] : members) {
      family.columns.push_back(name);
      family.joints.push_back(joints[joint]);
    }
    families.push_back(std::move(family));
  }
  return families;
}

/// By numbers, from 0 or from 1 on without a gap.
std::vector<Family> NumberedFamilies(const Words& names) {
  std::map<std::string, std::map<std::size_t, std::string>> found;
  for (const std::string& name : names) {
    for (std::size_t at = 0; at < name.size(); ++at) {
      if (!IsDigit(name[at])) continue;
      std::size_t end = at;
      while (end < name.size() && IsDigit(name[end])) ++end;
      if (end - at <= 2) {
        const std::size_t number = std::stoul(name.substr(at, end - at));
        found[name.substr(0, at) + "{}" + name.substr(end)][number] = name;
      }
      at = end;
    }
  }
  std::vector<Family> families;
  for (const auto& [key, members] : found) {
    const std::size_t first = members.begin()->first;
    if (first > 1) continue;
    Family family{key, {}, {}, first};
    for (const auto& [number, name] : members) {
      if (number != first + family.columns.size()) break;
      family.columns.push_back(name);
    }
    if (family.columns.size() > 1) families.push_back(std::move(family));
  }
  return families;
}

/// How well a family's words fit: the place of the first that does, then how many there are besides.
std::optional<std::pair<std::size_t, std::size_t>> FitOf(const Family& family,
                                                         const Words& wanted) {
  const Words words = WordsIn(family.key);
  std::optional<std::size_t> best;
  for (const std::string& word : words) {
    if (Holds(kAskedFor, word) || Holds(kElsewhere, word)) return std::nullopt;
    const auto at = std::ranges::find(wanted, word);
    if (at == wanted.end()) continue;
    const auto place = static_cast<std::size_t>(at - wanted.begin());
    best = std::min(best.value_or(place), place);
  }
  if (!best) return std::nullopt;
  return std::pair(*best, words.size());
}

/// The pattern of --map that names a family.
std::string PatternOf(const Family& family) {
  std::string pattern = family.key;
  const std::string inside =
      family.joints.empty()
          ? fmt::format("{{{}..{}}}", family.first, family.first + family.columns.size() - 1)
          : "{name}";
  return pattern.replace(pattern.find("{}"), 2, inside);
}

/// The best of the families that speak of `what`.
Family Choose(const std::vector<Family>& families, const Words& wanted, const char* what,
              const Words& names, const Place& place) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const Family*>> ranked;
  for (const Family& family : families) {
    if (const auto fit = FitOf(family, wanted)) ranked[*fit].push_back(&family);
  }
  if (ranked.empty()) {
    Refuse(place,
           "has no columns of the joints' {}s that can be told by their names; it has: {}. Name "
           "them: --map '{}=NAME_{{j}}', {{j}} from 0 on",
           what, ExcerptOfList(names), what);
  }
  const std::vector<const Family*>& best = ranked.begin()->second;
  if (best.size() > 1) {
    Refuse(place,
           "has several columns that may be the joints' {}s: {} and {}. Choose: --map '{}={}'{}",
           what, best[0]->columns[0], best[1]->columns[0], what, PatternOf(*best[0]),
           best[0]->joints.empty() ? fmt::format(", and --joints with the names of their {} joints",
                                                 best[0]->columns.size())
                                   : "");
  }
  return *best.front();
}

/// The columns that a pattern names: by the joints' short names where the file has these columns, and none by their own.
Family Mapped(const std::string& pattern, const Words& joints, const Words& names) {
  const auto columns = [&](const Words& spoken) {
    Words found;
    for (std::size_t j = 0; j < spoken.size(); ++j) {
      found.push_back(ColumnOfJoint(pattern, spoken, j));
    }
    return found;
  };
  const auto is_there = [&](const std::string& column) { return Holds(names, column); };
  const Words own = columns(joints), shorter = columns(ShortNames(joints));
  const bool by_short =
      std::ranges::none_of(own, is_there) && std::ranges::all_of(shorter, is_there);
  return {pattern, by_short ? shorter : own, joints, 0};
}

/// Which joints both families are of, with a notice where that was taken to be so.
void Join(const Family& position, const Family& torque, const Words& joints, RobotColumns& found) {
  const auto column = [&](const Family& family, const std::string& joint) -> std::string {
    const Words& order = family.joints.empty() ? joints : family.joints;
    const auto at = static_cast<std::size_t>(std::ranges::find(order, joint) - order.begin());
    return at < order.size() && at < family.columns.size() ? family.columns[at] : "";
  };
  for (const std::string& joint : joints) {
    const std::string q = column(position, joint), y = column(torque, joint);
    if (q.empty() || y.empty()) continue;
    found.joints.push_back(joint);
    ColumnTexts map;
    map["position"] = q;
    map["torque"] = y;
    found.maps.push_back(std::move(map));
  }
  if (!position.joints.empty() && !torque.joints.empty()) return;
  const std::size_t numbered = std::min(position.columns.size(), torque.columns.size());
  if (numbered == joints.size()) return;
  found.notices.push_back(
      fmt::format("the log numbers {} joints and the robot has {}: taken as {}, from the base "
                  "outwards (--joints names others)",
                  numbered, joints.size(), fmt::join(found.joints, ", ")));
}

/// The column of the time as --map names it, or the sum of two; nothing where its name does not tell it.
std::optional<std::string> NameOfTime(const Words& names) {
  const std::vector<std::size_t> found = FindTime(names, kTimes);
  if (found.empty()) return std::nullopt;
  return found.size() == 1 ? names[found[0]] : names[found[0]] + "+" + names[found[1]];
}

}  // namespace

RobotColumns FindRobotColumns(const Words& names, const Words& joints, const ColumnTexts& map,
                              const Place& place) {
  std::vector<Family> families = NamedFamilies(names, joints);
  std::ranges::move(NumberedFamilies(names), std::back_inserter(families));
  const auto find = [&](const char* what, const Words& wanted) {
    const auto said = map.find(what);
    if (said != map.end()) return Mapped(said->second, joints, names);
    return Choose(families, wanted, what, names, place);
  };
  const Family position = find("position", kPositions), torque = find("torque", kTorques);

  RobotColumns found;
  const Words words = WordsIn(torque.key);
  found.torque_is_current =
      std::ranges::any_of(words, [](const std::string& word) { return Holds(kCurrents, word); });
  Join(position, torque, joints, found);
  const auto asked =
      std::ranges::find_if(words, [](const std::string& word) { return Holds(kAskedFor, word); });
  if (asked != words.end()) {
    found.notices.push_back(fmt::format(
        "'{}' is a commanded torque by its word '{}': its friction is that which the controller "
        "assumes, and what it corrects; a measured torque or current tells the joint's",
        torque.columns.front(), *asked));
  }
  const auto said = map.find("time");
  const auto time = said != map.end() ? std::optional(said->second) : NameOfTime(names);
  for (ColumnTexts& one : found.maps) {
    if (time) one["time"] = *time;
    // nothing else counts
    for (const char* other : {"velocity", "motor_position", "load", "temperature"}) one[other] = "";
  }
  if (found.joints.empty()) {
    Refuse(place, "positions {} and torques {} are of different joints", position.key, torque.key);
  }
  return found;
}

}  // namespace warmjoint
