#include "identification/warming/load.h"

#include <cmath>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/law.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kMostRounds = 40;
constexpr double kArrived = 0.02;  // of the deviation that noise leaves the mean

/// By how much the torque of a fit changes under another load, over the standard error of its mean: rms of the kept samples.
double ChangeOf(const Fit& fit, const VectorXd& load, const VectorXd& before) {
  const VectorXd change =
      fit.model.friction.load_gain * Kept(load.cwiseAbs() - before.cwiseAbs(), fit.rows.used);
  const double noise = fit.rows.residual().squaredNorm() / static_cast<double>(change.size());
  return noise > 0 ? std::sqrt(change.squaredNorm() / noise)
                   : change.norm() / fit.rows.torque.norm();
}

/// The columns of gravity act through the friction, too.
void AddLoadOfGravity(const VectorXd& load, const LogSamples& m, Fit& fit) {
  std::vector<Index> columns;
  Index column = 0;
  for (const Unknown& row : fit.parameters) {
    if (!row.estimated) continue;
    if (row.role == Role::gravity) columns.push_back(column);
    ++column;
  }
  const VectorXd by_load =
      VectorXd::Ones(m.size()) +
      fit.model.friction.load_gain * load.cwiseSign().cwiseProduct(m.velocity.cwiseSign());
  fit.rows.jacobian = [of_model = std::move(fit.rows.jacobian), columns, by_load] {
    Eigen::MatrixXd rows = of_model();
    for (const Index i : columns) rows.col(i).array() *= by_load.array();
    return rows;
  };
  fit.rows.errors.cofactor = CofactorOf(fit);
}

}  // namespace

bool AsksForLoad(const IdentifierInput& given) {
  return given.options.OrDefault<LoadOption>().load == PartFit::estimated;
}

std::optional<std::string> WhyNoLoad(const IdentifierInput& given) {
  if (!AsksForLoad(given) || given.measurements.load) return std::nullopt;
  if (given.options.OrDefault<GravityOption>().gravity != FittedGravity::none) return std::nullopt;
  return kLoadIsUnknown;
}

Fit FitUnderLoad(const IdentifierInput& given, const FitInTime& fit_under) {
  Fit fit = fit_under(given);
  if (!AsksForLoad(given) || given.measurements.load) return fit;
  LogView view{given.measurements, given.selection};
  VectorXd load = VectorXd::Zero(given.measurements.size());
  for (int round = 0; round < kMostRounds && !fit.refusal; ++round) {
    VectorXd next = fit.model.gravity->Torque(given.measurements.position);
    const bool rests = round > 0 && ChangeOf(fit, next, load) <= kArrived;
    if (rests) {
      AddLoadOfGravity(load, given.measurements, fit);
      return fit;
    }
    load = std::move(next);
    view.measurements.load = load;
    fit = fit_under(given.On(view));
  }
  if (fit.refusal) return fit;
  return Refused(fit.identifier, Status::not_converged, kLoadDoesNotRest);
}

}  // namespace warmjoint
