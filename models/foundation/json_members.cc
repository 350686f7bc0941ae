#include "models/foundation/json_members.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"

namespace warmjoint::inline models {

using nlohmann::json;

void RefuseUnknownKeys(const json& object, std::string_view what,
                       const std::vector<std::string>& known, const Place& place) {
  if (!object.is_object())
    Refuse(place, "{} is {}; it must be an object", what, Excerpt(object.dump()));
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    Refuse(place, "{} has no key '{}'{}", what, Excerpt(key), Suggestion(key, known));
  }
}

double NumberFrom(const json& value, std::string_view what, const Place& place) {
  if (!value.is_number())
    Refuse(place, "{} is {}; it must be a number", what, Excerpt(value.dump()));
  return value.get<double>();
}

}  // namespace warmjoint::inline models
