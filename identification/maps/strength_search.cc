#include "identification/maps/strength_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "identification/ridge/local_ridge.h"

namespace warmjoint {
namespace {

constexpr int kStrengths = 20;  // why: up to 300 times the mean diagonal, where nothing is left
constexpr int kStride = 4;      // why 4: two decades, within which the error has one valley

/// Of the parameters, in the fit to all rows.
class Bounds {
 public:
  Bounds(const NormalEquations& all, Eigen::Index free, const std::vector<double>& lower)
      : lower_(lower) {
    const auto bounds = [](double bound) { return std::isfinite(bound); };
    if (std::ranges::any_of(lower, bounds)) ridge_.emplace(all, free);
  }

  /// Whether the fit with a strength leaves them.
  bool HoldWith(double strength) {
    if (!ridge_) return true;
    const std::optional<Eigen::VectorXd> x = ridge_->Solve(strength);
    if (!x) return false;
    for (size_t i = 0; i < lower_.size(); ++i) {
      if (!((*x)[static_cast<Eigen::Index>(i)] >= lower_[i])) return false;
    }
    return true;
  }

 private:
  const std::vector<double>& lower_;
  std::optional<LocalRidge> ridge_;  // where there is a bound
};

/// The error over the strengths, evaluated where it is asked for.
class Curve {
 public:
  Curve(const std::vector<NormalEquations>& parts, const NormalEquations& all, Eigen::Index free,
        const std::vector<double>& lower)
      : strengths_(Strengths(all, free)), bounds_(all, free, lower) {
    parts_.reserve(parts.size());
    for (const NormalEquations& part : parts) parts_.emplace_back(part, all, free);
  }

  const StrengthTrial& At(int i) {
    const auto known = trials_.find(i);
    if (known != trials_.end()) return known->second;
    // squares of each part under the fit to all others
    StrengthTrial trial{strengths_[static_cast<size_t>(i)], true, {}};
    trial.squares.resize(static_cast<Eigen::Index>(parts_.size()));
    for (size_t k = 0; k < parts_.size(); ++k) {
      trial.squares[static_cast<Eigen::Index>(k)] = parts_[k].Squares(trial.strength);
    }
    trial.possible = trial.squares.allFinite() && bounds_.HoldWith(trial.strength);
    return trials_.emplace(i, std::move(trial)).first->second;
  }

  /// Whether i is better than j: possible where the other is not, or of less error.
  bool Better(int i, int j) {
    const StrengthTrial &one = At(i), &other = At(j);
    if (one.possible != other.possible) return one.possible;
    return one.squares.sum() < other.squares.sum();
  }

  std::vector<StrengthTrial> Solved() const {
    std::vector<StrengthTrial> solved;
    for (const auto& [i, trial] : trials_) {
      if (trial.squares.allFinite()) solved.push_back(trial);
    }
    return solved;
  }

 private:
  std::vector<double> strengths_;
  Bounds bounds_;
  std::vector<HeldOutPart> parts_;
  std::map<int, StrengthTrial> trials_;
};

}  // namespace

std::vector<double> Strengths(const NormalEquations& normal, Eigen::Index free) {
  const double scale = normal.gram.diagonal().tail(normal.product.size() - free).mean();
  std::vector<double> strengths;
  for (int i = 0; i < kStrengths; ++i) strengths.push_back(scale * std::pow(10, -7 + 0.5 * i));
  return strengths;
}

bool AsGood(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& best) {
  const Eigen::ArrayXd worse = squares - best;
  const auto parts = static_cast<double>(worse.size());
  const double deviation = std::sqrt((worse - worse.mean()).square().sum() / (parts - 1));
  return worse.sum() <= std::sqrt(parts) * deviation;
}

std::vector<StrengthTrial> SearchStrengths(const std::vector<NormalEquations>& parts,
                                           const NormalEquations& all, Eigen::Index free,
                                           const std::vector<double>& lower) {
  Curve curve(parts, all, free, lower);

  // every fourth up to the strongest, then downhill from the best of them
  int best = kStrengths - 1;
  for (int i = best - kStride; i >= 0; i -= kStride) {
    if (curve.Better(i, best)) best = i;
  }
  for (const int step : {-1, 1}) {
    while (best + step >= 0 && best + step < kStrengths && curve.Better(best + step, best)) {
      best += step;
    }
  }

  // stronger ones, up to the first that is not as good
  for (int i = best + 1; i < kStrengths; ++i) {
    if (!AsGood(curve.At(i).squares, curve.At(best).squares)) break;
  }
  return curve.Solved();
}

}  // namespace warmjoint
