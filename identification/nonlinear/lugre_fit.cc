#include "identification/nonlinear/lugre_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/model/least_squares.h"
#include "identification/nonlinear/solve_by_ceres.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/bristle_state.h"

namespace warmjoint {
namespace {

/// F + M a over all samples, and the loads s with which the R recordings begin.
template <typename T>
struct LugreResponse {
  std::vector<T> torque;  // [N] N.m or N
  std::vector<T> loads;   // [R] N.m or N
};

/// F and s over the samples of one recording, from its first to one before its end, by law L.
template <typename L, typename T>
struct LugreRun {
  std::vector<T> force, load;  // N.m or N

  /// load: s at its first sample; p: of the law's table.
  LugreRun(const MotionPieces& motion, Eigen::Index first, Eigen::Index end,
           const std::array<T, L::parameters.size()>& p, const T& begin) {
    BristleState<L, T> bristle(p.data());
    bristle.BeginLoaded(motion.velocity(first), begin);
    for (Eigen::Index i = first; i < end; ++i) {
      for (const MotionPiece& piece : motion.Before(i)) bristle.Follow(piece, 0, 0);
      force.push_back(bristle.Force(motion.velocity(i), 0));
      load.push_back(bristle.load());
    }
  }
};

/// b = dF/ds0 over the first samples of a recording, until less than 1e-9 of s0 is left: what a
/// load of 1 at its start adds to `run`, which began with 0.
template <typename L, typename T>
std::vector<T> ByLoad(const MotionPieces& motion, Eigen::Index first,
                      const std::array<T, L::parameters.size()>& p, const LugreRun<L, T>& run) {
  constexpr double kForgotten = 1e-9;
  BristleState<L, T> bristle(p.data());
  bristle.BeginLoaded(motion.velocity(first), T(1));
  std::vector<T> by_load;
  for (size_t k = 0; k < run.force.size(); ++k) {
    const Eigen::Index i = first + static_cast<Eigen::Index>(k);
    for (const MotionPiece& piece : motion.Before(i)) bristle.Follow(piece, 0, 0);
    by_load.push_back(bristle.Force(motion.velocity(i), 0) - run.force[k]);
    if (bristle.load() - run.load[k] < T(kForgotten)) break;
  }
  return by_load;
}

/// The torque at x. No single sample determines the load with which a recording began: the first sample has noise,
/// which at a slow start would stay for the whole distance over which the bristle bends, in many samples and
/// all with the same error. But the law is linear in s0, the load at the start,
///     F = F(s0 = 0) + b s0,   b = dF/ds0, which dies away as exp(-sigma0 |x| / g),
/// so that least squares give it at any x (variable projection, Golub and Pereyra 1973):
///     s0 = sum b (tau - F(s0 = 0) - M a) / d^2 / (sum b^2 / d^2 + 1 / q^2)
/// over the used samples with their deviations d. q, the rms of the torque, keeps s0 near 0 where
/// none of them determines it. Derivatives by x include those of s0, so that a covariance from them takes into account that it
/// was estimated, too.
template <typename L, typename T>
LugreResponse<T> FollowLugre(const LugreProblem& problem, const T* x) {
  const Eigen::Index n = problem.motion.size();
  const auto p = ValuesOf<L>(x);
  const T& inertia = x[FallingPlacesOf<L>().inertia()];
  LugreResponse<T> response;
  response.torque.reserve(static_cast<size_t>(n));
  Eigen::Index row = 0;  // of the used samples
  for (Eigen::Index first = 0, end = 0; first < n; first = end) {
    end = problem.EndOfRecording(first);
    const LugreRun<L, T> run(problem.motion, first, end, p, T(0));
    const std::vector<T> by_load = ByLoad<L>(problem.motion, first, p, run);

    // from a start without load, and what the samples show of it
    T weighted_sum(0), weight(static_cast<double>(n) / problem.torque.squaredNorm());
    for (Eigen::Index i = first; i < end; ++i) {
      const auto k = static_cast<size_t>(i - first);
      response.torque.push_back(run.force[k] + inertia * problem.acceleration[i]);
      if (!problem.used.keep[i]) continue;
      const double deviation = problem.deviation[row++];
      if (k >= by_load.size()) continue;
      const T weighted = by_load[k] / (deviation * deviation);
      weighted_sum += weighted * (problem.torque[i] - response.torque.back());
      weight += weighted * by_load[k];
    }

    // from the load by least squares
    response.loads.push_back(weighted_sum / weight);
    for (size_t k = 0; k < by_load.size(); ++k) {
      response.torque[static_cast<size_t>(first) + k] += by_load[k] * response.loads.back();
    }
  }
  return response;
}

constexpr int kDistances = 16;  // of the grids
constexpr int kVelocities = 16;
constexpr double kFall = 1.3;  // ks over kc before the fall is estimated

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Residuals (F + M a - tau) / deviation of the used samples, F by law L.
template <typename L>
class Residuals {
 public:
  explicit Residuals(const LugreProblem& problem) : problem_(problem) {}

  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    using std::isfinite;
    // the bristles are followed along the whole log, residuals are of the samples that are used
    const std::vector<T> torque = FollowLugre<L>(problem_, x).torque;
    Eigen::Index row = 0;
    for (size_t k = 0; k < torque.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (!problem_.used.keep[i]) continue;
      residuals[row] = (torque[k] - problem_.torque[i]) / problem_.deviation[row];
      if (!isfinite(residuals[row])) return false;
      ++row;
    }
    return true;
  }

