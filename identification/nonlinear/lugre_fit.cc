#include "identification/nonlinear/lugre_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/nonlinear/lugre_course.h"
#include "identification/nonlinear/solve_by_ceres.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kDistances = 16;  // of the grids
constexpr int kVelocities = 16;
constexpr double kFall = 1.3;  // ks over kc before a fall is known

/// Residuals (F + M a - tau) / deviation of the used samples.
class Residuals {
 public:
  explicit Residuals(const LugreProblem& problem) : problem_(problem) {}

  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    using std::isfinite;
    const std::vector<T> torque = FollowLugre(problem_, x).torque;
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

using Cost = ceres::AutoDiffCostFunction<Residuals, ceres::DYNAMIC, kLugreSize>;

/// The ways, rad or m, from one turn or rest to the next.
std::vector<double> Ways(const Measurements& m) {
  std::vector<double> ways{0};
  for (Eigen::Index i = 1; i < m.size(); ++i) {
    const double from = m.velocity[i - 1], to = m.velocity[i];
    if (from * to <= 0) ways.push_back(0);
    ways.back() += 0.5 * std::abs(from + to) * (m.time[i] - m.time[i - 1]);
  }
  std::erase(ways, 0.0);
  return ways;
}

/// The smallest and the largest presliding distance that the motion may show, rad or m.
std::pair<double, double> Distances(const Measurements& m) {
  double shortest = 0, longest = 0;
  for (Eigen::Index i = 1; i < m.size(); ++i) {
    const double travel =
        0.5 * std::abs(m.velocity[i] + m.velocity[i - 1]) * (m.time[i] - m.time[i - 1]);
    if (travel > 0 && (shortest == 0 || travel < shortest)) shortest = travel;
  }
  for (const double way : Ways(m)) longest = std::max(longest, way);
  return {std::max(0.25 * shortest, 1e-5 * longest), longest};
}

/// Fits the inertia to a point, and sums the squares.
void Complete(const LugreProblem& problem, const Residuals& residuals, LugrePoint& point) {
  const Eigen::Index n = problem.used.count();
  point.x[kLugreInertia] = 0;
  Eigen::VectorXd r(n);
  point.squares = kInfinity;
  if (!residuals(point.x.data(), r.data())) return;
  point.squares = r.squaredNorm();
  if (problem.IsConstant(kLugreInertia)) return;
  const Eigen::VectorXd a =
      Kept(problem.acceleration, problem.used).cwiseQuotient(problem.deviation);
  const double inertia = -a.dot(r) / a.squaredNorm();
  if (!std::isfinite(inertia)) return;
  point.x[kLugreInertia] = std::max(0.0, inertia);
  point.squares = (r + point.x[kLugreInertia] * a).squaredNorm();
}

/// Moves kv, kc, ks and M, of which the torque is nearly linear, to what suits the rest of a point
/// best: steps of Gauss and Newton, with ks within 1 and 3 kc as starts are.
void CompleteLevels(const LugreProblem& problem, const Residuals& residuals, LugrePoint& point) {
  constexpr int kSteps = 2;
  const auto n = static_cast<int>(problem.used.count());
  const Cost cost(new Residuals(problem), n);
  std::vector<Eigen::Index> linear{kLugreViscous, kLugreCoulomb, kLugreStatic};
  if (!problem.IsConstant(kLugreInertia)) linear.push_back(kLugreInertia);
  Eigen::VectorXd r(n);
  Eigen::Matrix<double, Eigen::Dynamic, kLugreSize, Eigen::RowMajor> jacobian(n, kLugreSize);
  for (int step = 0; step < kSteps; ++step) {
    const double* at = point.x.data();
    double* into = jacobian.data();
    if (!cost.Evaluate(&at, r.data(), &into) || !jacobian.allFinite()) break;
    const Eigen::MatrixXd J = jacobian(Eigen::all, linear);
    const Eigen::VectorXd change = SolveLeastSquares(J, -r).solution;
    if (change.size() == 0) break;  // the samples do not tell them apart
    LugrePoint next = point;
    for (size_t i = 0; i < linear.size(); ++i) {
      next.x[linear[i]] += change[static_cast<Eigen::Index>(i)];
    }
    if (!next.x.allFinite() || !(next.x[kLugreCoulomb] > 0)) break;
    const double coulomb = next.x[kLugreCoulomb];
    next.x[kLugreStatic] = std::clamp(next.x[kLugreStatic], coulomb, 3 * coulomb);
    next.x[kLugreInertia] = std::max(0.0, next.x[kLugreInertia]);
    point = next;
  }
  point.squares = residuals(point.x.data(), r.data()) ? r.squaredNorm() : kInfinity;
}

std::vector<LugrePoint> Sorted(std::vector<LugrePoint> points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.squares < b.squares; });
  return points;
}

}  // namespace

