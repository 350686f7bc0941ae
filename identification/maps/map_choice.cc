#include "identification/maps/map_choice.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "identification/maps/local_rows.h"
#include "identification/model/normal_equations.h"
#include "identification/model/ridge.h"

namespace warmjoint {
namespace {

/// The result of cross validation for one strength.
struct StrengthTrial {
  double strength = 0;
  bool possible = true;    // whether the fit to all rows leaves all parameters above their bounds
  Eigen::ArrayXd squares;  // [parts] held out, (N.m)^2 or N^2
};

constexpr int kStrengths = 20;  // why: up to 300 times the mean diagonal, where nothing is left
constexpr int kStride = 4;      // why 4: two decades, within which the error has one valley

/// Strengths s of a prior: 20 in steps of half a decade, from 1e-7 of the mean diagonal of the kernels' Gram matrix
/// on. free: leading columns without a prior.
std::vector<double> Strengths(const NormalEquations& normal, Eigen::Index free) {
  const double scale = normal.gram.diagonal().tail(normal.product.size() - free).mean();
  std::vector<double> strengths;
  for (int i = 0; i < kStrengths; ++i) strengths.push_back(scale * std::pow(10, -7 + 0.5 * i));
  return strengths;
}

/// The lower bounds of the parameters, in the fit to all rows.
class LowerBounds {
 public:
  LowerBounds(const NormalEquations& all, Eigen::Index free, const std::vector<double>& lower)
      : lower_(lower) {
    const auto bounds = [](double bound) { return std::isfinite(bound); };
    if (std::ranges::any_of(lower, bounds)) ridge_.emplace(all, free);
  }

