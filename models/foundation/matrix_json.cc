#include "models/foundation/matrix_json.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "models/foundation/excerpt.h"

namespace warmjoint::inline models {

using nlohmann::json;

json MatrixToJson(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (const auto& row : matrix.rowwise()) {
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

Eigen::MatrixXd SquareFromJson(const json& rows, std::size_t size, const std::string& name,
                               const Place& place) {
  if (!rows.is_array() || rows.size() != size) {
    Refuse(place, "{} must have {} rows, one for each of its parameters", name, size);
  }
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  for (std::size_t i = 0; i < size; ++i) {
    if (!rows[i].is_array() || rows[i].size() != size) {
      Refuse(place, "row {} of {} must hold {} numbers", i + 1, name, size);
    }
    // a number that is not known was written as null
    for (std::size_t j = 0; j < size; ++j) {
      const json& value = rows[i][j];
      if (!value.is_number() && !value.is_null()) {
        Refuse(place, "{} is {}; it must be a number", name, Excerpt(value.dump()));
      }
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
  }
  return matrix;
}

}  // namespace warmjoint::inline models
