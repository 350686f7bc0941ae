// The result of an identifier: the fitted model as a value, with all that later steps read.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/fields.h>
#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/table.h"
#include "identification/uncertainty/uncertainty.h"
#include "identification/uncertainty/whitening.h"

namespace warmjoint {

class IdentifierInput;

/// How the errors of x follow from the noise: C J^T R J C (uncertainty.h), with the changes by the
/// method of the fit.
struct ErrorModel {
  Eigen::MatrixXd cofactor;  // [p x p] C, the inverse of what the fit solved
  Eigen::MatrixXd prior;     // [p x p] what is known beforehand (uncertainty.h); or empty
  Eigen::VectorXd scores;    // [n] in place of the residual, of a robust loss or a lag; or empty
  Eigen::VectorXd weights;   // [n] of the samples in the fit; or empty: 1
  /// The whitening of the rows that the fit solved, of which C is; or none.
  std::shared_ptr<const Whitening> whitening;
  /// Covariance of the table's estimated rows, of a fit whose errors follow from more than its table; or not set.
  std::function<Uncertainty()> covariance;

  /// One more estimated value, of which nothing is known beforehand.
  void AddFree();
};

/// The state of a fit after an iteration.
struct Iterate {
  int iteration = 0;
  std::vector<double> values;  // of the table's first rows, in its order; NaN where not known
  double rmse = 0;             // over the kept samples, N.m or N
  /// E at this moment, N.m or N, of a filter whose iterations are the samples that it has seen.
  std::optional<double> energy{};
};

/// The torque of a joint: F + G + M a, Eqs. (5) and (20).
struct TorqueModel {
  Friction friction;  // law, warming and maps, whatever their bounds
  std::optional<GravityModel> gravity;
  std::optional<double> inertia;  // torque over acceleration, kg.m^2 or kg
  std::optional<double> lag{};    // s, of the torque's way into the log, first order
  /// s, by which the torque is late relative to the motion: the model follows the motion at t less that (Delayed).
  std::optional<double> delay{};
};

/// With what a log began.
struct FittedStart {
  double energy = 0;  // E(0), N.m or N
  /// Friction with which each recording begins, [R] N.m or N, where it bends a bristle and was
  /// estimated; else empty.
  std::vector<double> friction;
  std::vector<Eigen::Index> jump_samples;  // [J] where E jumps by a parameter with Role::jump
};

/// What fields of a fit hold beside its law and its maps (fields/fit_fields.h).
struct FittedFields {
  FieldSet present{};
  /// [P] derivatives of each friction at speeds by the table's rows
  std::vector<Eigen::VectorXd> at_speeds_by_rows{};
  /// Of each friction at speeds, its deviations up to each part of its error, N.m or N
  std::vector<std::vector<ErrorUpTo<double>>> at_speeds_up_to{};
  /// -2 log of the marginal likelihood, of the same rows and fields with any table: the least is the likeliest
  double cost = 0;
  double time_torque = 0;    // amplitude of the torque over time, a share of the friction
  double time_friction = 0;  // the same of the friction: rms over time about its mean
};

/// Why a fit is refused.
struct Refusal {
  Status status = Status::not_identifiable;
  std::string message;
  /// The kind of friction for which a fit did not converge: the report adds what the log lacks to show it.
  std::optional<FrictionKind> unconverged{};
};

/// E at the last sample of a log that has one stage of heat.
struct EndEnergy {
  double value = 0;  // N.m or N
  /// [m <= p] dE/dx by the first m estimated rows, on which alone it depends; exact
  Eigen::VectorXd slopes;
};

/// What a fit was made to, and how well it fits.
struct FitRows {
  Selection used;
  Eigen::VectorXd torque;  // [n] measured, N.m or N
  Eigen::VectorXd fitted;  // [n] F + G + M a, after the lag where there is one, N.m or N
  /// d(F + G + M a)/dx over all samples, [N x p], exact; of a fit whose errors.covariance is not set.
  std::function<Eigen::MatrixXd()> jacobian;
  ErrorModel errors;
  Eigen::MatrixXd gravity;  // [m x q] values of the gravity by the table's rows of it
  /// [N] what the fit has along this log alone, in addition to the torque of its model, N.m or N: what a lag adds at the kept
  /// samples, drifts of fields, M a by an acceleration of its own; or empty.
  Eigen::VectorXd rest;
  int count = 0;                    // of parameters, kernels included
  double effective_parameters = 0;  // trace of the hat matrix
  std::optional<double> loss_bend;  // from which residual on a robust loss is linear, N.m or N

  /// Over the kept samples. [n] N.m or N
  Eigen::VectorXd residual() const { return torque - fitted; }
};

/// What a fit says of the friction in addition to its table and model.
struct FitFigures {
  std::optional<FittedFields> fields{};
  std::vector<MapBand> bands;  // one for each of the friction's maps
  /// Of each band, the derivatives of its values by the law's parameters, [g x d].
  std::vector<Eigen::MatrixXd> bands_by_law;
  /// The friction of law and maps at speeds, with intervals by noise; without maps it follows from the law's parameters.
  std::vector<FrictionAtSpeed> friction_at_speeds;
  /// Standard error of E at the end of the log, N.m or N, of a fit whose table lacks something that
  /// E depends on, such as the weights of maps; else not set, since it follows from the table.
  std::optional<double> end_energy_std;
  /// E at the end of the log by the fit's own recursion; or not set, so that the report computes it along the motion.
  std::function<EndEnergy()> end_energy;
};

/// A fit of the model F + G + M a to the samples that `rows.used` keeps.
struct Fit {
  std::string identifier;
  std::optional<Refusal> refusal;  // then nothing else is known but the trace
  std::string summary;             // summary of the fit: a clause that begins the message
  /// Remarks on the fit, and causes that invalidate its numbers or leave them without intervals.
  std::vector<Cause> causes;
  TorqueModel model;
  FittedStart start;
  std::vector<Unknown> parameters;  // [P]; those estimated come in the order of x
  FitRows rows;
  FitFigures figures;
  std::vector<Iterate> trace;
  std::optional<StructureChoice> choice;  // of an identifier that chooses
  /// The same structure, fitted to other samples: of an identifier that chooses one; else not set.
  std::function<Fit(const IdentifierInput&)> structure;

  /// The heat that the log began with: E(0), and the jumps of E.
  ThermalStart Start() const;
  /// The table's row of the which-th parameter with a role; nothing where there are fewer.
  std::optional<size_t> RowOf(Role role, int which = 0) const;
  /// Values of the parameters with a role, in the order of the table.
  std::vector<double> Values(Role role) const;
};

/// (J^T J + P)^-1 of a fit's Jacobian J at the samples that it used, whitened where the fit was, and its prior P. [p x p]
Eigen::MatrixXd CofactorOf(const Fit& fit);

/// A refused fit: its status and one sentence.
Fit Refused(std::string identifier, Refusal refusal);
Fit Refused(std::string identifier, Status status, std::string message);

}  // namespace warmjoint
