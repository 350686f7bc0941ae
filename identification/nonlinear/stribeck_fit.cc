#include "identification/nonlinear/stribeck_fit.h"

#include <ceres/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/closed_loop.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/model/model_squares.h"
#include "identification/model/normal_equations.h"
#include "identification/nonlinear/solve_by_ceres.h"

namespace warmjoint {
namespace {

constexpr int kVelocities = 16;  // of the grid

/// Friction of a law L that falls with speed, by its levels and the logarithm of its Stribeck velocity, the first unknowns.
template <typename L>
class FallingBlock final : public Block {
 public:
  FallingBlock(const LogSamples& m, double exponent)
      : of_force_(m.velocity), of_losses_(m.loss_velocity), exponent_(exponent) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override {
    FillAlong(of_force_, x, rows);
  }
  bool MakesHeat() const override { return true; }
  bool HasOwnLosses() const override { return of_losses_.has_value(); }
  void FillLosses(const Eigen::VectorXd& x, ModelRows& rows) const override {
    FillAlong(of_losses_ ? *of_losses_ : of_force_, x, rows);
  }

 private:
  void FillAlong(const Eigen::VectorXd& velocity, const Eigen::VectorXd& x, ModelRows& rows) const {
    constexpr auto kSize = static_cast<int>(FallingPlacesOf<L>().gain());
    using Dual = ceres::Jet<double, kSize>;
    std::array<Dual, static_cast<size_t>(kSize)> duals;
    for (int j = 0; j < kSize; ++j) duals[static_cast<size_t>(j)] = Dual(x[j], j);
    const auto law = ValuesOf<L>(duals.data(), exponent_);
    for (Eigen::Index i = 0; i < rows.at.count; ++i) {
      const Dual force = L::Force(velocity[rows.at.first + i], law.data());
      rows.force[i] += force.a;
      rows.derivatives.row(i).template head<kSize>() += force.v.transpose();
    }
  }

  Eigen::VectorXd of_force_;                  // [N] velocity, rad/s or m/s
  std::optional<Eigen::VectorXd> of_losses_;  // [N] where losses have another
  double exponent_;
};

/// Law, heat, gravity and inertia.
Model ModelOf(const StribeckProblem& problem) {
  const LogSamples& m = problem.measurements;
  const FallingPlaces at = problem.places();
  Model model;
  model.samples = m.size();
  const Slice law = model.Append(Unnamed(Role::law, at.gain()));
  model.blocks.push_back(ForLawNamed(
      SteadyFallingLaws{}, problem.law.law.name, [&]<typename L>() -> std::shared_ptr<const Block> {
        return std::make_shared<FallingBlock<L>>(m, problem.exponent);
      }));
  if (at.heat > 0) {
    const Slice heat = model.Append(HeatUnknowns(UnitsOf(m)));
    const auto loop = std::make_shared<const ClosedLoop>(
        ClosedLoop::Along(m, Eigen::MatrixXd(m.size(), 0), Eigen::MatrixXd(m.size(), 0)));
    model.heat = HeatLoop{.loop = loop,
                          .direction = m.velocity.cwiseSign(),
                          .friction = law.size,
                          .parameters = heat};
  }
  const Slice rigid = model.Append(Unnamed(Role::gravity, at.rigid));
  if (rigid.size > 0) {
    model.blocks.push_back(std::make_shared<LinearBlock>(rigid, Shared(problem.rigid)));
  }
  return model;
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
    point.x.tail(q) = cold.solution.tail(q);
    point.squares = (torque - kept * cold.solution).squaredNorm();
  } else {
    // with warming: the time constant that explains most in addition to these columns
    const InitialGuess start = ScanWarming(columns, cold.solution.tail(q), problem);
    const Eigen::VectorXd law = start.parameters.head(columns.cols());
    at.law().In(point.x) = law;
    point.x[at.gain()] = start.thermal.gain;
    point.x[at.log_time_constant()] = std::log(start.thermal.time_constant);
    point.x.tail(q) = start.parameters.tail(q);
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

InitialGuess ScanWarming(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rigid,
                         const StribeckProblem& problem) {
  const LogSamples& m = problem.measurements;
  return ScanBeside({problem.rigid, rigid}, ClosedLoop::Along(m, BesideRigid(columns, problem)),
                    m.torque, problem.selection.keep.cast<double>());
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
  const auto model = std::make_shared<const Model>(ModelOf(problem));
  const ModelSamples samples{.torque = problem.measurements.torque, .keep = problem.selection.keep};
  const Eigen::VectorXd torque = Kept(problem.measurements.torque, problem.selection);
  const double scale = torque.norm() / std::sqrt(static_cast<double>(torque.size()));
  CeresSolution found = SolveByCeres(CostOf(*model, samples, scale), {}, start.x);
  // back from shares of the scale to torque
  StribeckFit fit;
  fit.converged = found.converged;
  fit.model = model;
  fit.fitted = torque + scale * found.residuals;
  fit.cofactor = Cofactor(GramOf(scale * found.jacobian));
  fit.solution = {std::move(found.x), scale * scale * found.residuals.squaredNorm()};
  return fit;
}

}  // namespace warmjoint
