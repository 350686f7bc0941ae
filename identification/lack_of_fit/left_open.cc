#include "identification/lack_of_fit/left_open.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/lack_of_fit/error_level.h"
#include "identification/lack_of_fit/sensitivity.h"
#include "identification/lack_of_fit/table.h"
#include "identification/lack_of_fit/with_heat.h"
#include "identification/linear/rigid_part.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// why: a drift that takes half the log to die away is still nearly even, one of an eighth is over before the
// warming is; between them by halves
constexpr double kSlowest = 1.0 / 2;  // of the log: the longest time constant of a drift
constexpr Index kFadings = 3;         // time constants, each half as long as the one before
constexpr double kTold = 1e-6;  // of a column beside the fit, below which the log tells nothing

/// Values between which a factor may lie at all.
struct Possible {
  double least, most;
};

/// What the tests of the log leave open of a force's factor beside the fit.
class OpenFactor {
 public:
  /// residual: [m] means over bins
  OpenFactor(const ForceMoves& fit, const VectorXd& residual)
      : fit_(fit), left_(fit.root().cwiseProduct(residual)) {
    left_ -= fit.basis() * (fit.basis().transpose() * left_);
  }

  /// Both ends of its interval at their level. force: [m] means over bins.
  Possible Interval(const VectorXd& force, const Possible& possible) const;

 private:
  const ForceMoves& fit_;
  VectorXd left_;  // [m] weighted, of the residual beside the fit
};

Possible OpenFactor::Interval(const VectorXd& force, const Possible& possible) const {
  // what the log cannot tell from the fit is open as far as it is possible at all
  const VectorXd weighted = fit_.root().cwiseProduct(force);
  const VectorXd own = weighted - fit_.basis() * (fit_.basis().transpose() * weighted);
  const double square = own.squaredNorm();
  const bool told = square > kTold * kTold * weighted.squaredNorm();
  if (!fit_.AllApart() || !told) return possible;

  // the force joins the fit for one step of least squares, whose other columns are a basis of the fit's
  const double factor = own.dot(left_) / square;
  const Index p = fit_.basis().cols();
  MatrixXd cofactor = MatrixXd::Identity(p + 1, p + 1);
  cofactor(p, p) = 1 / square;
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(own.size(), true), {}};
  const Uncertainty known = JudgeUncertainty([&] { return Beside(fit_.basis(), own); }, cofactor,
                                             left_ - factor * own, all);

  // the level of one test among all that the log faces
  const double level = 1 - kErrorLevel / static_cast<double>(LackOfFitTests().size());
  const double reach = StudentQuantile(known.freedom, level) * known.Deviation(p);
  const auto within = [&](double c) { return std::clamp(c, possible.least, possible.most); };
  return {within(factor - reach), within(factor + reach)};
}

/// The end that is farther from 0.
double FarEnd(const Possible& interval) {
  return std::abs(interval.least) > std::abs(interval.most) ? interval.least : interval.most;
}

/// A drift, over bins: zero at the start, and zero at the end.
struct Drift {
  VectorXd from_first, until_last;  // [m]
  double most;                      // of its factor
};

std::vector<Drift> Drifts(const FittedModel& model, const Measurements& m, const Bins& bins,
                          double friction) {
  // courses d(t) of friction, and 1
  constexpr Index kCourses = 1 + kFadings;
  const ArrayXd t = (m.time.array() - m.time[0]) / (m.time[m.size() - 1] - m.time[0]);
  MatrixXd levels(m.size(), kCourses + 1);
  levels.col(0) = t;
  // each fading is the square of the one before it
  ArrayXd faded = (-t / kSlowest).exp();
  double end = std::exp(-1 / kSlowest);
  for (Index i = 1; i < kCourses; ++i, faded = faded.square().eval(), end *= end) {
    levels.col(i) = (1 - faded) / (1 - end);
  }
  levels.col(kCourses).setOnes();

  // as friction, with the heat that it makes
  levels = m.velocity.array().sign().matrix().asDiagonal() * levels;
  const MatrixXd forces = bins.Means(WithHeat(model, m, levels));
  // each as seen from the first moment, and from the last
  std::vector<Drift> drifts;
  for (Index i = 0; i < kCourses; ++i) {
    drifts.push_back({forces.col(i), forces.col(i) - forces.col(kCourses), friction});
  }

  // a sensor
  const VectorXd force = bins.Means(model.torque - model.residual);
  const VectorXd gain = force.cwiseProduct(bins.time);
  drifts.push_back({gain, gain - force, 1});
  return drifts;
}

/// s v^2, with its heat and without. [m x 2]
MatrixXd Curves(const FittedModel& model, const Measurements& m, const Bins& bins) {
  const VectorXd square = m.velocity.cwiseProduct(m.velocity.cwiseAbs());
  const VectorXd fast = m.loss_velocity.value_or(m.velocity);
  const MatrixXd heating = WithHeat(model, m, square, fast.cwiseProduct(fast.cwiseAbs()));
  return bins.Means(Beside(heating, square));
}

}  // namespace

void LearnLeftOpen(const FittedModel& model, const Measurements& m, const Bins& bins,
                   const Circumstances& known, Index p, const ForceMoves& fit,
                   Examination& examination) {
  const OpenFactor open(fit, bins.Means(model.residual));
  const auto moves = [&](const VectorXd& force, double factor) -> VectorXd {
    return fit.By(factor * force).topRows(p);
  };

  // a start that was not cold
  if (model.by_initial_energy) {
    const VectorXd force = bins.Means(*model.by_initial_energy);
    const Possible warm{std::min(model.energy.minCoeff(), 0.0),
                        std::max(model.energy.maxCoeff(), 0.0)};
    examination.open_start = FarEnd(open.Interval(force, warm));
    examination.by_open_start = moves(force, examination.open_start);
  }

  // a law that bends over the speed, or follows it late
  const double fastest = bins.velocity.cwiseAbs().maxCoeff();
  // the farthest that any of several forces moves each parameter
  const auto farthest = [&](const MatrixXd& forces, double most) {
    VectorXd by = VectorXd::Zero(forces.cols() > 0 ? p : 0);
    for (Index i = 0; i < forces.cols(); ++i) {
      const VectorXd force = forces.col(i);
      const double factor = FarEnd(open.Interval(force, {-most, most}));
      by = by.cwiseMax(moves(force, factor).cwiseAbs());
    }
    return by;
  };
  const double friction = examination.friction;
  examination.by_open_curve = farthest(Curves(model, m, bins), friction / (fastest * fastest));
  examination.by_open_memory = farthest(known.late_speeds, friction / fastest);

  // friction, or a sensor, that drifts for another reason than its losses
  examination.by_open_drift.setZero(p);
  for (const Drift& drift : Drifts(model, m, bins, examination.friction)) {
    const double factor = FarEnd(open.Interval(drift.from_first, {-drift.most, drift.most}));
    for (const VectorXd& force : {drift.from_first, drift.until_last}) {
      examination.by_open_drift =
          examination.by_open_drift.cwiseMax(moves(force, factor).cwiseAbs());
    }
  }
}

}  // namespace warmjoint::inline identification