  /// Whether the fit with a strength keeps within them.
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
  LowerBounds bounds_;
  std::vector<HeldOutPart> parts_;
  std::map<int, StrengthTrial> trials_;
};

/// Whether the errors are those of the best within one standard error of the parts' differences.
bool AsGood(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& best) {
  const Eigen::ArrayXd worse = squares - best;
  const auto parts = static_cast<double>(worse.size());
  const double deviation = std::sqrt((worse - worse.mean()).square().sum() / (parts - 1));
  return worse.sum() <= std::sqrt(parts) * deviation;
}

/// The strengths from which one is chosen, ascending: the one with the least error of those that are
/// possible, the stronger ones that are as good, and some others. The error has one valley over the
/// strengths, or several; every fourth strength then shows which is the deepest. Without those that are too small
/// to solve. parts: of the rows; lower: bounds of the free parameters, or empty: none.
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

// why several: a joint warms up but once; with 12, one load map changes by a third of its half width
constexpr Eigen::Index kSpans = 8;  // of each fold, of maps over the energy

/// One candidate with one strength.
struct Trial : StrengthTrial {
  size_t candidate = 0;
  Eigen::Index kernels = 0;
};

bool IsOverEnergy(const std::vector<FrictionMap>& maps) {
  return std::ranges::any_of(
      maps, [](const FrictionMap& map) { return FindAxis(map, MapQuantity::energy) != nullptr; });
}

/// The normal equations of each fold: one part of the recording, or, since a joint warms up but
/// once, for maps over the energy, kSpans shorter parts, between which lie parts of all other folds.
std::vector<NormalEquations> Folds(const MapProblem& problem, int folds) {
  const Eigen::Index n = problem.torque.size();
  const Eigen::Index spans = folds * (IsOverEnergy(problem.maps) ? kSpans : 1);
  const bool made = problem.rows && problem.rows->spans() == spans;
  std::vector<NormalEquations> parts;
  // products of each span, those of one fold added up
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

/// The columns of the law that kernels can imitate, held at the law's own least squares. Why: the prior would divide them
/// between law and maps in another way in each part, and with a weak prior their values become very large.
struct HeldLaw {
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd values;
  std::vector<double> lower;  // of the other parameters without a prior

  HeldLaw(const NormalEquations& all, Eigen::Index free, const std::vector<double>& bounds)
      : columns(ImitatedLaw(all.gram, free, bounds)), lower(bounds) {
    // the law that would fit alone, within its bounds
    const Eigen::VectorXd law =
        all.gram.topLeftCorner(free, free).ldlt().solve(all.product.head(free));
    values = law(columns);
    // held values stay within their bounds; the others keep their own
    for (size_t i = columns.size(); i-- > 0;) {
      const auto j = static_cast<size_t>(columns[i]);
      double& value = values[static_cast<Eigen::Index>(i)];
      value = std::max(value, bounds[j]);
      lower.erase(lower.begin() + columns[i]);
    }
  }
};

/// The trials of problem.maps by cross validation, the strongest prior last. Returns the normal equations
/// of all folds.
NormalEquations AddTrials(const MapProblem& problem, size_t candidate, int folds,
                          std::vector<Trial>& trials) {
  std::vector<NormalEquations> parts = Folds(problem, folds);
  NormalEquations all = parts[0];
  for (size_t i = 1; i < parts.size(); ++i) all = all.Plus(parts[i]);

  // the problem that is left with the law held
  const HeldLaw held(all, problem.free.cols(), problem.lower);
  const Eigen::Index free = problem.free.cols() - held.values.size();
  for (NormalEquations& part : parts) part = part.Holding(held.columns, held.values);
  const NormalEquations rest = all.Holding(held.columns, held.values);
  for (StrengthTrial& trial : SearchStrengths(parts, rest, free, held.lower)) {
    trials.push_back({std::move(trial), candidate, KernelCount(problem.maps)});
  }
  return all;
}

ChosenMaps Nothing() { return {0, 0, std::numeric_limits<double>::infinity(), {}}; }

const Trial& LeastError(const std::vector<Trial>& trials) {
  return *std::ranges::min_element(trials, {}, [](const Trial& one) { return one.squares.sum(); });
}

/// The simplest of the trials that are as good as the best.
ChosenMaps Simplest(std::vector<Trial> trials, Eigen::Index samples) {
  // trials without a bound that the fit would break, where there are any
  if (std::ranges::any_of(trials, &Trial::possible)) {
    std::erase_if(trials, [](const Trial& t) { return !t.possible; });
  }
  if (trials.empty()) return Nothing();
  // as good as the best
  const Eigen::ArrayXd least = LeastError(trials).squares;
  std::erase_if(trials, [&](const Trial& t) { return !AsGood(t.squares, least); });

  // the fewest kernels, the best of their shapes, its strongest prior
  const Eigen::Index fewest = std::ranges::min(trials, {}, &Trial::kernels).kernels;
  std::erase_if(trials, [&](const Trial& t) { return t.kernels > fewest; });
  const size_t candidate = LeastError(trials).candidate;
  std::erase_if(trials, [&](const Trial& t) { return t.candidate != candidate; });
  const Trial& chosen = trials.back();
  return {candidate, chosen.strength, chosen.squares.sum() / static_cast<double>(samples), {}};
}

/// Strength and criterion of problem.maps by leaving out one sample at a time.
ChosenMaps ByLeavingOut(const MapProblem& problem) {
  const NormalEquations normal = NormalOf(problem);
  const std::vector<RowGroup> groups =
      GroupRows(problem.maps, problem.points, 0, problem.torque.size());
  // the strength that best predicts samples which the fit has not seen
  ChosenMaps best = Nothing();
  for (const double strength : Strengths(normal, problem.free.cols())) {
    const double error = LeaveOneOut(groups, problem.free, problem.torque, normal, strength);
    if (error < best.criterion) best = {0, strength, error, {}};
  }
  best.normal = normal;
  return best;
}

ChosenMaps ByEvidence(const MapProblem& problem) {
  const NormalEquations normal = NormalOf(problem);
  const Evidence evidence = MaximiseEvidence(normal, problem.free.cols());
  const double highest = Strengths(normal, problem.free.cols()).back();
  const double strength = evidence.strength();
  const double criterion = -2 * evidence.log_evidence / static_cast<double>(normal.rows);
  // where nothing shows the kernels, it grows without bounds
  if (!std::isfinite(criterion) || !(strength < highest)) {
    return {0, highest, std::isfinite(criterion) ? criterion : 0, normal};
  }
  return {0, strength, criterion, normal};
}

}  // namespace

ChosenMaps ChooseMaps(MapProblem problem, const MapShapes& candidates, StrengthRule rule,
                      int folds) {
  // trials of all candidates, or the best candidate by a single number
  std::vector<Trial> trials;
  std::vector<std::optional<NormalEquations>> normals(candidates.size());
  ChosenMaps best = Nothing();
  // kernels of the finest candidates, and of the next finest ones, 0 where there are none
  std::set<Eigen::Index> sizes{0};
  for (const std::vector<FrictionMap>& maps : candidates) sizes.insert(KernelCount(maps));
  const Eigen::Index finest = *sizes.rbegin(), next = *std::next(sizes.rbegin());
  for (size_t i = 0; i < candidates.size(); ++i) {
    problem.maps = candidates[i];
    if (rule == StrengthRule::cross_validation) {
      // the finest shape costs most: it is tried where the next finest has been the best so far
      const bool dear = KernelCount(candidates[i]) == finest && !trials.empty();
      if (dear && LeastError(trials).kernels < next) continue;
      normals[i] = AddTrials(problem, i, folds, trials);
      continue;
    }
    // one number for the candidate at its own best strength
    ChosenMaps chosen =
        rule == StrengthRule::evidence ? ByEvidence(problem) : ByLeavingOut(problem);
    chosen.candidate = i;
    if (chosen.criterion < best.criterion) best = std::move(chosen);
  }
  if (rule != StrengthRule::cross_validation) return best;
  // cross validation takes the simplest of those that are as good as the best
  best = Simplest(std::move(trials), problem.torque.size());
  best.normal = std::move(normals[best.candidate]);
  return best;
}

}  // namespace warmjoint
