#include "identification/nonlinear/stribeck_fit.h"

#include <ceres/autodiff_cost_function.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/forward/closed_loop.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/nonlinear/solve_by_ceres.h"

namespace warmjoint {
namespace {

constexpr int kVelocities = 16;  // of the grid

/// Residuals (F - tau) / scale of the kept samples, orthogonal to columns, in the form for Ceres' automatic derivatives.
template <typename L, PartFit W>
class Residuals {
 public:
  /// basis: [n x q] orthonormal, of the columns
  Residuals(const StribeckProblem& problem, Eigen::MatrixXd basis)
      : problem_(problem), basis_(std::move(basis)) {}

  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    using std::isfinite;
    const LogSamples& m = problem_.measurements;
    const auto law = ValuesOf<L>(x, problem_.exponent);
    const std::vector<ThermalHold<T>> holds = HoldsOf(x);
    T energy(0);
    T* const first = residuals;
    // friction with the heat of all samples before
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      const double v = m.velocity[i];
      T force = L::Force(v, law.data());
      if constexpr (W == PartFit::estimated) {
        force = WarmForce(v, force, energy);
        const ThermalHold<T>& hold = holds[problem_.intervals.which[i]];
        energy = ThermalStep(T(x[kAt.gain()] * hold.cooling), hold.pole, energy, Loss(v, force));
      }
      if (!isfinite(force)) return false;
      if (problem_.selection.keep[i]) *residuals++ = (force - m.torque[i]) / problem_.scale;
    }
    TakeOff(first);
    return isfinite(energy) && isfinite(law[kAt.log_vs()]);
  }

  static constexpr FallingPlaces kAt = FallingPlacesOf<L, W>();

 private:
  /// Subtracts the part of the residuals that is in the span of the basis.
  template <typename T>
  void TakeOff(T* residuals) const {
    for (const auto& column : basis_.colwise()) {
      T along(0);
      for (Eigen::Index i = 0; i < column.size(); ++i) along += column[i] * residuals[i];
      for (Eigen::Index i = 0; i < column.size(); ++i) residuals[i] -= column[i] * along;
    }
  }

  /// Eq. (22) over each distinct interval; none without warming.
  template <typename T>
  std::vector<ThermalHold<T>> HoldsOf(const T* x) const {
    std::vector<ThermalHold<T>> holds;
    if constexpr (W == PartFit::estimated) {
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
  Eigen::MatrixXd basis_;  // [n x q]
};

/// [n x q] columns of gravity and inertia at the kept samples.
Eigen::MatrixXd RigidRows(const StribeckProblem& problem) {
  if (problem.rigid.cols() == 0) return Eigen::MatrixXd(problem.selection.count(), 0);
  return Kept(problem.rigid, problem.selection);
}

/// [n x q] orthonormal columns that span those given.
Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

template <typename L, PartFit W>
StribeckFit Refine(const StribeckProblem& problem, const FitPoint& start) {
  constexpr int P = static_cast<int>(Residuals<L, W>::kAt.size());
  using Cost = ceres::AutoDiffCostFunction<Residuals<L, W>, ceres::DYNAMIC, P>;
  const auto n = static_cast<int>(problem.selection.count());
  const auto cost = [&](const Eigen::MatrixXd& basis) {
    return std::make_unique<Cost>(new Residuals<L, W>(problem, basis), n);
  };
  const Eigen::MatrixXd rigid = RigidRows(problem);
  Eigen::VectorXd x = start.x;
  auto solution = SolveByCeres<P>(cost(OrthonormalBasis(rigid)), {}, x.data());
  // back from shares of the scale to torque
  StribeckFit fit;
  fit.converged = solution.converged;
  const Eigen::VectorXd torque = Kept(problem.measurements.torque, problem.selection);
  fit.fitted = torque + problem.scale * solution.residuals;
  fit.solution = {x, problem.scale * problem.scale * solution.residuals.squaredNorm()};
  if (rigid.cols() == 0) {
    fit.jacobian = problem.scale * solution.jacobian;
    return fit;
  }

  // the rigid part is the projection of the friction's residual on its columns
  Eigen::VectorXd alone(n);
  const double* const at = x.data();
  double* into = solution.jacobian.data();
  cost(Eigen::MatrixXd(n, 0))->Evaluate(&at, alone.data(), &into);
  fit.rigid = SolveLeastSquares(rigid, -problem.scale * alone).solution;
  fit.jacobian = ConcatColumns(problem.scale * solution.jacobian, rigid);
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

/// The start at one vs, from which all other parameters follow.
std::optional<FitPoint> StartAt(const StribeckProblem& problem, double velocity) {
  const LogSamples& m = problem.measurements;
  const Eigen::MatrixXd columns = LinearColumns(problem, velocity);
  const Eigen::MatrixXd both = BesideRigid(columns, problem);
  const Eigen::MatrixXd kept = Kept(both, problem.selection);
  const Eigen::VectorXd torque = Kept(m.torque, problem.selection);
  // law at this vs, without warming; its columns must differ
  const LeastSquares cold = SolveLeastSquares(kept, torque, 1e-3);
  if (cold.rank < both.cols()) return std::nullopt;
  const Eigen::Index q = problem.rigid.cols();

  const FallingPlaces at = problem.places();
  FitPoint point{Eigen::VectorXd(at.size())};
  point.x[at.log_vs()] = std::log(velocity);
  if (problem.warming == PartFit::none) {
    at.law().In(point.x) = cold.solution.head(columns.cols());
    point.squares = (torque - kept * cold.solution).squaredNorm();
  } else {
    // with warming: the time constant that explains most in addition to these columns
    const InitialGuess start = ScanBesideRigid(columns, cold.solution.tail(q), problem);
    const Eigen::VectorXd law = start.parameters.head(columns.cols());
    at.law().In(point.x) = law;
    point.x[at.gain()] = start.thermal.gain;
    point.x[at.log_time_constant()] = std::log(start.thermal.time_constant);
    Eigen::VectorXd force = ClosedLoop::Along(m, columns).Simulate(law, start.thermal).force;
    if (q > 0) force += problem.rigid * start.parameters.tail(q);
    point.squares = (torque - Kept(force, problem.selection)).squaredNorm();
  }
  if (!point.x.allFinite() || !std::isfinite(point.squares)) return std::nullopt;
  return point;
}

}  // namespace

Eigen::MatrixXd BesideRigid(const Eigen::MatrixXd& columns, const StribeckProblem& problem) {
  return problem.rigid.cols() > 0 ? ConcatColumns(columns, problem.rigid) : columns;
}

InitialGuess ScanBesideRigid(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rigid,
                             const StribeckProblem& problem) {
  const LogSamples& m = problem.measurements;
  const ClosedLoop together = ClosedLoop::Along(m, BesideRigid(columns, problem));
  Eigen::VectorXd torque = m.torque;
  if (rigid.size() > 0) torque -= problem.rigid * rigid;
  InitialGuess start = ScanTimeConstant(together, torque, problem.selection.keep.cast<double>());
  start.parameters.tail(rigid.size()) += rigid;
  return start;
}

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
    return problem.warming == PartFit::none ? Refine<L, PartFit::none>(problem, start)
                                            : Refine<L, PartFit::estimated>(problem, start);
  });
}

}  // namespace warmjoint
