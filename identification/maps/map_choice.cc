#include "identification/maps/map_choice.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/maps/imitated_columns.h"
#include "identification/ridge/local_ridge.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kStrengths = 20;  // why: up to 300 times the mean diagonal, where nothing is left

// why several: a joint warms up but once; with 12, one load map moves by a third of its half width
constexpr Eigen::Index kSpans = 8;  // of each fold, of maps over the energy

/// Half decades from 1e-7 of the mean diagonal of the kernels' Gram matrix.
std::vector<double> Strengths(const NormalEquations& normal, Eigen::Index free) {
  const double scale = normal.gram.diagonal().tail(normal.product.size() - free).mean();
  std::vector<double> strengths;
  for (int i = 0; i < kStrengths; ++i) strengths.push_back(scale * std::pow(10, -7 + 0.5 * i));
  return strengths;
}

/// One candidate with one strength.
struct Trial {
  size_t candidate = 0;
  double strength = 0;
  Eigen::Index kernels = 0;
  bool possible = true;    // whether all parameters are above their lower bounds
  Eigen::ArrayXd squares;  // [parts] held out, (N.m)^2 or N^2
};

/// Whether the errors are those of the best within one standard error of the parts' differences.
bool AsGood(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& best) {
  const Eigen::ArrayXd worse = squares - best;
  const auto parts = static_cast<double>(worse.size());
  const double deviation = std::sqrt((worse - worse.mean()).square().sum() / (parts - 1));
  return worse.sum() <= std::sqrt(parts) * deviation;
}

/// Whether the fit to all rows leaves the parameters above their bounds.
bool IsPossible(LocalRidge& ridge, double strength, const std::vector<double>& lower) {
  if (lower.empty()) return true;
  const std::optional<Eigen::VectorXd> x = ridge.Solve(strength);
  if (!x) return false;
  for (size_t i = 0; i < lower.size(); ++i) {
    if (!((*x)[static_cast<Eigen::Index>(i)] >= lower[i])) return false;
  }
  return true;
}

bool IsOverEnergy(const std::vector<FrictionMap>& maps) {
  return std::any_of(maps.begin(), maps.end(), [](const FrictionMap& map) {
    return std::any_of(map.axes.begin(), map.axes.end(),
                       [](const MapAxis& axis) { return axis.quantity == MapQuantity::energy; });
  });
}

/// The normal equations of each fold: one part of the recording, or, since a joint warms up but
/// once, of maps over the energy kSpans shorter ones that lie a fold's turn apart.
std::vector<NormalEquations> Folds(const MapProblem& problem, int folds) {
  const Eigen::Index n = problem.torque.size();
  const Eigen::Index spans = folds * (IsOverEnergy(problem.maps) ? kSpans : 1);
  const bool made = problem.rows && problem.rows->spans() == spans;
  std::vector<NormalEquations> parts;
  for (Eigen::Index i = 0; i < spans; ++i) {
    const NormalEquations span =
        made ? problem.rows->Normal(i, problem.free, problem.torque)
             : LocalNormal(problem.maps, problem.points, problem.free, problem.torque,
                           i * n / spans, (i + 1) * n / spans);
    if (i < folds) {
      parts.push_back(span);
    } else {
      NormalEquations& part = parts[static_cast<size_t>(i % folds)];
      part = part.Plus(span);
    }
  }
  return parts;
}

/// What kernels can imitate of the law, at the law's own least squares: a prior alone would share it out anew in
/// each part, and weak ones let it run far off.
struct HeldLaw {
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd values;
  std::vector<double> lower;  // of the other parameters without a prior

  HeldLaw(const NormalEquations& all, Eigen::Index free, const std::vector<double>& bounds)
      : columns(ImitatedLaw(all.gram, free, bounds)), lower(bounds) {
    const Eigen::VectorXd law =
        all.gram.topLeftCorner(free, free).ldlt().solve(all.product.head(free));
    values = law(columns);
    for (size_t i = columns.size(); i-- > 0;) {
      const auto j = static_cast<size_t>(columns[i]);
      double& value = values[static_cast<Eigen::Index>(i)];
      value = std::max(value, bounds[j]);
      lower.erase(lower.begin() + columns[i]);
    }
  }
};

