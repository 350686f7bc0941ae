#include "identification/lack_of_fit/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/lack_of_fit/orthonormal.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kWarmStart =
    0.1;                         // of the warmth that the joint reaches; why: cold_start asks that
constexpr double kDrift = 0.01;  // of the friction, over the log; why: no_slow_drift asks that
constexpr double kAlike =
    1e-13;  // beside other columns, of norm 1; why: what rounding leaves of a column that is a mix
constexpr double kSure = 5;      // deviations of the heat's share from a value that is ruled out
constexpr double kSureMove = 3;  // deviations from which a move is there; why 3: 1 in 370
constexpr double kFading = 1.0 / 3;  // of the log: time constant of a drift that dies away

/// s t and s (1 - exp(-t/T)), the friction's drift over the log, even and fading. [m x 2]
Eigen::MatrixXd Drifts(const Bins& bins) {
  const Eigen::ArrayXd sign = bins.velocity.array().sign(), t = bins.time.array();
  Eigen::MatrixXd drifts(bins.size(), 2);
  drifts << (sign * t).matrix(),
      (sign * (1 - (-t / kFading).exp()) / (1 - std::exp(-1 / kFading))).matrix();
  return drifts;
}

}  // namespace

ForceMoves::ForceMoves(const Bins& bins, const Eigen::MatrixXd& derivatives)
    : root_(bins.weight.cwiseSqrt()) {
  // columns of norm 1, so that units do not count
  const Eigen::MatrixXd weighted = root_.asDiagonal() * derivatives;
  const Eigen::VectorXd scale =
      weighted.colwise().norm().transpose().unaryExpr([](double x) { return x > 0 ? 1 / x : 1; });
  Basis made = Orthonormal(weighted * scale.asDiagonal(), kAlike);
  basis_ = std::move(made.basis);
  mix_ = scale.asDiagonal() * made.mix;
}

Eigen::MatrixXd ForceMoves::By(const Eigen::MatrixXd& forces) const {
  const Eigen::MatrixXd shared = basis_.transpose() * (root_.asDiagonal() * forces);
  return -mix_ * shared;
}

FrictionChange::FrictionChange(const FittedModel& model, const Bins& bins,
                               const Eigen::MatrixXd& derivatives, double friction)
    : root_(bins.weight.cwiseSqrt() / (friction * std::sqrt(bins.weight.sum()))),
      warm_(derivatives.leftCols(model.of_friction)),
      cold_(bins.Means(model.cold)) {}

double FrictionChange::By(const Eigen::VectorXd& changes) const {
  const Eigen::VectorXd along = warm_ * changes.head(warm_.cols());
  const Eigen::VectorXd cold = cold_ * changes.head(cold_.cols());
  const auto share = [&](const Eigen::VectorXd& force) { return root_.cwiseProduct(force).norm(); };
  return std::max({share(along), share(cold), share(along - cold)});
}

Eigen::MatrixXd DerivativesOver(const Bins& bins, const FittedModel& model) {
  const Eigen::MatrixXd derivatives = bins.Means(model.derivatives);
  return model.held_loss ? ConcatColumns(derivatives, bins.Means(*model.held_loss)) : derivatives;
}

void AddHeldLosses(const FittedModel& model, const Bins& bins, Index p,
                   const Eigen::MatrixXd& derivatives, Examination& examination) {
  if (!model.held_loss) return;
  // the force that held losses leave out is the last column
  const Index q = derivatives.cols() - 1;
  const ForceMoves moves(bins, derivatives.leftCols(q));
  const Eigen::VectorXd bias = moves.By(derivatives.rightCols(1)).topRows(p);

  // the share of that force in the residual
  const Eigen::VectorXd root = bins.weight.cwiseSqrt();
  const Eigen::MatrixXd weighted = root.asDiagonal() * derivatives;
  const Eigen::VectorXd residual = root.asDiagonal() * bins.Means(model.residual);
  const LeastSquares fit = SolveLeastSquares(weighted, residual);
  const Index free = bins.size() - q - 1;
  Action action = Action::cover;
  if (fit.mixed.empty() && free >= 1) {
    const double variance =
        (residual - weighted * fit.solution).squaredNorm() / static_cast<double>(free);
    const double share = fit.solution[q], deviation = std::sqrt(variance * fit.cofactor(q, q));
    const auto is_at = [&](double value) {
      return std::abs(share - value) < kSureMove * deviation;
    };
    // losses are held over each step, as the fit has them
    if (1 - share > kSure * deviation && is_at(0)) return;
    // or they follow the heat: the numbers become theirs; else both are possible
    if (share > kSure * deviation && is_at(1)) action = Action::shift;
  }
  examination.Add(Source::held_losses, action, bias);
}

void AddAssumptions(const Fit& fit, const FittedModel& model, const Bins& bins,
                    const Circumstances& known, Index p, const Eigen::MatrixXd& derivatives,
                    const ForceMoves& moves, Examination& examination) {
  // starts that were not cold, all alike
  if (known.initial.cols() > 0) {
    const double energy = kWarmStart * model.energy.cwiseAbs().maxCoeff();
    const Eigen::VectorXd force = energy * known.initial.rowwise().sum();
    examination.Add(Source::cold_start, Action::note, moves.By(force).topRows(p));
  }

  // friction that drifts for another reason than its losses
  const Eigen::MatrixXd by_drifts =
      moves.By(kDrift * examination.friction * Drifts(bins)).topRows(p);
  examination.Add(Source::slow_drift, Action::note, by_drifts.cwiseAbs().rowwise().maxCoeff());

  // a torque sensor that swallows what is small
  const double band = known.torque.cwiseAbs().minCoeff();
  const Eigen::VectorXd swallowed = -band * bins.velocity.array().sign();
  examination.Add(Source::dead_band, Action::note, moves.By(swallowed).topRows(p), band);

  // heat that came or went in gaps of the log
  const Index jumps = model.jump_spread.size();
  if (jumps == 0 || !fit.jump_samples.empty()) return;
  const Eigen::MatrixXd forces = derivatives.middleCols(p, jumps) * model.jump_spread.asDiagonal();
  const ForceMoves without_jumps(bins, derivatives.leftCols(p));
  examination.Add(Source::gaps, Action::widen, without_jumps.By(forces).cwiseAbs().rowwise().sum());
}

}  // namespace warmjoint
