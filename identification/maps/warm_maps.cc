#include "identification/maps/warm_maps.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>
#include <utility>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/inference/bounds.h"
#include "identification/linear/against_pushing.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/map_block.h"
#include "identification/maps/motor_maps.h"
#include "identification/uncertainty/penalised_uncertainty.h"
#include "identification/warming/warming_verdict.h"
#include "models/recording/course_of.h"
#include "models/recording/without_rest.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kMostRounds = 50;
constexpr double kAtRest = 1e-6;  // of gain and time constant between rounds, relative
constexpr WarmingContext kContext{" beside the maps", "position-ridge"};

/// The loop of law columns and, with maps that are not 0, the maps' values as one column more.
ClosedLoop LoopOf(const IdentifierInput& input, const Law& law, const MapBlock& block) {
  const Measurements& m = input.measurements;
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity), of_loss = LossColumns(law, m);
  const Eigen::VectorXd values = block.Everywhere();
  if (!(values.norm() > 1e-9 * (columns * block.fit().x.head(columns.cols())).norm())) {
    return ClosedLoop::Along(m, columns, of_loss);
  }
  return ClosedLoop::Along(m, Beside(columns, values),
                           of_loss.size() > 0 ? Beside(of_loss, values) : of_loss);
}

/// The warming beside a law and maps, refined from `start`, or from a scan where there is none.
struct WarmStep {
  WarmFit fit;
  Eigen::VectorXd energy;  // [N] N.m or N
};

WarmStep FitWarming(const IdentifierInput& input, const MapTask& task, const MapBlock& block,
                    const std::optional<Thermal>& start) {
  const Law& law = *FindLaw(task.settings.law);
  const Measurements& m = input.measurements;
  const ClosedLoop loop = LoopOf(input, law, block);
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
  const Eigen::VectorXd kept = WithoutRest(input.selection, m).keep.cast<double>();
  // gravity and inertia make no heat: out of the scan, beside the loop in the fit
  const Eigen::MatrixXd offsets = loop.direction().asDiagonal() * task.rigid.columns;
  const MapWeights& maps = block.fit();
  const Eigen::VectorXd weights = maps.x.segment(task.law_count(), task.rigid.count());
  WarmStart from = ScanTimeConstant(loop, level - offsets * weights, kept);
  if (start) from.thermal = *start;
  const Eigen::Index d = from.parameters.size();
  from.parameters.conservativeResize(d + weights.size());
  from.parameters.tail(weights.size()) = weights;
  const double scale = (Kept(m.torque, input.selection).col(0) - maps.fitted).norm() /
                       std::sqrt(static_cast<double>(input.selection.count()));
  WarmStep step;
  step.fit = FitWarmFriction(loop, level, offsets, kept, from, InitialEnergy::zero, scale);
  step.energy = loop.Simulate(step.fit.parameters(), step.fit.thermal()).energy;
  return step;
}

bool AtRest(const Thermal& a, const Thermal& b) {
  return std::abs(a.gain - b.gain) <= kAtRest * std::abs(b.gain) &&
         std::abs(a.time_constant - b.time_constant) <= kAtRest * b.time_constant;
}

/// What warming takes of the residual, in variances of the noise, round after round.
class Visibility {
 public:
  /// cold: squares without warming, of so many samples.
  Visibility(double cold, Eigen::Index samples)
      : cold_(cold), samples_(static_cast<double>(samples)) {}

  /// squares: what is left; freedom: samples less parameters.
  double Of(double squares, double freedom) const {
    return (cold_ - squares) / squares * std::max(freedom, 1.0);
  }
  /// After a round that leaves so many squares.
  void Follow(double squares) {
    before_last_ = std::exchange(last_, std::exchange(latest_, Of(squares, samples_)));
  }
  double latest() const { return latest_; }

  /// Whether further rounds leave it below half of what can be seen. Blocks in turn grow by a geometric series,
  /// of which three terms tell the limit (Aitken).
  bool StaysUnseen() const {
    const double growth = latest_ - last_, before = last_ - before_last_;
    const double ratio = std::abs(growth) < std::abs(before) ? growth / before : 1;
    return latest_ + growth * ratio / (1 - ratio) < 0.5 * kVisibleWarming;
  }

 private:
  double cold_, samples_;
  double latest_ = 0, last_ = 0, before_last_ = 0;
};

/// d(F + G + M a)/d(law, rigid part, weights, k, log tau) at the kept samples.
Eigen::MatrixXd JointJacobian(const IdentifierInput& input, const WarmMaps& warm) {
  const Measurements& m = input.measurements;
  const Law& nominal = *FindLaw(warm.task.settings.law);
  const Eigen::MatrixXd law = LawColumns(nominal, m.velocity);
  const Eigen::MatrixXd of_loss = LossColumns(nominal, m);
  const Eigen::MatrixXd kernels = DenseKernels(warm.fit.maps, PointsOf(m), 0, m.size());
  const ClosedLoop loop = ClosedLoop::Along(
      m, Beside(law, kernels), of_loss.size() > 0 ? Beside(of_loss, kernels) : of_loss);
  const Eigen::Index d = law.cols(), q = kernels.cols();
  Eigen::VectorXd warming(d + q);
  warming << warm.fit.x.head(d), warm.fit.x.tail(q);
  const Eigen::MatrixXd all = loop.Jacobian(warming, warm.thermal);
  const Eigen::MatrixXd& rigid = warm.task.rigid.columns;
  Eigen::MatrixXd jacobian(m.size(), d + rigid.cols() + q + 2);
  jacobian << all.leftCols(d), rigid, all.middleCols(d, q + 2);
  jacobian.rightCols(1) *= warm.thermal.time_constant;
  return Kept(jacobian, input.selection);
}