 private:
  const LugreProblem& problem_;
};

/// How many parameters x has of law L.
template <typename L>
constexpr int kSize = static_cast<int>(FallingPlacesOf<L>().size());

template <typename L>
using Cost = ceres::AutoDiffCostFunction<Residuals<L>, ceres::DYNAMIC, kSize<L>>;

template <typename F>
auto ForLaw(const LugreProblem& problem, const F& f) {
  return ForLawNamed(BristleFallingLaws{}, problem.law->law.name, f);
}

/// The residuals at x; false where they are no numbers. residuals: [n]
bool ResidualsAt(const LugreProblem& problem, const Eigen::VectorXd& x, double* residuals) {
  return ForLaw(problem, [&]<typename L>() { return Residuals<L>(problem)(x.data(), residuals); });
}

/// The same with the Jacobian, which is finite then. jacobian: [n x p]
bool DerivativesAt(const LugreProblem& problem, const Eigen::VectorXd& x,
                   Eigen::VectorXd& residuals, RowMajor& jacobian) {
  return ForLaw(problem, [&]<typename L>() {
    const Cost<L> cost(new Residuals<L>(problem), static_cast<int>(residuals.size()));
    const double* at = x.data();
    double* into = jacobian.data();
    return cost.Evaluate(&at, residuals.data(), &into) && jacobian.allFinite();
  });
}

/// The smallest and the largest presliding distance that the motion may show, rad or m.
std::pair<double, double> Distances(const LogSamples& m) {
  double shortest = 0, longest = 0, since_turn = 0;  // or since a rest
  for (Eigen::Index i = 1; i < m.size(); ++i) {
    const double from = m.velocity[i - 1], to = m.velocity[i];
    const double travel = 0.5 * std::abs(from + to) * (m.time[i] - m.time[i - 1]);
    if (travel > 0 && (shortest == 0 || travel < shortest)) shortest = travel;
    if (from * to <= 0) since_turn = 0;
    since_turn += travel;
    longest = std::max(longest, since_turn);
  }
  return {std::max(0.25 * shortest, 1e-5 * longest), longest};
}

/// Fits the inertia to a point, and sums the squares.
void Complete(const LugreProblem& problem, FitPoint& point) {
  const Eigen::Index n = problem.used.count();
  const FallingPlaces& at = problem.places();
  double& inertia = point.x[at.inertia()];
  inertia = 0;
  // the residual without inertia
  Eigen::VectorXd r(n);
  point.squares = kInfinity;
  if (!ResidualsAt(problem, point.x, r.data())) return;
  point.squares = r.squaredNorm();
  if (problem.IsConstant(at.inertia())) return;
  // the torque is linear in the inertia: its best value, but not below 0
  const Eigen::VectorXd a =
      Kept(problem.acceleration, problem.used).cwiseQuotient(problem.deviation);
  const double best = -a.dot(r) / a.squaredNorm();
  if (!std::isfinite(best)) return;
  inertia = std::max(0.0, best);
  point.squares = (r + inertia * a).squaredNorm();
}

/// Sets the linear parameters and M, in which the torque is nearly linear, to their best values given the others of a
/// point, by Gauss-Newton steps with ks within 1 and 3 kc as in starts.
void CompleteLevels(const LugreProblem& problem, FitPoint& point) {
  constexpr int kSteps = 2;
  const FallingPlaces& at = problem.places();
  // levels of the law, and the inertia where it is free
  std::vector<Eigen::Index> linear = at.law().Places();
  if (!problem.IsConstant(at.inertia())) linear.push_back(at.inertia());
  Eigen::VectorXd r(problem.used.count());
  RowMajor jacobian(r.size(), at.size());
  for (int step = 0; step < kSteps; ++step) {
    // one step of least squares at fixed stiffness, damping and vs
    if (!DerivativesAt(problem, point.x, r, jacobian)) break;
    const Eigen::MatrixXd J = jacobian(Eigen::all, linear);
    const Eigen::VectorXd change = SolveLeastSquares(J, -r).solution;
    if (change.size() == 0) break;  // the samples do not distinguish the unknowns
    FitPoint next = point;
    next.x(linear) += change;
    // steps end outside of the law's bounds
    if (!next.x.allFinite() || !(problem.law->coulomb(at.law().In(next.x).data()) > 0)) break;
    problem.law->keep(at.law().In(next.x).data(), 1, 3);
    next.x[at.inertia()] = std::max(0.0, next.x[at.inertia()]);
    point = next;
  }
  point.squares = ResidualsAt(problem, point.x, r.data()) ? r.squaredNorm() : kInfinity;
}

}  // namespace

