// The model that an estimate holds, over the recording that it was fitted to.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "identification/identifier.h"

namespace warmjoint::inline identification {

struct FittedModel {
  Selection selection;             // samples that took part
  Eigen::VectorXd torque;          // [N] tau less gravity, N.m or N
  Eigen::VectorXd residual;        // [N] that less F, N.m or N
  Eigen::MatrixXd derivatives;     // [N x (p + J)] dF/dx at the estimate; dF/db of the jumps b that
                                   // E makes at the gaps of the log (gaps.h)
  std::vector<std::string> names;  // [p] of x: the law's parameters, then the estimated ones of
                                   // thermal_gain, thermal_time_constant, initial_energy,
                                   // and those of gravity
  std::optional<Eigen::VectorXd> by_initial_energy;  // [N] dF/dE(0), where it is taken to be known
  Eigen::VectorXd energy;                            // [N] E, N.m or N
  Eigen::VectorXd jump_spread;                       // [J] how far E may jump at the gaps, N.m or N
  std::optional<Eigen::VectorXd> held_loss;  // [N] what (22) leaves out (held_loss.h), N.m or N,
                                             // where that matters
  std::optional<Eigen::VectorXd> maps;       // [N] what they give, N.m or N, where there are any

  /// Whether the warming was estimated.
  bool KnowsWarming() const;
};

/// Nothing where the estimate does not hold a whole model.
std::optional<FittedModel> EvaluateModel(const Identifier& identifier, const IdentifierInput& input,
                                         const Estimate& estimate);

/// Whether an identifier's table of options has a row of that name.
bool HasOption(const Identifier& identifier, std::string_view name);

}  // namespace warmjoint::inline identification
