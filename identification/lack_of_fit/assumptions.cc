#include "identification/lack_of_fit/assumptions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/lack_of_fit/table.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWarmStart =
    0.1;  // of the largest |E| of the log; why: the assumption cold_start states that
// of the friction, over the log; why: the assumption no_slow_drift states that
constexpr double kDrift = 0.01;
constexpr double kOffset =
    0.1;  // of the friction; why: a sensor's zero is trimmed to some per cent of its reading
constexpr double kSure = 5;  // deviations of the heat's share from a value that is ruled out
// deviations from a value beyond which a share differs from it; why 3: 1 in 370
constexpr double kSureMove = 3;
constexpr double kFadesAfter = 1.0 / 3;  // of the log: time constant of a drift that dies away
// of a column orthogonal to the fit, below which the log shows nothing
constexpr double kTold = 1e-6;

/// held_losses
void AddHeldLosses(const OverBins& over, Examination& examination) {
  if (!over.model.held_loss) return;
  // the force that held losses leave out is the last column
  const Index q = over.derivatives.cols() - 1;
  const WeighedFit without(over.bins.weight, over.derivatives.leftCols(q));
  const VectorXd bias = without.BiasBy(over.derivatives.rightCols(1));

  // the share of that force in the residual
  const MatrixXd weighted = over.fit.Weighed(over.derivatives);
  const VectorXd residual = over.fit.Weighed(over.circumstances.residual);
  const LeastSquares fit = SolveLeastSquares(weighted, residual);
  const Index free = over.bins.size() - q - 1;
  Action action = Action::cover;
  if (fit.mixed.empty() && free >= 1) {
    const double variance =
        (residual - weighted * fit.solution).squaredNorm() / static_cast<double>(free);
    const double share = fit.solution[q], deviation = std::sqrt(variance * fit.cofactor(q, q));
    const auto is_at = [&](double value) {
      return std::abs(share - value) < kSureMove * deviation;
    };
    // the residual shows that losses are held over each step, as the fit takes them
    if (1 - share > kSure * deviation && is_at(0)) return;
    // or that they follow the heat, so that the numbers are shifted by the bias; else both are possible
    if (share > kSure * deviation && is_at(1)) action = Action::shift;
  }
  examination.Add(Source::held_losses, action, bias);
}

/// The friction's drift over the log, s t that is linear and s (1 - exp(-t/T)) that dies away. [m x 2]
MatrixXd Drifts(const Bins& bins) {
  const Eigen::ArrayXd sign = bins.velocity.array().sign(), t = bins.time.array();
  MatrixXd drifts(bins.size(), 2);
  drifts << (sign * t).matrix(),
      (sign * (1 - (-t / kFadesAfter).exp()) / (1 - std::exp(-1 / kFadesAfter))).matrix();
  return drifts;
}

/// cold_start, slow_drift, dead_band, offset, gaps
void AddGiven(const OverBins& over, const Fit& fit, Examination& examination) {
  const auto& [model, m, bins, derivatives, beside, circumstances] = over;
  // starts that were not cold, all equally warm
  if (circumstances.initial.cols() > 0) {
    const double energy = kWarmStart * model.energy.cwiseAbs().maxCoeff();
    const VectorXd force = energy * circumstances.initial.rowwise().sum();
    examination.Add(Source::cold_start, Action::note, beside.BiasBy(force));
  }

  // friction that drifts for another reason than its losses
  const MatrixXd by_drifts = beside.BiasBy(kDrift * examination.friction * Drifts(bins));
  examination.Add(Source::slow_drift, Action::note, by_drifts.cwiseAbs().rowwise().maxCoeff());

  // a torque sensor that reads 0 for small torques
  const double band = circumstances.torque.cwiseAbs().minCoeff();
  const VectorXd swallowed = -band * bins.velocity.array().sign();
  examination.Add(Source::dead_band, Action::note, beside.BiasBy(swallowed), band);

  // an offset, which in one direction looks like friction
  if (bins.velocity.minCoeff() > 0 || bins.velocity.maxCoeff() < 0) {
    const double offset = kOffset * examination.friction;
    examination.Add(Source::offset, Action::widen,
                    beside.BiasBy(VectorXd::Constant(bins.size(), offset)), offset);
  }

  // heat that came or went in gaps of the log
  const Index jumps = model.jump_spread.size(), p = std::ssize(examination.rows);
  if (jumps == 0 || !fit.start.jump_samples.empty()) return;
  const MatrixXd forces = derivatives.middleCols(p, jumps) * model.jump_spread.asDiagonal();
  const WeighedFit without_jumps(bins.weight, derivatives.leftCols(p));
  examination.Add(Source::gaps, Action::widen,
                  without_jumps.BiasBy(forces).cwiseAbs().rowwise().sum());
}

