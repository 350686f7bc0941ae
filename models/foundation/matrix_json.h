// Matrices as JSON: a list of rows.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline models {

/// [[...], ...], row by row; what is not finite becomes null in text.
nlohmann::json MatrixToJson(const Eigen::MatrixXd& matrix);

/// The inverse, of a square matrix with a row for each of `size` parameters; null is NaN. name: of the
/// key, for messages. Throws BadInput from `place` for another shape and for what is no number.
Eigen::MatrixXd SquareFromJson(const nlohmann::json& rows, std::size_t size,
                               const std::string& name, const Place& place);

}  // namespace warmjoint::inline models
