#include "identification/options.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/foundation/parse_number.h"

namespace warmjoint {

void ReadValue(const Node& node, OptionRange* value, const FieldInfo&) {
  const std::string text = node.Text();
  const size_t colon = text.find(':');
  std::optional<double> lower, upper;
  if (colon != std::string::npos) {
    lower = ParseFinite(std::string_view(text).substr(0, colon));
    upper = ParseFinite(std::string_view(text).substr(colon + 1));
  }
  if (!lower || !upper || *lower > *upper) {
    node.RefuseValue("two numbers lower:upper, the first not above the second, as -9:0");
  }
  *value = {*lower, *upper};
}

Tree WriteValue(const OptionRange& value) { return fmt::format("{}:{}", value.lower, value.upper); }

std::string OptionLister::TextOf(const Tree& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

std::string OptionLister::KindWithin(std::string kind, const Bounds& bounds) {
  const auto add = [&](const char* relation, double bound) {
    if (std::isfinite(bound)) kind += fmt::format(" {} {}", relation, bound);
  };
  add(">", bounds.above);
  add(">=", bounds.at_least);
  add("<", bounds.below);
  add("<=", bounds.at_most);
  return kind;
}

bool Options::Has(std::string_view name) const {
  return std::ranges::any_of(List(), [&](const OptionInfo& one) { return one.name == name; });
}

Options Options::Read(const std::map<std::string, std::string>& given, const Place& place) const {
  Options options = *this;
  const std::shared_ptr<Held> read = held_->Copy();
  read->Read(NodeOf(given, place));
  options.held_ = read;
  return options;
}

std::map<std::string, std::string> Options::Changed() const {
  std::map<std::string, std::string> changed;
  const std::vector<OptionInfo> rows = List(), defaults = held_->Defaults();
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].value != defaults[i].value) changed[rows[i].name] = rows[i].value;
  }
  return changed;
}

Node NodeOf(const std::map<std::string, std::string>& given, const Place& place) {
  return {Tree(given), place.file, {{"", place}}, Scalars::texts};
}

}  // namespace warmjoint
