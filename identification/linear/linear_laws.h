// Laws as columns of a linear regression, Eqs. (7)-(9).
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <string>

namespace warmjoint::inline identification {

/// Whether Fn(v; p) is linear in p and depends on all of p, judged by superposition at several
/// speeds and values.
bool IsLinear(const Law& law);

/// Names of the laws that are linear in their parameters, separated by |, as an option's words.
std::string LinearLawWords();

/// Regressor A of Fn = A p, one column for each parameter: [v, sign v] for Eq. (2).
/// velocity: [N] rad/s or m/s; returns [N x d]. The law must be linear.
Eigen::MatrixXd LawColumns(const Law& law, const Eigen::VectorXd& velocity);

/// The same at the loss velocity of a log, which makes the losses of ClosedLoop::Along; empty where it
/// tells none.
Eigen::MatrixXd LossColumns(const Law& law, const Measurements& measurements);

}  // namespace warmjoint::inline identification