std::vector<FitPoint> ScanBristle(
    const LugreProblem& problem, const LogSamples& measurements,
    const std::function<std::optional<Eigen::VectorXd>(double distance)>& steady) {
  const LogSamples& m = measurements;
  const FallingPlaces& at = problem.places();
  const auto [shortest, longest] = Distances(m);
  std::vector<FitPoint> points;
  if (!(shortest > 0) || !(longest > shortest)) return points;
  const double step = MedianStep(m.time);
  for (int i = 0; i < kDistances; ++i) {
    // presliding distances, evenly in the logarithm, each with the steady curve beyond it
    const double distance = shortest * std::pow(longest / shortest, i / (kDistances - 1.0));
    const std::optional<Eigen::VectorXd> curve = steady(distance);
    if (!curve) continue;
    // static torque bends the bristles by the distance
    const double stiffness = problem.law->at_rest(at.law().Of(*curve).data()) / distance;
    // without damping, and with some by which bristles relax within one step or ten
    for (const double times : {0.0, 1.0, 10.0}) {
      if (times > 0 && problem.IsConstant(at.damping())) continue;
      FitPoint point{*curve};
      point.x[at.log_stiffness()] = std::log(stiffness);
      point.x[at.damping()] = times * step * stiffness;
      Complete(problem, point);
      if (std::isfinite(point.squares)) points.push_back(point);
    }
  }
  return BestFirst(std::move(points));
}

std::vector<FitPoint> ScanFall(const LugreProblem& problem, const FitPoint& point, double fastest) {
  const FallingPlaces& at = problem.places();
  std::vector<FitPoint> points;
  for (int i = 0; i < kVelocities; ++i) {
    FitPoint other = point;
    // vs from the fastest speed to a thousandth of it
    other.x[at.log_vs()] = std::log(fastest) - std::log(1000) * i / (kVelocities - 1.0);
    problem.law->keep(at.law().In(other.x).data(), kFall, kFall);
    CompleteLevels(problem, other);
    if (std::isfinite(other.squares)) points.push_back(other);
  }
  return BestFirst(std::move(points));
}

LugreFit RefineLugre(const LugreProblem& problem, const FitPoint& start) {
  return ForLaw(problem, [&]<typename L>() {
    const auto n = static_cast<int>(problem.used.count());
    CeresSolution solution = SolveByCeres(std::make_unique<Cost<L>>(new Residuals<L>(problem), n),
                                          problem.constant, start.x);
    // residuals as measured less fitted, and the load of the bristles from which each recording starts
    LugreFit fit;
    fit.converged = solution.converged;
    fit.residual = -solution.residuals;
    fit.jacobian = std::move(solution.jacobian);
    fit.solution = {std::move(solution.x), solution.residuals.squaredNorm()};
    fit.loads = FollowLugre<L>(problem, fit.solution.x.data()).loads;
    return fit;
  });
}

Eigen::VectorXd LugreTorque(const LugreProblem& problem, const LugreFit& fit) {
  const Eigen::Index n = problem.motion.size();
  return ForLaw(problem, [&]<typename L>() {
    const Eigen::VectorXd& x = fit.solution.x;
    const auto p = ValuesOf<L>(x.data());
    Eigen::VectorXd torque = x[FallingPlacesOf<L>().inertia()] * problem.acceleration;
    size_t recording = 0;
    // each recording from its own load
    for (Eigen::Index first = 0, end = 0; first < n; first = end) {
      end = problem.EndOfRecording(first);
      const LugreRun<L, double> run(problem.motion, first, end, p, fit.loads[recording++]);
      torque.segment(first, end - first) +=
          Eigen::Map<const Eigen::VectorXd>(run.force.data(), end - first);
    }
    return torque;
  });
}

}  // namespace warmjoint