/// Of law, weights, k and log tau together.
Uncertainty JudgeAll(const IdentifierInput& input, const WarmMaps& warm,
                     const Eigen::VectorXd& residual) {
  const Eigen::MatrixXd jacobian = JointJacobian(input, warm);
  const Eigen::Index d = jacobian.cols();
  const Eigen::Index q = warm.fit.x.size() - warm.fit.free;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(d, d);
  gram.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();

  // columns of norm 1 for the inverse: the gain's are far from the others'
  Eigen::MatrixXd penalised = gram;
  penalised.diagonal().segment(warm.fit.free, q).array() += warm.fit.strength;
  const Eigen::VectorXd scale = penalised.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factors(scale.asDiagonal() * penalised * scale.asDiagonal());
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() * factors.solve(Eigen::MatrixXd::Identity(d, d)) * scale.asDiagonal();
  const auto rows = [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    return jacobian.middleRows(first, last - first);
  };
  return JudgePenalised({gram, inverse, warm.fit.free, warm.fit.x.tail(q), warm.fit.strength}, rows,
                        residual, input.selection);
}

/// Of law, k and log tau without the weights between them.
Uncertainty WithoutWeights(Uncertainty known, const MapFit& maps) {
  std::vector<Eigen::Index> places(static_cast<size_t>(maps.free));
  std::iota(places.begin(), places.end(), 0);
  for (const Eigen::Index i : {0, 1}) places.push_back(maps.x.size() + i);
  known.covariance = known.covariance(places, places).eval();
  return known;
}

/// Adds the warming to a fit of law and maps. known: JudgeAll
void AddHeat(const WarmMaps& warm, const Uncertainty& known, const Measurements& measurements,
             Fit& fit) {
  fit.friction.thermal = warm.thermal;
  Append(HeatParameters(warm.thermal, measurements), fit);
  fit.errors.known = WithoutWeights(known, warm.fit);
  fit.count += 2;
  fit.effective_parameters += 2;
  fit.afterword = fmt::format("; warming beside them in {} rounds", warm.rounds);
}

/// Adds what the motor's map shows, where there is one. known: JudgeAll
void AddRipple(const MapFit& maps, const Uncertainty& known, const Measurements& measurements,
               Fit& fit) {
  const FrictionMap& first = maps.maps[0];
  if (first.axes[0].quantity != MapQuantity::motor_position) return;
  const auto count = static_cast<Eigen::Index>(first.size());
  DescribeMotorRipple(first, known.covariance.block(maps.free, maps.free, count, count),
                      measurements, fit);
}

}  // namespace

std::optional<WarmMaps> FitWarmMaps(const IdentifierInput& input, const MapTask& task) {
  MapBlock block(input, task);
  if (!block.ChooseBeside({})) return std::nullopt;
  Visibility visibility(block.Squares(), input.selection.count());

  WarmMaps warm;
  std::optional<Thermal> before;
  for (warm.rounds = 1; warm.rounds <= kMostRounds; ++warm.rounds) {
    const WarmStep step = FitWarming(input, task, block, before);
    if (!step.fit.converged || !step.energy.allFinite()) break;
    warm.thermal = step.fit.thermal();
    warm.converged = before && AtRest(*before, warm.thermal);
    if (warm.converged) break;
    before = warm.thermal;

    // shape and strength are chosen once more where a warming is seen, now that E is known, then kept
    if (!block.FitBeside(step.energy)) return std::nullopt;
    visibility.Follow(block.Squares());
    if (warm.rounds != 2) continue;
    warm.visible = visibility.latest();
    if (visibility.StaysUnseen()) return warm;
    if (!block.ChooseBeside(step.energy)) return std::nullopt;
  }
  warm.task = block.Settled();
  warm.fit = block.Complete();
  const auto n = static_cast<double>(warm.fit.fitted.size());
  warm.visible = visibility.Of(block.Squares(), n - warm.fit.effective - 2);
  return warm;
}

Fit AsFit(const IdentifierInput& input, const WarmMaps& warm) {
  const std::string& name = warm.task.identifier;
  const Measurements& m = input.measurements;
  if (auto why = UnseenWarming(warm.visible, kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  if (!warm.converged) {
    return Refused(name, Status::not_converged,
                   fmt::format("maps and warming still move after {} rounds; does the torque "
                               "column hold friction?",
                               warm.rounds));
  }

  // law and maps, as sure as the warming beside them leaves them
  const Eigen::VectorXd residual = Kept(m.torque, input.selection).col(0) - warm.fit.fitted -
                                   TakenByEnergy(input, warm.task.energy);
  const Uncertainty known = JudgeAll(input, warm, residual);
  Fit fit = AsFit(input, warm.task, warm.fit, known);
  if (fit.refusal) return fit;

  // the warming; the friction predicts its own energy from here on
  const double log_deviation = known.Deviation(warm.fit.x.size() + 1);
  if (auto why =
          UnknownWarming({warm.visible, log_deviation, warm.thermal.time_constant}, kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  AddHeat(warm, known, m, fit);
  if (!GivesFriction(fit)) return fit;
  AddRipple(warm.fit, known, m, fit);
  if (const auto at = PredictFriction(fit.friction, m).feeds_itself; at < m.size()) {
    return Refused(
        name, Status::inadequate_model,
        WouldFeedItself(m.time[at],
                        AgainstPushing("energy-ml", fit.friction.law,
                                       fit.gravity ? GravityName(fit.gravity->kind) : "none")));
  }
  return fit;
}

}  // namespace warmjoint::inline identification
