#include "identification/maps/warm_maps.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/bounds.h"
#include "identification/maps/map_blocks.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/maps.h"
#include "identification/warming/law_fit.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr WarmingContext kContext{kWithTheMaps, "position-ridge"};

/// Whether further turns would leave the part of the residual that warming explains below half of what can be seen. That part
/// grows by a geometric series, of which two terms determine the limit (Aitken). first, second: after these turns, in variances
/// of the noise
bool IsInsignificant(double first, double second) {
  const double growth = second - first;
  const double ratio = std::abs(growth) < std::abs(first) ? growth / first : 1;
  return second + growth * ratio / (1 - ratio) < 0.5 * kVisibleWarming;
}

/// The uncertainty of law and heat without the weights, which are between them.
Uncertainty WithoutWeights(Uncertainty uncertainty, const MapFit& maps) {
  std::vector<Eigen::Index> places(static_cast<size_t>(uncertainty.covariance.cols()));
  std::iota(places.begin(), places.end(), 0);
  places.erase(places.begin() + maps.of_weights.begin, places.begin() + maps.of_weights.end());
  return Picked(std::move(uncertainty), places);
}

/// Adds the warming to a fit of law and maps. uncertainty: WarmMapFit::CovarianceOf
void AddHeat(const WarmMaps& warm, const Uncertainty& uncertainty, const LogSamples& measurements,
             Fit& fit) {
  const ThermalFit& warming = warm.warming;
  fit.model.friction.thermal = warming.thermal();
  fit.start.energy = warming.initial_energy();
  fit.start.jump_samples = Behind(warm.gaps);
  // rows of the heat, with errors that law, maps and warming share
  const std::vector<Unknown> rows = HeatTable(warming, warm.gaps, measurements);
  Append(rows, fit);
  fit.rows.errors.covariance = [table = WithoutWeights(uncertainty, warm.fit)] { return table; };
  fit.rows.count += static_cast<int>(rows.size());
  fit.rows.effective_parameters += static_cast<double>(rows.size());
  fit.causes.insert(fit.causes.begin(),
                    Note(ExplainWarmingBesideMaps(warm.joint->iterations()), SentenceIn::message));
  RemarkOnHeat(warming, warm.gaps, measurements, fit);
}

}  // namespace

std::optional<WarmMaps> FitWarmMaps(const IdentifierInput& input, const MapTask& task,
                                    const InitialEnergy& initial) {
  // maps as if nothing warmed, then twice warming and maps, each given the other
  MapBlock block(input, task);
  if (!block.ChooseGiven({})) return std::nullopt;
  WarmingBlock warming(input, task, initial);
  const Eigen::VectorXd torque = Kept(input.measurements.torque, input.selection);
  const auto n = static_cast<double>(torque.size());
  const auto visible = [&, cold = block.Squares()](double degrees_of_freedom) {
    return ExplainedVariances(cold, block.Squares(), degrees_of_freedom, torque);
  };
  WarmMaps warm;
  warm.task.identifier = task.identifier;
  double first = 0;
  for (int turn = 0; turn < 2; ++turn) {
    if (!warming.FitGiven(block)) return warm;
    if (!block.FitGiven(warming.energy())) return std::nullopt;
    first = std::exchange(warm.visible, visible(n));
  }
  if (IsInsignificant(first, warm.visible)) return warm;

  // shape and strength are chosen once more, now that E is known; then all together
  if (!block.ChooseGiven(warming.energy())) return std::nullopt;
  const auto joint = std::make_shared<WarmMapFit>(input, task, block, warming);
  if (!joint->Refine(block)) return std::nullopt;
  warm.joint = joint;
  warm.converged = joint->converged();
  warm.warming = warming.fit();
  joint->HeatInto(warm.warming);
  warm.gaps = warming.gaps();
  warm.task = block.Settled();
  warm.fit = block.Complete();
  warm.visible = visible(n - warm.fit.effective - 2);
  return warm;
}

Fit AsFit(const IdentifierInput& input, const WarmMaps& warm) {
  const std::string& name = warm.task.identifier;
  const LogSamples& m = input.measurements;
  if (auto why = InsignificantWarming(warm.visible, kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  if (!warm.converged) {
    return Refused(name, Status::not_converged, kMapsDoNotRest);
  }

  // law and maps, with the uncertainty that the warming adds to theirs
  const Eigen::VectorXd residual = Kept(m.torque, input.selection).col(0) - warm.fit.fitted -
                                   TorqueOfEnergy(input, warm.task.energy);
  const Uncertainty uncertainty = warm.joint->CovarianceOf(warm.fit, residual);
  Fit fit = AsFit(input, warm.task, warm.fit, uncertainty);
  if (fit.refusal) return fit;

  // the warming; the friction predicts its own energy from here on
  const double log_deviation = uncertainty.Deviation(warm.joint->At(Role::time_constant).begin);
  const double time_constant = warm.warming.thermal().time_constant;
  if (auto why = UnidentifiableWarming({.explained = warm.visible,
                                        .log_deviation = log_deviation,
                                        .time_constant = time_constant,
                                        .step = MedianStep(m.time)},
                                       kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  AddHeat(warm, uncertainty, m, fit);
  const Eigen::VectorXd of_end = warm.joint->EndSlopes();
  fit.figures.end_energy_std = std::sqrt(of_end.dot(uncertainty.covariance * of_end));
  if (!GivesFriction(fit)) return fit;
  // a friction that drives the joint by its own heat is not a valid model
  const FittedGravity gravity = input.options.OrDefault<GravityOption>().gravity;
  if (const auto at = PredictFriction(fit.model.friction, m, fit.Start()).first_driving;
      at < m.size()) {
    return Refused(
        name, Status::inadequate_model,
        ExplainDriving(m.time[at], RemedyForNonDissipative(fit.model.friction.law, gravity)));
  }
  return fit;
}

}  // namespace warmjoint
