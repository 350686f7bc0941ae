// Covariance of values that have names.
#pragma once

#include <warmjoint/field.h>

#include <Eigen/Core>
#include <iterator>
#include <string>
#include <vector>

namespace warmjoint {

/// Covariance of some of an estimate's values.
struct ParameterCovariance {
  std::vector<std::string> parameters;  // [p] names
  Eigen::MatrixXd matrix;               // [p x p] in products of their units; NaN where not known

  template <class A>
  void Serialize(A* a) {
    a->Field("parameters", &parameters,
             {.meaning = "their names", .needed = "give a list of names"});
    a->Field("matrix", &matrix,
             {.meaning = "a row and a column for each, in products of their units",
              .needed = "give a row for each parameter"});
    a->Check(matrix.rows() == matrix.cols() && matrix.rows() == std::ssize(parameters), "matrix",
             "a matrix with a row and a column for each parameter");
  }
};

}  // namespace warmjoint