/// The trials of problem.maps by cross validation, the strongest prior last.
void AddTrials(const MapProblem& problem, size_t candidate, int folds, std::vector<Trial>& trials) {
  std::vector<NormalEquations> parts = Folds(problem, folds);
  NormalEquations all = parts[0];
  for (size_t i = 1; i < parts.size(); ++i) all = all.Plus(parts[i]);
  const HeldLaw held(all, problem.free.cols(), problem.lower);
  const Eigen::Index free = problem.free.cols() - held.values.size();
  for (NormalEquations& part : parts) part = part.Holding(held.columns, held.values);
  all = all.Holding(held.columns, held.values);
  const std::vector<double> strengths = Strengths(all, free);
  const Eigen::MatrixXd squares = HeldOutSquares(parts, free, strengths);
  LocalRidge whole(all, free);
  for (size_t i = 0; i < strengths.size(); ++i) {
    const Eigen::ArrayXd row = squares.row(static_cast<Eigen::Index>(i));
    if (!row.allFinite()) continue;
    trials.push_back({candidate, strengths[i], KernelCount(problem.maps),
                      IsPossible(whole, strengths[i], held.lower), row});
  }
}

/// Kernels of the finest candidates, and of the next finest ones; 0 where there are none.
struct Finest {
  Eigen::Index kernels = 0, next = 0;

  explicit Finest(const std::vector<std::vector<FrictionMap>>& candidates) {
    for (const auto& maps : candidates) kernels = std::max(kernels, KernelCount(maps));
    for (const auto& maps : candidates) {
      const Eigen::Index count = KernelCount(maps);
      if (count < kernels) next = std::max(next, count);
    }
  }
};

ChosenMaps Nothing() { return {0, 0, std::numeric_limits<double>::infinity()}; }

const Trial& LeastError(const std::vector<Trial>& trials) {
  return *std::min_element(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    return a.squares.sum() < b.squares.sum();
  });
}

/// The simplest of the trials that are as good as the best.
ChosenMaps Simplest(std::vector<Trial> trials, Eigen::Index samples) {
  if (std::any_of(trials.begin(), trials.end(), [](const Trial& t) { return t.possible; })) {
    std::erase_if(trials, [](const Trial& t) { return !t.possible; });
  }
  if (trials.empty()) return Nothing();
  const Eigen::ArrayXd least = LeastError(trials).squares;
  std::erase_if(trials, [&](const Trial& t) { return !AsGood(t.squares, least); });

  // the fewest kernels, the best of their shapes, its strongest prior
  Eigen::Index fewest = trials[0].kernels;
  for (const Trial& trial : trials) fewest = std::min(fewest, trial.kernels);
  std::erase_if(trials, [&](const Trial& t) { return t.kernels > fewest; });
  const size_t candidate = LeastError(trials).candidate;
  std::erase_if(trials, [&](const Trial& t) { return t.candidate != candidate; });
  const Trial& chosen = trials.back();
  return {candidate, chosen.strength, chosen.squares.sum() / static_cast<double>(samples)};
}

/// Strength and criterion of problem.maps by leaving out one sample at a time.
ChosenMaps ByLeavingOut(const MapProblem& problem) {
  const NormalEquations normal = NormalOf(problem);
  const std::vector<RowGroup> groups =
      GroupRows(problem.maps, problem.points, 0, problem.torque.size());
  ChosenMaps best = Nothing();
  for (const double strength : Strengths(normal, problem.free.cols())) {
    const double error = LeaveOneOut(groups, problem.free, problem.torque, normal, strength);
    if (error < best.criterion) best = {0, strength, error};
  }
  return best;
}

ChosenMaps ByEvidence(const MapProblem& problem) {
  const NormalEquations normal = NormalOf(problem);
  const Evidence evidence = MaximiseEvidence(normal, problem.free.cols());
  const double highest = Strengths(normal, problem.free.cols()).back();
  const double strength = evidence.strength();
  const double criterion = -2 * evidence.log_evidence / static_cast<double>(normal.rows);
  // without any sign of the kernels it grows without bounds
  if (!std::isfinite(criterion) || !(strength < highest)) {
    return {0, highest, std::isfinite(criterion) ? criterion : 0};
  }
  return {0, strength, criterion};
}

}  // namespace

ChosenMaps ChooseMaps(MapProblem problem, const std::vector<std::vector<FrictionMap>>& candidates,
                      StrengthRule rule, int folds) {
  std::vector<Trial> trials;
  ChosenMaps best = Nothing();
  const Finest finest(candidates);
  for (size_t i = 0; i < candidates.size(); ++i) {
    problem.maps = candidates[i];
    if (rule == StrengthRule::cross_validation) {
      const bool dear = KernelCount(candidates[i]) == finest.kernels && !trials.empty();
      if (dear && LeastError(trials).kernels < finest.next) continue;
      AddTrials(problem, i, folds, trials);
      continue;
    }
    ChosenMaps chosen =
        rule == StrengthRule::evidence ? ByEvidence(problem) : ByLeavingOut(problem);
    chosen.candidate = i;
    if (chosen.criterion < best.criterion) best = chosen;
  }
  return rule == StrengthRule::cross_validation ? Simplest(std::move(trials), problem.torque.size())
                                                : best;
}

}  // namespace warmjoint::inline identification
