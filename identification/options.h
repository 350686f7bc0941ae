// Options of identifiers, `--set key=value`, as values.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warmjoint::inline identification {

/// One option of an identifier.
struct OptionInfo {
  std::string name;
  std::string default_value;
  /// "text", "range", words separated by |, or "number" or "integer" and bounds: "number > 0 <= 1".
  std::string allowed;
  std::string meaning;
};

/// "lower:upper" with lower <= upper, both finite; nothing where the text is no such range.
std::optional<std::pair<double, double>> ParseRange(std::string_view text);

/// Values by name, defaults filled in: made by ReadOptions (read_options.h).
class Options {
 public:
  using Values = std::map<std::string, std::string, std::less<>>;

  /// values: of each option of a table, as its row allows; changed: those that are not at their default.
  Options(Values values, std::map<std::string, std::string> changed)
      : values_(std::move(values)), changed_(std::move(changed)) {}

  /// The value of an option of the table; a name that the table lacks is a bug.
  const std::string& Text(std::string_view name) const;
  double Number(std::string_view name) const;
  int Integer(std::string_view name) const;
  /// "lower:upper", for example "-9:0"; lower <= upper.
  std::pair<double, double> Range(std::string_view name) const;

  /// The same with a number, within its bounds, for an option that was left at its default.
  Options With(std::string_view name, double number) const;

  /// What is not at its default, by name.
  const std::map<std::string, std::string>& changed() const { return changed_; }

 private:
  Values values_;
  std::map<std::string, double, std::less<>> numbers_;  // that With gave
  std::map<std::string, std::string> changed_;
};

}  // namespace warmjoint::inline identification
