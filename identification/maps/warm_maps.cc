#include "identification/maps/warm_maps.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "identification/explain.h"
#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/bounds.h"
#include "identification/maps/map_blocks.h"
#include "identification/warming/fit_law.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr WarmingContext kContext{" with the maps", "position-ridge"};

/// What warming takes of the residual, in variances of the noise, one turn after the other.
class Visibility {
 public:
  /// cold: squares without warming; torque: [n] to which was fitted, N.m or N
  Visibility(double cold, Eigen::VectorXd torque)
      : cold_(cold), torque_(std::move(torque)), samples_(static_cast<double>(torque_.size())) {}

  /// squares: what is left; degrees_of_freedom: samples less parameters.
  double Of(double squares, double degrees_of_freedom) const {
    return ExplainedVariances(cold_, squares, degrees_of_freedom, torque_);
  }
  /// After a turn that leaves so many squares.
  void Follow(double squares) {
    before_last_ = std::exchange(last_, std::exchange(latest_, Of(squares, samples_)));
  }
  double latest() const { return latest_; }

  /// Whether further turns would leave it below half of what can be seen. Blocks in turn grow by a geometric series, of which
  /// three terms tell the limit (Aitken).
  bool StaysUnseen() const {
    const double growth = latest_ - last_, before = last_ - before_last_;
    const double ratio = std::abs(growth) < std::abs(before) ? growth / before : 1;
    return latest_ + growth * ratio / (1 - ratio) < 0.5 * kVisibleWarming;
  }

 private:
  double cold_;
  Eigen::VectorXd torque_;
  double samples_;
  double latest_ = 0, last_ = 0, before_last_ = 0;
};

/// Of law and heat without the weights between them.
Uncertainty WithoutWeights(Uncertainty known, const MapFit& maps) {
  std::vector<Eigen::Index> places(static_cast<size_t>(known.covariance.cols()));
  std::iota(places.begin(), places.end(), 0);
  places.erase(places.begin() + maps.layout.weights.begin,
               places.begin() + maps.layout.weights.end());
  return Picked(std::move(known), places);
}

/// Adds the warming to a fit of law and maps. known: JointFit::CovarianceOf
void AddHeat(const WarmMaps& warm, const Uncertainty& known, const LogSamples& measurements,
             Fit& fit) {
  const ThermalFit& warming = warm.warming;
  fit.friction.thermal = warming.thermal();
  fit.initial_energy = warming.initial_energy();
  fit.jump_samples = Behind(warm.gaps);
  // rows of the heat, with errors that law, maps and warming share
  const std::vector<FitParameter> rows = HeatTable(warming, warm.gaps, measurements);
  Append(rows, fit);
  fit.errors.covariance = [table = WithoutWeights(known, warm.fit)] { return table; };
  fit.count += static_cast<int>(rows.size());
  fit.effective_parameters += static_cast<double>(rows.size());
  fit.causes.insert(fit.causes.begin(), Remark(ExplainWarmingBesideMaps(warm.joint->iterations()),
                                               SentenceIn::message));
  RemarkOnHeat(warming, warm.gaps, measurements, fit);
}

}  // namespace

std::optional<WarmMaps> FitWarmMaps(const IdentifierInput& input, const MapTask& task,
                                    const InitialEnergy& initial) {
  // maps as if nothing warmed, then twice warming and maps, each beside the other
  MapBlock block(input, task);
  if (!block.ChooseGiven({})) return std::nullopt;
  WarmingBlock warming(input, task, initial);
  Visibility visibility(block.Squares(), Kept(input.measurements.torque, input.selection));
  WarmMaps warm;
  bool stands = true;
  for (int turn = 0; turn < 2 && stands; ++turn) {
    stands = warming.FitGiven(block);
    if (stands && !block.FitGiven(warming.energy())) return std::nullopt;
    if (stands) visibility.Follow(block.Squares());
  }
  warm.visible = visibility.latest();
  if (stands && visibility.StaysUnseen()) return warm;

  // shape and strength are chosen once more, now that E is known; then all together
  if (stands && !block.ChooseGiven(warming.energy())) return std::nullopt;
  if (stands) {
    const auto joint = std::make_shared<JointFit>(input, task, block, warming);
    if (!joint->Refine(block)) return std::nullopt;
    warm.converged = joint->converged();
    warm.joint = joint;
  }
  warm.warming = warming.fit();
  if (warm.joint) warm.joint->HeatInto(warm.warming);
  warm.gaps = warming.gaps();
  warm.task = block.Settled();
  warm.fit = block.Complete();
  const auto n = static_cast<double>(warm.fit.fitted.size());
  warm.visible = visibility.Of(block.Squares(), n - warm.fit.effective - 2);
  return warm;
}

Fit AsFit(const IdentifierInput& input, const WarmMaps& warm) {
  const std::string& name = warm.task.identifier;
  const LogSamples& m = input.measurements;
  if (auto why = InsignificantWarming(warm.visible, kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  if (!warm.converged) {
    return Refused(name, Status::not_converged,
                   "maps and warming together do not come to rest; does the torque column hold "
                   "friction?");
  }

  // law and maps, as sure as the warming beside them leaves them
  const Eigen::VectorXd residual = Kept(m.torque, input.selection).col(0) - warm.fit.fitted -
                                   TorqueOfEnergy(input, warm.task.energy);
  const Uncertainty known = warm.joint->CovarianceOf(warm.fit, residual);
  Fit fit = AsFit(input, warm.task, warm.fit, known);
  if (fit.refusal) return fit;

  // the warming; the friction predicts its own energy from here on
  const double log_deviation = known.Deviation(warm.joint->layout().log_time_constant());
  const double time_constant = warm.warming.thermal().time_constant;
  if (auto why = UnidentifiableWarming({.explained = warm.visible,
                                        .log_deviation = log_deviation,
                                        .time_constant = time_constant,
                                        .step = MedianStep(m.time)},
                                       kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  AddHeat(warm, known, m, fit);
  const Eigen::VectorXd of_end = warm.joint->rows().OfEnd();
  fit.end_energy_std = std::sqrt(of_end.dot(known.covariance * of_end));
  if (!GivesFriction(fit)) return fit;
  // a friction that drives itself by its own heat is no model
  const FittedGravity gravity = input.options.OrDefault<GravityOption>().gravity;
  if (const auto at = PredictFriction(fit.friction, m, fit.Start()).first_driving; at < m.size()) {
    return Refused(name, Status::inadequate_model,
                   ExplainDriving(m.time[at], RemedyForNonDissipative(fit.friction.law, gravity)));
  }
  return fit;
}

}  // namespace warmjoint
