// Options of identifiers: `--set key=value`, checked against the identifier's own table.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline identification {

/// One option of an identifier.
struct OptionInfo {
  std::string name;
  std::string default_value;
  /// "text", "range", words separated by |, or "number" or "integer" and bounds: "number > 0 <= 1".
  std::string allowed;
  std::string meaning;
};

/// Values by name, defaults filled in.
class Options {
 public:
  /// Throws BadInput from `place` for an unknown name (with the nearest) or a value that is not
  /// allowed. Numbers must be finite.
  Options(const std::vector<OptionInfo>& table, const std::map<std::string, std::string>& given,
          const Place& place);

  /// The value of an option of the table; a name that the table lacks is a bug.
  const std::string& Text(std::string_view name) const;
  double Number(std::string_view name) const;
  int Integer(std::string_view name) const;
  /// "lower:upper", for example "-9:0"; lower <= upper.
  std::pair<double, double> Range(std::string_view name) const;

  /// What is not at its default, by name.
  const std::map<std::string, std::string>& changed() const { return changed_; }

 private:
  std::map<std::string, std::string, std::less<>> values_;
  std::map<std::string, std::string> changed_;
};

}  // namespace warmjoint::inline identification
