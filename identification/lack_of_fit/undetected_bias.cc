#include "identification/lack_of_fit/undetected_bias.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "identification/lack_of_fit/sensitivity.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/lack_of_fit/table.h"
#include "identification/linear/rigid_part.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTold = 1e-6;  // of a column beside the fit, below which the log tells nothing

/// Values between which a factor may lie at all.
struct Possible {
  double least, most;

  /// The end that is farther from 0.
  double FarEnd() const { return std::abs(least) > std::abs(most) ? least : most; }
};

/// Deviations of a factor at the level of one test among all that the log faces.
double Quantile(double freedom) {
  return StudentQuantile(freedom, 1 - kErrorLevel / static_cast<double>(LackOfFitTests().size()));
}

/// What the tests of the log leave open of the factors of forces, each by itself beside the fit.
class OpenFactors {
 public:
  /// residual: [m] means over bins; forces: [m x q] the same
  OpenFactors(const ForceMoves& fit, const VectorXd& residual, const MatrixXd& forces)
      : fit_(fit),
        left_(fit.root().cwiseProduct(residual)),
        own_(fit.root().asDiagonal() * forces) {
    left_ -= fit.basis() * (fit.basis().transpose() * left_);
    weighted_ = own_.colwise().squaredNorm();
    const MatrixXd shared = fit.basis().transpose() * own_;
    own_.noalias() -= fit.basis() * shared;
    const Index freedom = left_.size() - fit.basis().cols() - 1;
    if (freedom < 1) return;
    white_freedom_ = static_cast<double>(freedom);
    white_quantile_ = Quantile(white_freedom_);
  }

  /// Both ends of the i-th one's interval at their level.
  Possible Interval(Index i, const Possible& possible) const;

 private:
  const ForceMoves& fit_;
  VectorXd left_;                                  // [m] weighted, of the residual beside the fit
  MatrixXd own_;                                   // [m x q] weighted, of the forces beside the fit
  VectorXd weighted_;                              // [q] squares of the forces
  double white_freedom_ = 0, white_quantile_ = 0;  // of most forces: where what they leave is white
};

Possible OpenFactors::Interval(Index i, const Possible& possible) const {
  // what the log cannot tell from the fit is open as far as it is possible at all
  const auto own = own_.col(i);
  const double square = own.squaredNorm();
  const bool told = square > kTold * kTold * weighted_[i];
  if (!fit_.AllApart() || !told) return possible;

  // the force joins the fit for one step of least squares, whose other columns are a basis of the fit's
  const double factor = own.dot(left_) / square;
  const Index p = fit_.basis().cols();
  MatrixXd cofactor = MatrixXd::Identity(p + 1, p + 1);
  cofactor(p, p) = 1 / square;
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(own.size(), true), {}};
  const Uncertainty known = EstimateCovariance([&] { return ConcatColumns(fit_.basis(), own); },
                                               cofactor, left_ - factor * own, all);

  // as far as noise reaches at that level
  const double quantile =
      known.freedom == white_freedom_ ? white_quantile_ : Quantile(known.freedom);
  const double reach = quantile * known.Deviation(p);
  const auto within = [&](double c) { return std::clamp(c, possible.least, possible.most); };
  return {within(factor - reach), within(factor + reach)};
}

/// s v^2, without heat. [m x 1]
MatrixXd Curve(const LogSamples& m, const Bins& bins) {
  return bins.Means(m.velocity.cwiseProduct(m.velocity.cwiseAbs()));
}

/// The farthest end of the factor of each of some forces that lies within -most and most. [count]
VectorXd FarEnds(const OpenFactors& open, Index first, Index count, double most) {
  VectorXd ends(count);
  for (Index i = 0; i < count; ++i) ends[i] = open.Interval(first + i, {-most, most}).FarEnd();
  return ends;
}

/// The most that any of some forces moves each parameter. moves: [p x q] by a factor of 1; factors: [q]
VectorXd Farthest(const MatrixXd& moves, const VectorXd& factors) {
  return (moves * factors.asDiagonal()).cwiseAbs().rowwise().maxCoeff();
}

