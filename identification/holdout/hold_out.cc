#include "identification/holdout/hold_out.h"

#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "identification/fit/fit_along.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/bounds.h"
#include "identification/inference/inference.h"
#include "identification/sentences/fit.h"
#include "models/foundation/low_pass.h"

namespace warmjoint {
namespace {

/// Why samples that were asked for are not compared.
std::string WhyNone(const Fit& fit, Eigen::Index asked) {
  if (asked > 0 && fit.model.gravity) return kKnowsNoGravityThere;
  return fit.model.inertia ? kNothingMoves : kNothingHoldsASpeed;
}

/// The samples that were chosen, as far as they are within the first part of a log.
Selection Within(Selection first, const Selection& chosen) {
  const Eigen::Index n = std::min(first.keep.size(), chosen.keep.size());
  first.keep.head(n) = first.keep.head(n) && chosen.keep.head(n);
  first.keep.tail(first.keep.size() - n) = false;
  // segments as they were chosen, as far as they are within the first part
  first.segments.clear();
  for (Segment segment : chosen.segments) {
    segment.end = std::min(segment.end, n);
    if (segment.begin < segment.end) first.segments.push_back(segment);
  }
  return first;
}

}  // namespace

std::optional<SplitSelection> SplitOf(const Selection& selection, double fraction) {
  const auto& keep = selection.keep;
  // a share of the samples that take part, however long they last
  const auto first = std::llround((1 - fraction) * static_cast<double>(keep.count()));
  if (first < 2 || first >= keep.count()) return std::nullopt;
  Eigen::Index end = 0;
  for (Eigen::Index seen = 0; seen < first || !keep[end]; ++end) seen += keep[end];
  SplitSelection split{end, selection, selection};
  split.first.keep.tail(keep.size() - end) = false;
  split.rest.keep.head(end) = false;
  return split;
}

bool IsVaried(const Eigen::VectorXd& all, const Selection& test) {
  const Eigen::ArrayXd velocity = Kept(all, test), speed = velocity.abs();
  const bool both = velocity.minCoeff() < 0 && velocity.maxCoeff() > 0;
  return both && speed.maxCoeff() > 1.1 * speed.minCoeff();
}

std::optional<FirstPart> FitFirstPart(const Identifier& identifier, const IdentifierInput& given,
                                      double fraction, const Fit& all_data) {
  const IdentifierInput input = SelectSamples(identifier, given);
  const auto cut = SplitOf(input.selection, fraction);
  if (!cut) return std::nullopt;
  const double split = input.measurements.time[cut->at];
  // the samples before, in the view in which the identifier had the whole log
  const IdentifierInput before{input.log.Before(split), input.options, input.start};
  const IdentifierInput all = before.Through(input.view);
  // at constant speed without unsettled samples; other views choose their samples anew
  const bool steady = input.view == View::constant_speed;
  const Selection chosen = steady ? Within(all.selection, input.selection) : all.selection;
  const IdentifierInput seen = all.With(chosen);
  const auto& make = all_data.structure ? all_data.structure : identifier.fit;
  return FirstPart{split, WithoutNegativeInertia(make, seen)};
}

HeldOut HoldOut(const Identifier& identifier, const IdentifierInput& given, double fraction,
                const Fit& all_data) {
  const auto first = FitFirstPart(identifier, given, fraction, all_data);
  if (!first) return {{}, ExplainShortParts(fraction)};

  // the test part alone is compared, the prediction runs from the start
  const IdentifierInput input = SelectSamples(identifier, given);
  Selection test = input.selection;
  const auto before = (input.measurements.time.array() < first->split).count();
  test.keep.head(before) = false;
  // where the heat with which recordings begin is free, a fit does not know that of recordings that it has not seen
  const std::vector<Eigen::Index>& starts = input.measurements.further_starts;
  const bool own_starts = first->fit.RowOf(Role::start) && !starts.empty();
  if (own_starts) {
    const auto unseen = std::ranges::lower_bound(starts, before);
    if (unseen != starts.end()) test.keep.tail(input.measurements.size() - *unseen) = false;
  }
  if (auto metrics = Evaluate(first->fit, input.measurements, test, first->fit.Start())) {
    // about their mean, of which Fit is a share
    const double spread = metrics->rmse / (1 - metrics->fit / 100);
    return {.metrics = std::move(metrics),
            .varied = IsVaried(input.measurements.velocity, test),
            .without_friction = spread};
  }

  // a fit without friction predicts nothing; else the rest holds no sample to compare
  const Inference inferred = Infer(first->fit);
  if (!inferred.gives_friction) {
    return {{}, ExplainNoFrictionBefore(fraction, inferred.message)};
  }
  const std::string why =
      own_starts && test.keep.count() == 0 ? kHeatOfItsOwn : WhyNone(first->fit, test.keep.count());
  return {{}, ExplainNotHeldOut(fraction, why)};
}

HeldOut HoldOut(const Identifier& identifier, const Fit& fit, const PreparedLog& other) {
  const ThermalStart cold;
  const LogView& seen = SeenByModel(fit.model.inertia, identifier.view, other);
  if (auto metrics = Evaluate(fit, seen.measurements, seen.selection, cold)) {
    return {std::move(metrics), ""};
  }
  if (!GivesFriction(fit)) return {{}, kPredictsNothing};
  return {{}, ExplainNotPredicted(seen.measurements.source, WhyNone(fit, seen.selection.count()))};
}

std::vector<Eigen::Index> CutIntoBlocks(const Selection& selection, int blocks) {
  std::vector<Eigen::Index> bounds{0};
  const Eigen::Index n = selection.keep.size();
  const Eigen::Index kept = selection.count();

  // a block ends once it has its share of the kept samples
  Eigen::Index seen = 0;
  for (Eigen::Index i = 0; i < n && static_cast<int>(bounds.size()) < blocks; ++i) {
    if (seen * blocks >= kept * static_cast<Eigen::Index>(bounds.size())) bounds.push_back(i);
    seen += selection.keep[i];
  }
  bounds.push_back(n);
  return bounds;
}

std::optional<Eigen::VectorXd> UnseenResiduals(const Identifier& identifier,
                                               const IdentifierInput& input,
                                               const std::vector<Eigen::Index>& bounds) {
  const LogSamples& m = input.measurements;
  Eigen::VectorXd left =
      Eigen::VectorXd::Constant(m.size(), std::numeric_limits<double>::quiet_NaN());
  for (size_t b = 0; b + 1 < bounds.size(); ++b) {
    // fit to all but the block, evaluate on the block alone
    const Eigen::Index length = bounds[b + 1] - bounds[b];
    Selection others = input.selection;
    others.keep.segment(bounds[b], length) = false;
    Selection block = input.selection;
    block.keep = block.keep && !others.keep;
    const IdentifierInput rest = input.With(others);
    const Fit fit = identifier.fit(rest);
    if (!GivesFriction(fit)) return std::nullopt;
    const TorquePrediction predicted = PredictTorque(fit.model, m, std::move(block), fit.Start());
    if (predicted.covered.count() == 0) return std::nullopt;
    left = predicted.covered.keep.select(m.torque - predicted.torque, left);
  }
  return left;
}

TorquePrediction PredictTorque(const TorqueModel& model, const LogSamples& logged, Selection asked,
                               const ThermalStart& start) {
  // a torque that is late, or under a load that the log lacks
  const bool grows = model.friction.load_gain != 0 && model.gravity;
  if (auto other = Followed(logged, asked, {grows ? &*model.gravity : nullptr, model.delay})) {
    TorqueModel in_time = model;
    in_time.delay.reset();
    return PredictTorque(in_time, other->measurements, std::move(other->selection), start);
  }
  const LogSamples& m = logged;
  TorquePrediction predicted{{}, std::move(asked), PredictFriction(model.friction, m, start)};
  predicted.torque = WithRigid(model, m, predicted.friction.force);

  // compared where gravity is known
  if (model.gravity) {
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      bool& keep = predicted.covered.keep[i];
      keep = keep && model.gravity->Covers(m.position[i]);
    }
  }

