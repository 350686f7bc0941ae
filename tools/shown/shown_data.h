// What C++ hands to the Python that draws: facts as JSON, and columns of numbers beside them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/foundation/serialize.h"

namespace warmjoint::shown {

/// Facts in which {"array": i, "shape": [..]} stands for arrays[i]. A matrix lies row after row.
struct ShownData {
  Tree facts = Tree::object();
  std::vector<Eigen::VectorXd> arrays{};

  /// Takes an array in; returns what stands for it in the facts.
  Tree Hold(Eigen::VectorXd array);
  Tree Hold(const Eigen::MatrixXd& matrix);
};

/// A line of JSON, {facts, sizes[]}, and behind it the arrays as float64 of this machine, one after the other.
std::string Packed(const ShownData& data);

}  // namespace warmjoint::shown
