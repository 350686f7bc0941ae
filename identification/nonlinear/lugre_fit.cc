#include "identification/nonlinear/lugre_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "identification/fit_data.h"
#include "identification/nonlinear/solve_by_ceres.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

constexpr int kDistances = 16;  // of the grids
constexpr int kVelocities = 16;

/// Residuals (F + M a - tau) / deviation of the used samples.
class Residuals {
 public:
  explicit Residuals(const LugreProblem& problem) : problem_(problem) {}

  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    using std::isfinite;
    const auto n = static_cast<size_t>(problem_.motion.size());
    const std::array<T, 6> p = LugreValues(x);
    std::vector<T> force(n), load(n);
    RunBristle<LuGre>(problem_.motion, problem_.torque, p.data(), force.data(), load.data());
    Eigen::Index row = 0;
    for (size_t k = 0; k < n; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (!problem_.used.keep[i]) continue;
      const T torque = force[k] + x[kLugreInertia] * problem_.acceleration[i];
      residuals[row] = (torque - problem_.torque[i]) / problem_.deviation[row];
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
    for (const double ratio : {1.2, 1.6}) {
      LugrePoint other = point;
      other.x[kLugreLogVs] = std::log(fastest) - std::log(1000) * i / (kVelocities - 1.0);
      other.x[kLugreStatic] = ratio * point.x[kLugreCoulomb];
      Complete(problem, residuals, other);
      if (std::isfinite(other.squares)) points.push_back(other);
    }
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
  return fit;
}

Eigen::VectorXd LugreTorque(const LugreProblem& problem, const LugrePoint& point) {
  const Eigen::Index n = problem.motion.size();
  const auto p = LugreValues(point.x.data());
  Eigen::VectorXd force(n), load(n);
  RunBristle<LuGre>(problem.motion, problem.torque, p.data(), force.data(), load.data());
  return force + point.x[kLugreInertia] * problem.acceleration;
}

}  // namespace warmjoint::inline identification