  // the log has the torque after its lag
  if (model.lag) predicted.torque = LowPass(m.time, predicted.torque, *model.lag);
  return predicted;
}

std::optional<Metrics> Evaluate(const Fit& fit, const LogSamples& measurements, Selection test,
                                const ThermalStart& start) {
  if (!GivesFriction(fit)) return std::nullopt;
  const Friction& friction = fit.model.friction;
  const TorquePrediction predicted = PredictTorque(fit.model, measurements, std::move(test), start);
  if (predicted.covered.count() == 0) return std::nullopt;

  // all parameters that the model has, weights of kernels included
  auto parameters = friction.parameters.size() + (friction.thermal ? 2 : 0);
  for (const FrictionMap& map : friction.maps) parameters += map.weights.size();
  if (fit.model.gravity) parameters += fit.model.gravity->values.size();
  if (fit.model.inertia) ++parameters;
  if (fit.model.lag) ++parameters;
  if (fit.RowOf(Role::delay)) ++parameters;
  if (fit.RowOf(Role::load)) ++parameters;
  return ComputeMetrics(Kept(measurements.torque, predicted.covered),
                        Kept(predicted.torque, predicted.covered), static_cast<int>(parameters),
                        fit.rows.effective_parameters);
}

}  // namespace warmjoint