/// The bounds of a factor's possible values.
struct Possible {
  double least, most;

  /// The end that is farther from 0.
  double FarEnd() const { return std::abs(least) > std::abs(most) ? least : most; }
};

/// The half width of a factor's interval in standard errors, at the level of one test among all tests of the log.
double Quantile(double degrees_of_freedom) {
  return StudentQuantile(degrees_of_freedom,
                         1 - kErrorLevel / static_cast<double>(LackOfFitTests().size()));
}

/// The factors of forces that the tests of the log cannot rule out. Each force is added to the fit by itself.
class OpenFactors {
 public:
  /// residual: [m] means over bins; forces: [m x q] means over bins
  OpenFactors(const WeighedFit& fit, const VectorXd& residual, const MatrixXd& forces)
      : fit_(fit), left_(fit.Weighed(residual)), own_(fit.Weighed(forces)) {
    weighted_ = own_.colwise().squaredNorm();
    fit.TakeOff(left_);
    fit.TakeOff(own_);
    const Index degrees_of_freedom = left_.size() - fit.qr.basis.cols() - 1;
    if (degrees_of_freedom < 1) return;
    white_degrees_of_freedom_ = static_cast<double>(degrees_of_freedom);
    white_quantile_ = Quantile(white_degrees_of_freedom_);
  }

  /// The interval of the i-th factor at the level of the log's tests, within what is possible.
  Possible Interval(Index i, const Possible& possible) const {
    // where the log cannot distinguish the force from the fit, every factor that is possible at all remains
    const auto own = own_.col(i);
    const double square = own.squaredNorm();
    const bool told = square > kTold * kTold * weighted_[i];
    if (!fit_.IsFullRank() || !told) return possible;

    // the force joins the fit for one step of least squares, whose other columns are a basis of the fit's
    const double factor = own.dot(left_) / square;
    const MatrixXd& basis = fit_.qr.basis;
    const Index p = basis.cols();
    MatrixXd cofactor = MatrixXd::Identity(p + 1, p + 1);
    cofactor(p, p) = 1 / square;
    const Uncertainty uncertainty =
        CovarianceOf({.rows = RowsFrom([&] { return ConcatColumns(basis, own); }),
                      .cofactor = cofactor,
                      .residual = left_ - factor * own,
                      .selection = AllOf(own.size())});

    // the half width of the interval by noise at that level
    const double quantile = uncertainty.degrees_of_freedom == white_degrees_of_freedom_
                                ? white_quantile_
                                : Quantile(uncertainty.degrees_of_freedom);
    const double reach = quantile * uncertainty.Deviation(p);
    const auto within = [&](double c) { return std::clamp(c, possible.least, possible.most); };
    return {within(factor - reach), within(factor + reach)};
  }

 private:
  const WeighedFit& fit_;
  VectorXd left_;      // [m] weighted, of the residual orthogonal to the fit
  MatrixXd own_;       // [m x q] weighted, of the forces orthogonal to the fit
  VectorXd weighted_;  // [q] squares of the forces
  // those of most forces: where the residual that they leave is white
  double white_degrees_of_freedom_ = 0, white_quantile_ = 0;
};

/// s v^2, without heat. [m x 1]
MatrixXd Curve(const LogSamples& m, const Bins& bins) {
  return bins.Means(m.velocity.cwiseProduct(m.velocity.cwiseAbs()));
}

/// The end that is farther from 0 of each factor's interval within -most to most. [count]
VectorXd FarEnds(const OpenFactors& open, Index first, Index count, double most) {
  VectorXd ends(count);
  for (Index i = 0; i < count; ++i) ends[i] = open.Interval(first + i, {-most, most}).FarEnd();
  return ends;
}

/// The most that any of some forces biases each parameter. moves: [p x q] the biases by a factor of 1; factors: [q]
VectorXd Farthest(const MatrixXd& moves, const VectorXd& factors) {
  return (moves * factors.asDiagonal()).cwiseAbs().rowwise().maxCoeff();
}

