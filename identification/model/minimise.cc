#include "identification/model/minimise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/model/normal_equations.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Damping after the first step that did not lower the squares, as a share of the diagonal.
constexpr double kFirstDamping = 1e-3;

/// Share of the diagonal up to which steps are about the same as those without damping.
constexpr double kLight = 0.1;
/// The rounding error of a sum of 1e6 squares, as a share of it.
constexpr double kRounding = 1e-12;

/// How much the diagonal grows: more and more with each step that fails, less with each that lowers the squares as predicted,
/// by the rules of Madsen, Nielsen and Tingleff (Methods for non-linear least squares problems, 2004, 3.2).
class Damping {
 public:
  double share() const { return share_; }
  /// Whether a step is about the undamped one.
  bool IsLight() const { return share_ <= kLight; }
  /// ratio: of the fall of the squares to the predicted fall
  void AfterFall(double ratio) {
    share_ *= std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3));
    growth_ = 2;
  }
  void AfterRise() {
    share_ = std::max(kFirstDamping, growth_ * share_);
    growth_ *= 2;
  }

 private:
  double share_ = 0, growth_ = 2;
};

/// Unknowns at a bound that the squares push farther out.
std::vector<Index> PushedOut(const SquaresProblem& problem, const VectorXd& x,
                             const VectorXd& product) {
  std::vector<Index> pushed;
  if (problem.lower.size() == 0) return pushed;
  for (Index i = 0; i < x.size(); ++i) {
    const bool below = x[i] <= problem.lower[i] && product[i] < 0;
    if (below || (x[i] >= problem.upper[i] && product[i] > 0)) pushed.push_back(i);
  }
  return pushed;
}

/// The step by the normal equations, in which each unknown is limited to its largest step. fixed: unknowns that stay
VectorXd StepOf(const SquaresProblem& problem, const VectorXd& x, const RowSums& sums,
                double damping, const std::vector<Index>& fixed) {
  MatrixXd h = sums.gram;
  h.diagonal() *= 1 + damping;
  VectorXd b = sums.product;
  for (const Index i : fixed) {
    h.row(i).setZero();
    h.col(i).setZero();
    h(i, i) = 1;
    b[i] = 0;
  }
  VectorXd step = problem.step ? problem.step(h, b, x) : SolveScaled(h, b);
  // exactly where they are: rounding would take them off their bounds
  for (const Index i : fixed) step[i] = 0;
  if (problem.largest_step.size() > 0) {
    step = step.cwiseMin(problem.largest_step).cwiseMax(-problem.largest_step);
  }
  return step;
}

/// x + step within the bounds.
VectorXd Within(const SquaresProblem& problem, const VectorXd& x) {
  if (problem.lower.size() == 0) return x;
  return x.cwiseMax(problem.lower).cwiseMin(problem.upper);
}

/// Whether steps and their promises can be computed.
bool IsFinite(const RowSums& sums) {
  return std::isfinite(sums.squares) && sums.product.allFinite() && sums.gram.allFinite();
}

}  // namespace

Minimum Minimise(const SquaresProblem& problem, VectorXd x) {
  Minimum found;
  found.sums = problem.sums(x);
  found.trace.push_back({x, found.sums.squares});
  Damping damping;
  bool stuck = false;
  for (int i = 0; i < problem.most_iterations && !found.converged && !stuck; ++i) {
    if (!IsFinite(found.sums)) break;
    found.converged = found.sums.squares <= problem.least;
    if (found.converged) break;
    found.at_bound = PushedOut(problem, x, found.sums.product);
    std::vector<Index> fixed = problem.held;
    fixed.insert(fixed.end(), found.at_bound.begin(), found.at_bound.end());
    const double rests = std::max(problem.rests, kRounding * found.sums.squares);

    // damped more and more until the squares fall
    bool is_finite = true;
    for (bool fell = false; !fell && !found.converged && !stuck;) {
      const VectorXd next =
          Within(problem, x + StepOf(problem, x, found.sums, damping.share(), fixed));
      const VectorXd step = next - x;
      const double promised = step.dot(2 * found.sums.product - found.sums.gram * step);
      // a step that is no number promises nothing, however much it is damped
      stuck = !std::isfinite(promised);
      if (stuck) break;
      RowSums there = problem.sums(next);
      // at a minimum no fall is predicted; where only damping makes the predicted fall that small, the squares do not fall as predicted
      const bool promises = std::abs(promised) > (damping.IsLight() ? rests : problem.rests);
      found.converged = !promises && damping.IsLight();
      stuck = !promises && !damping.IsLight();
      is_finite = IsFinite(there);
      fell = there.squares < found.sums.squares && is_finite;
      if (!fell) {
        damping.AfterRise();
        continue;
      }
      found.fell = found.sums.squares - there.squares;
      found.sums = std::move(there);
      x = next;
      damping.AfterFall(promised > 0 ? found.fell / promised : 0);
      found.trace.push_back({x, found.sums.squares});
    }

    // the step that is left: it promises less than the squares' rounding, so that they cannot judge it
    if (!found.converged || !is_finite) continue;
    const VectorXd left = StepOf(problem, x, found.sums, 0, fixed);
    if (left.allFinite()) x = Within(problem, x + left);
    found.trace.back().x = x;
  }
  found.x = std::move(x);
  return found;
}

}  // namespace warmjoint
