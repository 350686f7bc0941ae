#include "identification/nonlinear/stribeck_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "identification/fit_data.h"
#include "identification/forward/closed_loop.h"
#include "identification/linear/least_squares.h"
#include "identification/nonlinear/solve_by_ceres.h"
#include "identification/warming/scan_time_constant.h"

namespace warmjoint {
namespace {

constexpr int kVelocities = 16;  // of the grid

/// Residuals (F - tau) / scale of the kept samples, as Ceres' automatic derivatives want them.
template <typename L, FittedWarming W>
class Residuals {
 public:
  explicit Residuals(const StribeckProblem& problem) : problem_(problem) {}

  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    using std::isfinite;
    const LogSamples& m = problem_.measurements;
    const auto law = ValuesOf<L>(x, problem_.exponent);
    const std::vector<ThermalHold<T>> holds = HoldsOf(x);
    T energy(0);
    // friction with the heat that all samples before have left
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      const double v = m.velocity[i];
      T force = L::Force(v, law.data());
      if constexpr (W == FittedWarming::estimated) {
        force = WarmForce(v, force, energy);
        const ThermalHold<T>& hold = holds[problem_.intervals.which[i]];
        energy = ThermalStep(T(x[kAt.gain()] * hold.cooling), hold.pole, energy, Loss(v, force));
      }
      if (!isfinite(force)) return false;
      if (problem_.selection.keep[i]) *residuals++ = (force - m.torque[i]) / problem_.scale;
    }
    return isfinite(energy) && isfinite(law[kAt.log_vs()]);
  }

  static constexpr Layout kAt = LayoutOf<L>(W == FittedWarming::estimated);

 private:
  /// Eq. (22) over each distinct interval; none without warming.
  template <typename T>
  std::vector<ThermalHold<T>> HoldsOf(const T* x) const {
    std::vector<ThermalHold<T>> holds;
    if constexpr (W == FittedWarming::estimated) {
      using std::exp;
      const T rate = exp(-x[kAt.log_time_constant()]);
      for (const double h : problem_.intervals.length) {
        // nothing is left where another recording starts cold
        holds.push_back(std::isinf(h) ? ThermalHold<T>{T(0), T(0), T(0)}
                                      : ThermalHold<T>::Over(h * rate));
      }
    }
    return holds;
  }

  const StribeckProblem& problem_;
};

template <typename L, FittedWarming W>
StribeckFit Refine(const StribeckProblem& problem, const FitPoint& start) {
  constexpr int P = static_cast<int>(Residuals<L, W>::kAt.size());
  using Cost = ceres::AutoDiffCostFunction<Residuals<L, W>, ceres::DYNAMIC, P>;
  const auto n = static_cast<int>(problem.selection.count());
  Eigen::VectorXd x = start.x;
  const auto solution =
      SolveByCeres<P>(std::make_unique<Cost>(new Residuals<L, W>(problem), n), {}, x.data());
  // back from shares of the scale to torque
  StribeckFit fit;
  fit.converged = solution.converged;
  fit.jacobian = problem.scale * solution.jacobian;
  fit.fitted =
      Kept(problem.measurements.torque, problem.selection) + problem.scale * solution.residuals;
  fit.solution = {x, problem.scale * problem.scale * solution.residuals.squaredNorm()};
  return fit;
}

/// The derivatives of F by the linear parameters at a given vs. [N x l]
Eigen::MatrixXd LinearColumns(const StribeckProblem& problem, double velocity) {
  const Eigen::VectorXd& v = problem.measurements.velocity;
  const Eigen::Index levels = problem.law.levels();
  Eigen::MatrixXd columns(v.size(), levels);
  // the force with one of them at 1 and the others at 0
  for (Eigen::Index j = 0; j < levels; ++j) {
    Eigen::VectorXd p(std::ssize(problem.law.law.parameters));
    p << Eigen::VectorXd::Unit(levels, j), velocity, problem.exponent;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      columns(i, j) = problem.law.law.force(v[i], p.data());
  }
  return columns;
}

/// The start at one vs: everything else from it.
std::optional<FitPoint> StartAt(const StribeckProblem& problem, double velocity) {
  const LogSamples& m = problem.measurements;
  const Eigen::MatrixXd columns = LinearColumns(problem, velocity);
  const Eigen::MatrixXd kept = Kept(columns, problem.selection);
  const Eigen::VectorXd torque = Kept(m.torque, problem.selection);
  // law at this vs, without warming; its columns must differ
  const LeastSquares cold = SolveLeastSquares(kept, torque, 1e-3);
  if (cold.rank < columns.cols()) return std::nullopt;

  const Layout at = problem.layout();
  FitPoint point{Eigen::VectorXd(at.size())};
  point.x[at.log_vs()] = std::log(velocity);
  if (problem.warming == FittedWarming::none) {
    at.law.In(point.x) = cold.solution;
    point.squares = (torque - kept * cold.solution).squaredNorm();
  } else {
    const ClosedLoop loop = ClosedLoop::Along(m, columns);
    // with warming: the time constant that explains most beside these columns
    const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
    const Eigen::VectorXd weight = problem.selection.keep.cast<double>();
    const InitialGuess start = ScanTimeConstant(loop, level, weight);
    at.law.In(point.x) = start.parameters;
    point.x[at.gain()] = start.thermal.gain;
    point.x[at.log_time_constant()] = std::log(start.thermal.time_constant);
    const Eigen::VectorXd force = loop.Simulate(start.parameters, start.thermal).force;
    point.squares = (torque - Kept(force, problem.selection)).squaredNorm();
  }
  if (!point.x.allFinite() || !std::isfinite(point.squares)) return std::nullopt;
  return point;
}

}  // namespace

std::vector<FitPoint> ScanStribeckVelocity(const StribeckProblem& problem) {
  const Eigen::ArrayXd speed =
      Kept(problem.measurements.velocity, problem.selection).col(0).array().abs();
  const double fastest = speed.maxCoeff();
  const double slowest = (speed > 0).select(speed, fastest).minCoeff();
  // vs from a third of the slowest speed up to the fastest
  const double from = std::max(slowest / 3, 1e-4 * fastest);
  std::vector<FitPoint> points;
  for (int i = 0; i < kVelocities; ++i) {
    const double velocity = from * std::pow(fastest / from, i / (kVelocities - 1.0));
    if (auto point = StartAt(problem, velocity)) points.push_back(*point);
  }
  return BestFirst(std::move(points));
}

StribeckFit RefineStribeck(const StribeckProblem& problem, const FitPoint& start) {
  return ForLawNamed(SteadyFallingLaws{}, problem.law.law.name, [&]<typename L>() {
    return problem.warming == FittedWarming::none
               ? Refine<L, FittedWarming::none>(problem, start)
               : Refine<L, FittedWarming::estimated>(problem, start);
  });
}

}  // namespace warmjoint