/// open_start, open_curve, open_memory, open_drift
void AddOpen(const OverBins& over, const Fit& fitted, Examination& examination) {
  const auto& [model, m, bins, derivatives, fit, circumstances] = over;
  // all forces: the start, curves, friction that follows the speed late, drifts that are 0 at first, and a sensor's gain
  const HeatingForces& heating = circumstances.heating;
  const VectorXd force = circumstances.torque - circumstances.residual;
  const Index starts = circumstances.initial.cols(), late = circumstances.late_speeds.cols();
  const Index curve = starts, memory = curve + 2, drift = memory + late, gain = drift + kDrifts;
  MatrixXd forces(bins.size(), gain + 1);
  forces << circumstances.initial, heating.bend, Curve(m, bins), circumstances.late_speeds,
      heating.drifts, force.cwiseProduct(bins.time);
  const OpenFactors open(fit, circumstances.residual, forces);
  const MatrixXd moves = fit.BiasBy(forces);

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

  // a law that is curved over the speed, or follows it late
  const double fastest = bins.velocity.cwiseAbs().maxCoeff(), friction = examination.friction;
  const auto note = [&](Source source, Index first, Index count, double most) {
    if (count == 0) return;
    examination.Add(source, Action::note,
                    Farthest(moves.middleCols(first, count), FarEnds(open, first, count, most)));
  };
  if (!HasField(fitted, FieldKind::speed_friction))
    note(Source::open_curve, curve, 2, friction / (fastest * fastest));
  note(Source::open_memory, memory, late, friction / fastest);

  if (HasField(fitted, FieldKind::time_friction)) return;
  // friction, or a sensor, that drifts for another reason than its losses: relative to the first moment
  VectorXd factors(kDrifts + 1);
  factors << FarEnds(open, drift, kDrifts, friction), FarEnds(open, gain, 1, 1);
  const MatrixXd from_first = moves.rightCols(kDrifts + 1);
  // and relative to the last, where the force at the end is subtracted
  MatrixXd ends(bins.size(), 2);
  ends << heating.level, force;
  const MatrixXd at_end = fit.BiasBy(ends);
  MatrixXd until_last = from_first;
  until_last.leftCols(kDrifts).colwise() -= at_end.col(0);
  until_last.col(kDrifts) -= at_end.col(1);
  // each force by itself, with its bias of all parameters together
  for (Index i = 0; i < factors.size(); ++i) {
    examination.Add(Source::open_drift, Action::note, factors[i] * from_first.col(i));
    examination.Add(Source::open_drift, Action::note, factors[i] * until_last.col(i));
  }
}

constexpr double kTurn = 2 * std::numbers::pi, kDegree = kTurn / 360;  // rad
// times its right speed; why: the assumption is about a slip of that size
constexpr double kClock = 1.01;

/// The most that an end of each interval changes. [p]
Eigen::VectorXd FarthestMoves(double displacement, double time, const Fit& fit,
                              const Inference& inference, const std::vector<size_t>& rows) {
  Eigen::VectorXd moves(static_cast<Eigen::Index>(rows.size()));
  for (size_t i = 0; i < rows.size(); ++i) {
    const Unknown& parameter = fit.parameters[rows[i]];
    const ParameterInterval& estimated = inference.parameters[rows[i]];
    const double factor =
        std::pow(displacement, parameter.displacement_power) * std::pow(time, parameter.time_power);
    // the end of the interval that is farther from 0 changes most
    const double farthest = std::abs(estimated.value) + estimated.HalfWidth();
    moves[static_cast<Eigen::Index>(i)] = (factor - 1) * std::copysign(farthest, estimated.value);
  }
  return moves;
}

/// degrees, clock
void AddOtherUnits(const Fit& fit, const Inference& inference, JointKind joint,
                   Examination& examination) {
  if (joint == JointKind::rotary) {
    const VectorXd degrees = FarthestMoves(kDegree, 1, fit, inference, examination.rows),
                   turns = FarthestMoves(kTurn, 1, fit, inference, examination.rows);
    examination.Add(Source::degrees, Action::note,
                    (degrees.cwiseAbs().array() < turns.cwiseAbs().array()).select(turns, degrees));
  }
  examination.Add(Source::clock, Action::note,
                  FarthestMoves(1, kClock, fit, inference, examination.rows));
}

}  // namespace

void AddAssumptions(const OverBins& over, const Fit& fit, const Inference& by_noise,
                    Examination& examination) {
  AddHeldLosses(over, examination);
  AddGiven(over, fit, examination);
  AddOpen(over, fit, examination);
  AddOtherUnits(fit, by_noise, over.measurements.joint, examination);
}

}  // namespace warmjoint
