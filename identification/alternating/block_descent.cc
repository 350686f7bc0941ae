#include "identification/alternating/block_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

namespace {

constexpr int kMaxSteps = 100;
constexpr double kLongestStep = 1.0;  // in ln tau
constexpr double kLastStep = 1e-6;  // in ln tau; the error after a Newton step is about its square
constexpr double kGridPerDecade = 8.0;

}  // namespace

OutputError::OutputError(const Eigen::VectorXd& time, const Eigen::VectorXd& loss,
                         const Selection& selection, const std::vector<Eigen::Index>& starts)
    : filter_(time, starts),
      loss_(loss),
      kept_(selection.keep.cast<double>()),
      shortest_(0.1 * MedianStep(time)),
      longest_(100 * (time[time.size() - 1] - time[0])) {}

OutputError::Slice OutputError::Evaluate(const Eigen::VectorXd& energy, double theta) const {
  // inner products over the kept samples; y: energy, S: response at unit gain, ' by theta
  double yy = 0, yS = 0, yS1 = 0, yS2 = 0, SS = 0, SS1 = 0, SS2 = 0, S1S1 = 0;
  filter_.ForEach(std::exp(theta), loss_, [&](Eigen::Index i, const UnitEnergy& S) {
    const double y = kept_[i] * energy[i];
    const double value = kept_[i] * S.value;
    const double slope = kept_[i] * S.slope;
    yy += y * y;
    yS += y * S.value;
    yS1 += y * S.slope;
    yS2 += y * S.curvature;
    SS += value * S.value;
    SS1 += value * S.slope;
    SS2 += value * S.curvature;
    S1S1 += slope * S.slope;
  });

  // best gain g = y.S / S.S, cost |y - g S|^2; its derivative needs no dg (envelope theorem)
  Slice slice;
  if (SS <= 0) return {0, yy, 0, 0};
  const double g = yS / SS;
  const double g1 = (yS1 - 2 * g * SS1) / SS;
  slice.gain = g;
  slice.cost = std::max(0.0, yy - g * yS);
  slice.slope = -2 * g * (yS1 - g * SS1);
  slice.curvature = -2 * g1 * (yS1 - 2 * g * SS1) - 2 * g * yS2 + 2 * g * g * (S1S1 + SS2);
  return slice;
}

double OutputError::Scan(const Eigen::VectorXd& energy) const {
  // a factor of ten within the bounds, evenly in the logarithm
  const double first = std::log(10 * shortest_);
  const double last = std::log(0.1 * longest_);
  const int count = 2 + static_cast<int>((last - first) / std::log(10.0) * kGridPerDecade);

  // the least cost on the grid
  double best = first;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    const double theta = first + (last - first) * i / (count - 1);
    const double cost = Evaluate(energy, theta).cost;
    if (cost < best_cost) {
      best = theta;
      best_cost = cost;
    }
  }
  return std::exp(best);
}

OutputError::Fit OutputError::Refine(const Eigen::VectorXd& energy, double start) const {
  const double lower = std::log(shortest_);
  const double upper = std::log(longest_);
  double theta = std::clamp(std::log(start), lower, upper);
  Slice here = Evaluate(energy, theta);

  for (int i = 0; i < kMaxSteps; ++i) {
    // Newton where the cost is convex, else a plain step downhill
    double step = here.curvature > 0 ? -here.slope / here.curvature
                                     : -std::copysign(kLongestStep, here.slope);
    step = std::clamp(step, -kLongestStep, kLongestStep);
    double next = std::clamp(theta + step, lower, upper);
    const bool last = std::abs(next - theta) < kLastStep;

    // halve until the cost falls; the very last step is below what the cost can resolve
    Slice there = Evaluate(energy, next);
    while (!last && there.cost > here.cost && std::abs(next - theta) > kLastStep) {
      next = theta + 0.5 * (next - theta);
      there = Evaluate(energy, next);
    }
    // on to the new point, until steps are tiny
    theta = next;
    here = there;
    if (last) break;
  }
  return {{here.gain, std::exp(theta)}, here.cost, theta > lower && theta < upper};
}

BlockDescent::BlockDescent(const LogSamples& measurements, const Selection& moving,
                           const Eigen::MatrixXd& columns, const Eigen::MatrixXd& cofactor,
                           const Eigen::VectorXd& gravity)
    : cofactor_(cofactor),
      // (19) with the measured torque
      output_error_(measurements.time,
                    (measurements.torque - gravity).cwiseProduct(measurements.velocity).cwiseAbs(),
                    moving, measurements.further_starts),
      kept_(static_cast<double>(moving.count())) {
  const Eigen::VectorXd keep = moving.keep.cast<double>();
  sign_ = keep.cwiseProduct(measurements.velocity.array().sign().matrix());
  torque_ = keep.cwiseProduct(measurements.torque);
  columns_ = keep.asDiagonal() * columns;
}

DescentState BlockDescent::Start(Thermal start) const {
  start.time_constant = std::max(start.time_constant, output_error_.shortest());
  return WithNominal(start, true);
}

DescentState BlockDescent::Next(const DescentState& state) const {
  const OutputError::Fit fit =
      output_error_.Refine(MeasuredEnergy(state.nominal), state.thermal.time_constant);
  return WithNominal(fit.thermal, fit.inside);
}

double BlockDescent::ScanFrom(const DescentState& state) const {
  return output_error_.Scan(MeasuredEnergy(state.nominal));
}

Eigen::VectorXd BlockDescent::Warming(const Thermal& thermal) const {
  return sign_.cwiseProduct(output_error_.filter().Energy(thermal, output_error_.loss()));
}

Eigen::VectorXd BlockDescent::Fitted(const DescentState& state) const {
  return columns_ * state.nominal + Warming(state.thermal);
}

Eigen::MatrixXd BlockDescent::Jacobian(const DescentState& state) const {
  const Eigen::Index d = columns_.cols();
  Eigen::MatrixXd jacobian(columns_.rows(), d + 2);
  jacobian.leftCols(d) = columns_;
  // the heat is linear in the gain; the time constant is represented by its logarithm
  const auto& [gain, time_constant] = state.thermal;
  output_error_.filter().ForEach(time_constant, output_error_.loss(),
                                 [&](Eigen::Index i, const UnitEnergy& energy) {
                                   jacobian(i, d) = sign_[i] * energy.value;
                                   jacobian(i, d + 1) = sign_[i] * gain * energy.slope;
                                 });
  return jacobian;
}

// E = (tau - Fn) sign(v), Eq. (23)
Eigen::VectorXd BlockDescent::MeasuredEnergy(const Eigen::VectorXd& nominal) const {
  return sign_.cwiseProduct(torque_ - columns_ * nominal);
}

// Fn = tau - sign(v) E, Eq. (24), by least squares
DescentState BlockDescent::WithNominal(const Thermal& thermal, bool inside) const {
  const Eigen::VectorXd target = torque_ - Warming(thermal);
  DescentState state;
  state.nominal = cofactor_ * (columns_.transpose() * target);
  state.thermal = thermal;
  state.rmse = (target - columns_ * state.nominal).norm() / std::sqrt(kept_);
  state.inside = inside;
  return state;
}

}  // namespace warmjoint