std::vector<LugrePoint> ScanBristle(
    const LugreProblem& problem, const Measurements& measurements,
    const std::function<std::optional<Eigen::Vector4d>(double distance)>& steady) {
  const Measurements& m = measurements;
  const auto [shortest, longest] = Distances(m);
  std::vector<LugrePoint> points;
  if (!(shortest > 0) || !(longest > shortest)) return points;
  const double step = MedianStep(m.time);
  const Residuals residuals(problem);
  for (int i = 0; i < kDistances; ++i) {
    const double distance = shortest * std::pow(longest / shortest, i / (kDistances - 1.0));
    const std::optional<Eigen::Vector4d> curve = steady(distance);
    if (!curve) continue;
    const double stiffness = (*curve)[kLugreStatic] / distance;
    for (const double times : {0.0, 1.0, 10.0}) {
      if (times > 0 && problem.IsConstant(kLugreDamping)) continue;
      LugrePoint point;
      point.x << *curve, std::log(stiffness), times * step * stiffness, 0;
      Complete(problem, residuals, point);
      if (std::isfinite(point.squares)) points.push_back(point);
    }
  }
  return Sorted(std::move(points));
}

std::vector<LugrePoint> ScanFall(const LugreProblem& problem, const LugrePoint& point,
                                 double fastest) {
  const Residuals residuals(problem);
  std::vector<LugrePoint> points;
  for (int i = 0; i < kVelocities; ++i) {
    LugrePoint other = point;
    other.x[kLugreLogVs] = std::log(fastest) - std::log(1000) * i / (kVelocities - 1.0);
    other.x[kLugreStatic] = kFall * point.x[kLugreCoulomb];
    CompleteLevels(problem, residuals, other);
    if (std::isfinite(other.squares)) points.push_back(other);
  }
  return Sorted(std::move(points));
}

LugreFit RefineLugre(const LugreProblem& problem, const LugrePoint& start) {
  const auto n = static_cast<int>(problem.used.count());
  Eigen::Matrix<double, kLugreSize, 1> x = start.x;
  const auto solution = SolveByCeres<kLugreSize>(std::make_unique<Cost>(new Residuals(problem), n),
                                                 problem.constant, x.data());
  LugreFit fit;
  fit.converged = solution.converged;
  fit.residual = -solution.residuals;
  fit.jacobian = solution.jacobian;
  fit.solution = {x, solution.residuals.squaredNorm()};
  fit.loads = FollowLugre(problem, x.data()).loads;
  return fit;
}

Eigen::VectorXd LugreTorque(const LugreProblem& problem, const LugrePoint& point,
                            const std::vector<double>& loads) {
  const Eigen::Index n = problem.motion.size();
  const auto p = LugreValues(point.x.data());
  Eigen::VectorXd torque = point.x[kLugreInertia] * problem.acceleration;
  size_t recording = 0;
  for (Eigen::Index first = 0, end = 0; first < n; first = end) {
    end = problem.EndOfRecording(first);
    const LugreRun<double> run(problem.motion, first, end, p, loads[recording++]);
    torque.segment(first, end - first) +=
        Eigen::Map<const Eigen::VectorXd>(run.force.data(), end - first);
  }
  return torque;
}

}  // namespace warmjoint::inline identification
