#include "models/recording/read_settings.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline models {
namespace {

/// Calls take(column, node of the value, its text) for each entry.
template <typename Take>
void ForEachEntry(const Node& node, const Take& take) {
  if (!node.IsList()) {
    for (const std::string& column : node.Keys()) {
      const auto entry = node.Find(column);
      take(column, entry.value_or(node), entry ? entry->ScalarText() : "");
    }
    return;
  }
  for (const Node& entry : node.Entries("a list of column=value")) {
    const std::string pair = entry.Text();
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string::npos) entry.RefuseValue("column=value");
    take(pair.substr(0, equals), entry, pair.substr(equals + 1));
  }
}

}  // namespace

void ReadValue(const Node& node, ColumnTexts* value, const FieldInfo&) {
  ForEachEntry(node, [&](const std::string& column, const Node&, const std::string& text) {
    (*value)[column] = text;
  });
}

Tree WriteValue(const ColumnTexts& value) {
  Tree list = Tree::array();
  for (const auto& [column, text] : value) list.push_back(column + "=" + text);
  return list;
}

void ReadValue(const Node& node, ColumnNumbers* value, const FieldInfo&) {
  ForEachEntry(node, [&](const std::string& column, const Node& entry, const std::string& text) {
    const std::optional<double> number = ParseFinite(text);
    if (!number) entry.RefuseValue("a finite number");
    (*value)[column] = *number;
  });
}

Tree WriteValue(const ColumnNumbers& value) {
  Tree list = Tree::array();
  for (const auto& [column, number] : value) list.push_back(fmt::format("{}={}", column, number));
  return list;
}

void CheckReadSettings(const ReadSettings& settings) {
  for (const auto& [column, factor] : settings.scale) {
    if (std::isfinite(factor) && factor != 0) continue;
    Refuse({"--scale"}, "{}={}: the factor must be a finite number other than 0", Excerpt(column),
           factor);
  }
  if (!std::isfinite(settings.gear) || settings.gear == 0) {
    Refuse({"--gear"}, "is {}; it must be a finite number other than 0", settings.gear);
  }
  if (!std::isfinite(settings.wrap) || settings.wrap < 0) {
    Refuse({"--wrap"}, "is {}; it must be a finite number above 0", settings.wrap);
  }
  if (!std::isfinite(settings.torque_constant)) {
    Refuse({"--torque-constant"}, "is {}; it must be a finite number, N.m/A or N/A at the joint",
           settings.torque_constant);
  }
}

}  // namespace warmjoint::inline models