constexpr double kDegree = std::numbers::pi / 180;  // rad
constexpr double kClock = 1.01;  // as fast as it should be; why: the slip that is asked about

/// The most that an end of each interval moves. [p]
Eigen::VectorXd FarthestMoves(double way, double time, const Fit& fit, const Inference& inference,
                              const std::vector<size_t>& rows) {
  Eigen::VectorXd moves(static_cast<Eigen::Index>(rows.size()));
  for (size_t i = 0; i < rows.size(); ++i) {
    const FitParameter& parameter = fit.parameters[rows[i]];
    const ParameterInterval& known = inference.parameters[rows[i]];
    const double factor = std::pow(way, parameter.way_power) * std::pow(time, parameter.time_power);
    // the end of the interval that is farther from 0 moves most
    const double farthest = std::abs(known.value) + known.HalfWidth();
    moves[static_cast<Eigen::Index>(i)] = (factor - 1) * std::copysign(farthest, known.value);
  }
  return moves;
}

}  // namespace

void AddUndetectedBias(const FittedModel& model, const LogSamples& m, const Bins& bins,
                       const Circumstances& known, Index p, const ForceMoves& fit,
                       Examination& examination) {
  // all forces: the start, curves, what follows the speed late, drifts that are 0 at first, and a sensor's gain
  const HeatingForces& heating = known.heating;
  const VectorXd force = known.torque - known.residual;
  const Index starts = known.initial.cols(), late = known.late_speeds.cols();
  const Index curve = starts, memory = curve + 2, drift = memory + late, gain = drift + kCourses;
  MatrixXd forces(bins.size(), gain + 1);
  forces << known.initial, heating.bend, Curve(m, bins), known.late_speeds, heating.drifts,
      force.cwiseProduct(bins.time);
  const OpenFactors open(fit, known.residual, forces);
  const MatrixXd moves = fit.By(forces).topRows(p);

  // starts that were not cold
  if (starts > 0) {
    const Possible warm{std::min(model.energy.minCoeff(), 0.0),
                        std::max(model.energy.maxCoeff(), 0.0)};
    VectorXd energies(starts);
    for (Index i = 0; i < starts; ++i) energies[i] = open.Interval(i, warm).FarEnd();
    Index farthest;
    energies.cwiseAbs().maxCoeff(&farthest);
    examination.Add(Source::open_start, Action::note, moves.leftCols(starts) * energies,
                    energies[farthest]);
  }

  // a law that bends over the speed, or follows it late
  const double fastest = bins.velocity.cwiseAbs().maxCoeff(), friction = examination.friction;
  const auto note = [&](Source source, Index first, Index count, double most) {
    if (count == 0) return;
    examination.Add(source, Action::note,
                    Farthest(moves.middleCols(first, count), FarEnds(open, first, count, most)));
  };
  note(Source::open_curve, curve, 2, friction / (fastest * fastest));
  note(Source::open_memory, memory, late, friction / fastest);

  // friction, or a sensor, that drifts for another reason than its losses: as seen from the first moment
  VectorXd factors(kCourses + 1);
  factors << FarEnds(open, drift, kCourses, friction), FarEnds(open, gain, 1, 1);
  const MatrixXd from_first = moves.rightCols(kCourses + 1);
  // and from the last, where the force of the end is taken off
  MatrixXd ends(bins.size(), 2);
  ends << heating.level, force;
  const MatrixXd at_end = fit.By(ends).topRows(p);
  MatrixXd until_last = from_first;
  until_last.leftCols(kCourses).colwise() -= at_end.col(0);
  until_last.col(kCourses) -= at_end.col(1);
  examination.Add(Source::open_drift, Action::note,
                  Farthest(from_first, factors).cwiseMax(Farthest(until_last, factors)));
}

void AddOtherUnits(const Fit& fit, const Inference& inference, JointKind joint,
                   Examination& examination) {
  if (joint == JointKind::rotary) {
    examination.Add(Source::degrees, Action::note,
                    FarthestMoves(kDegree, 1, fit, inference, examination.rows));
  }
  examination.Add(Source::clock, Action::note,
                  FarthestMoves(1, kClock, fit, inference, examination.rows));
}

}  // namespace warmjoint
