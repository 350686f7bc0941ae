// Options of identifiers: `--set key=value`, checked against the identifier's own table.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// One option of an identifier.
struct OptionInfo {
  std::string name;
  std::string default_value;
  std::string allowed;  // "number", "integer", "range", or words separated by |
  std::string meaning;
};

/// Values by name, defaults filled in.
class Options {
 public:
  /// Throws BadInput for an unknown name (with the nearest) or a value that is not allowed.
  Options(const std::vector<OptionInfo>& table, const std::map<std::string, std::string>& given,
          const Place& place);

  const std::string& Text(std::string_view name) const;
  double Number(std::string_view name) const;
  int Integer(std::string_view name) const;
  /// "lower:upper", for example "-9:0".
  std::pair<double, double> Range(std::string_view name) const;

 private:
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace warmjoint
