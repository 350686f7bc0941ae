#include "identification/warming/warm_fit.h"

#include <ceres/tiny_solver.h>

#include <cmath>

#include "identification/warming/condensed_problem.h"

namespace warmjoint {
namespace {

constexpr int kMostIterations = 50;

WarmFit Solve(const CondensedProblem& problem, const Eigen::VectorXd& start) {
  using Solver = ceres::TinySolver<CondensedProblem>;
  Solver solver;
  solver.options.max_num_iterations = kMostIterations;
  solver.options.gradient_tolerance = 1e-10;
  solver.options.parameter_tolerance = 1e-11;
  solver.options.function_tolerance = 1e-10;  // of |r|^2, which is about the number of samples
  solver.options.initial_trust_region_radius = 1e8;
  Solver::Parameters x = start;
  solver.Solve(problem, &x);

  // the products at the solution tell squares and normal matrix
  const Eigen::Index p = x.size();
  const Eigen::MatrixXd& products = problem.Evaluate(x);
  WarmFit fit;
  fit.solution = {x, products(p, p)};
  fit.normal = products.topLeftCorner(p, p);
  // every iterate, the solution last
  fit.trace = std::move(problem.trace());
  fit.trace.push_back(fit.solution);
  fit.converged = solver.summary.status != Solver::HIT_MAX_ITERATIONS &&
                  std::isfinite(fit.solution.squares) && x.allFinite();
  return fit;
}

}  // namespace

Thermal WarmFit::thermal() const {
  return {solution.x[law_parameters], std::exp(solution.x[law_parameters + 1])};
}

Eigen::VectorXd WarmFit::parameters() const { return solution.x.head(law_parameters); }

double WarmFit::initial_energy() const {
  return estimates_initial_energy() ? solution.x[law_parameters + 2] : 0;
}

Eigen::VectorXd WarmFit::jump_values() const {
  const Eigen::Index count = jump_weights.size();
  return solution.x.segment(solution.x.size() - offsets - count, count);
}

Eigen::VectorXd WarmFit::prior() const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(solution.x.size());
  all.segment(all.size() - offsets - jump_weights.size(), jump_weights.size()) = jump_weights;
  if (estimates_initial_energy()) all[law_parameters + 2] = start_weight;
  return all;
}

InitialGuess StartFrom(const WarmFit& fit) {
  InitialGuess start;
  start.parameters.resize(fit.law_parameters + fit.offsets);
  start.parameters << fit.parameters(), fit.offset_values();
  start.thermal = fit.thermal();
  return start;
}

WarmFit FitWarmFriction(const ClosedLoop& loop, const Eigen::VectorXd& level,
                        const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                        const InitialGuess& start, const InitialEnergy& initial, double scale,
                        const Eigen::VectorXd& jump_weights, const RowTransform* transform) {
  const Eigen::Index d = loop.levels().cols(), q = offsets.cols(), jumps = jump_weights.size();
  // heat has gain and log(tau), and E(0) where that is not known for sure
  const int warming = initial.spread > 0 ? 3 : 2;
  const StartPull pull{initial.mean, StartWeight(scale, initial)};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(d + warming + jumps + q);
  // from the scanned law and heat, without jumps, with the E(0) that is expected
  x.head(d + 2) << start.parameters.head(d), start.thermal.gain,
      std::log(start.thermal.time_constant);
  x.tail(q) = start.parameters.tail(q);
  if (warming == 3) x[d + 2] = initial.mean;

  WarmFit fit = Solve(
      CondensedProblem(loop, level, offsets, kept, jump_weights, warming, pull, scale, transform),
      x);
  // which entries of x are what
  fit.law_parameters = d;
  fit.jump_weights = jump_weights;
  fit.offsets = q;
  fit.initial = initial;
  fit.start_weight = pull.weight;
  return fit;
}

}  // namespace warmjoint
