#include "identification/warm_fit.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "identification/closed_loop_kernel.h"

namespace warmjoint {
namespace {

constexpr int kMostIterations = 50;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();  // equals nothing

/// Sums n, or Dynamic where one of them is.
constexpr int Plus(int a, int b) { return a == Eigen::Dynamic ? a : a + b; }

/// The condensed least-squares problem, as ceres::TinySolver wants it. D: law parameters, Q: 2 for
/// (k, log tau), 3 with E(0). Offsets come last, and only where D is Dynamic.
template <int D, int Q>
class CondensedProblem {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = Plus(D, Q), NUM_RESIDUALS = Plus(D, Q + 1) };
  using Square = Eigen::Matrix<double, NUM_RESIDUALS, NUM_RESIDUALS>;
  using Vector = Eigen::Matrix<double, NUM_PARAMETERS, 1>;
  using Row = Eigen::Array<double, NUM_RESIDUALS, 1>;

  CondensedProblem(const ClosedLoop& loop, const Eigen::VectorXd& level,
                   const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept, double scale)
      : loop_(loop),
        level_(level),
        offsets_(offsets),
        kept_(kept),
        scale_(scale),
        d_(loop.levels().cols()),
        x_(Vector::Constant(NumParameters(), kNaN)) {}

  int NumParameters() const { return static_cast<int>(d_ + offsets_.cols()) + Q; }
  int NumResiduals() const { return NumParameters() + 1; }

  bool operator()(const double* x, double* residuals, double* jacobian) const {
    Evaluate(Eigen::Map<const Vector>(x, NumParameters()));

    // a factor R of the products, R^T R = [J r]^T [J r] / scale^2
    const Eigen::Index p = NumParameters();
    const Eigen::LDLT<Square> factors(products_ / (scale_ * scale_));
    Square root = factors.transpositionsP() * Square::Identity(p + 1, p + 1);
    root = factors.matrixU() * root;
    root = factors.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal() * root;
    Eigen::Map<Eigen::VectorXd>(residuals, p + 1) = root.col(p);
    if (jacobian) {
      Eigen::Map<Eigen::MatrixXd>(jacobian, p + 1, p) = root.leftCols(p);
      trace_.push_back({x_, products_(p, p)});
    }
    return true;
  }

  /// [J r]^T [J r] at x, r = measured - modelled level.
  const Square& Evaluate(const Vector& x) const {
    if (x_ == x) return products_;
    x_ = x;
    const Thermal thermal{x[d_], std::exp(x[d_ + 1])};
    const double initial = Q == 3 ? x[d_ + Q - 1] : 0;
    const Eigen::VectorXd offset = offsets_ * x.tail(offsets_.cols());
    Square sums = Square::Zero(NumResiduals(), NumResiduals());
    Row row(NumResiduals());
    WithHolds(loop_.intervals(), thermal, [&](const auto& hold) {
      RunWithSensitivities<D>(loop_, x.data(), thermal.gain, initial, hold,
                              [&](Eigen::Index n, double level, const double* g, const double* S) {
                                if (kept_[n] == 0) return;
                                double residual = level_[n] - level;
                                if (D == Eigen::Dynamic) residual -= offset[n];
                                Accumulate(n, residual, g, S, row, sums);
                              });
    });
    products_ = sums.template selfadjointView<Eigen::Upper>();
    return products_;
  }

  std::vector<WarmIterate>& trace() const { return trace_; }

 private:
  /// Adds the row [-da/dx, r] of sample n to the upper half of the sums. row: for this use.
  void Accumulate(Eigen::Index n, double residual, const double* g, const double* S, Row& row,
                  Square& sums) const {
    const LoopSize<D> size(d_);
    const Eigen::Index d = size.value();
    const Eigen::Index q = D == Eigen::Dynamic ? offsets_.cols() : 0;
    for (Eigen::Index i = 0; i < d; ++i) row[i] = -(g[i] + S[i]);
    for (Eigen::Index i = d; i < d + Q; ++i) row[i] = -S[i];
    for (Eigen::Index i = 0; i < q; ++i) row[d + Q + i] = -offsets_(n, i);
    row[d + Q + q] = residual;
    if (kept_[n] != 1) row *= std::sqrt(kept_[n]);
    for (Eigen::Index j = 0; j < d + Q + q + 1; ++j) {
      for (Eigen::Index i = 0; i <= j; ++i) sums(i, j) += row[i] * row[j];
    }
  }

  const ClosedLoop& loop_;
  const Eigen::VectorXd& level_;
  const Eigen::MatrixXd& offsets_;
  const Eigen::VectorXd& kept_;
  double scale_;
  Eigen::Index d_;

  // the latest evaluation: Ceres asks for the residuals at a point, then for the derivatives there
  mutable Vector x_;
  mutable Square products_;
  mutable std::vector<WarmIterate> trace_;
};

template <int D, int Q>
WarmFit Solve(const CondensedProblem<D, Q>& problem, const Eigen::VectorXd& start) {
  using Solver = ceres::TinySolver<CondensedProblem<D, Q>>;
  Solver solver;
  solver.options.max_num_iterations = kMostIterations;
  solver.options.gradient_tolerance = 1e-10;
  solver.options.parameter_tolerance = 1e-11;
  solver.options.function_tolerance = 1e-10;  // of |r|^2, which is about the number of samples
  solver.options.initial_trust_region_radius = 1e8;
  typename Solver::Parameters x = start;
  solver.Solve(problem, &x);

  const Eigen::Index p = x.size();
  const auto& products = problem.Evaluate(x);
  WarmFit fit;
  fit.solution = {x, products(p, p)};
  fit.normal = products.topLeftCorner(p, p);
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

WarmFit FitWarmFriction(const ClosedLoop& loop, const Eigen::VectorXd& level,
                        const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                        const WarmStart& start, InitialEnergy initial_energy, double scale) {
  const Eigen::Index d = loop.levels().cols(), q = offsets.cols();
  const int warming = initial_energy == InitialEnergy::estimated ? 3 : 2;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(d + warming + q);
  x.head(d + 2) << start.parameters.head(d), start.thermal.gain,
      std::log(start.thermal.time_constant);
  x.tail(q) = start.parameters.tail(q);

  // sizes known at compile time for the common laws
  const auto solve = [&]<int D, int Q>() {
    return Solve(CondensedProblem<D, Q>(loop, level, offsets, kept, scale), x);
  };
  const auto solve_for = [&]<int D>() {
    return warming == 2 ? solve.template operator()<D, 2>() : solve.template operator()<D, 3>();
  };
  WarmFit fit;
  switch (q == 0 ? d : Eigen::Dynamic) {
    case 1:
      fit = solve_for.template operator()<1>();
      break;
    case 2:
      fit = solve_for.template operator()<2>();
      break;
    case 3:
      fit = solve_for.template operator()<3>();
      break;
    default:
      fit = solve_for.template operator()<Eigen::Dynamic>();
  }
  fit.law_parameters = d;
  fit.offsets = q;
  return fit;
}

}  // namespace warmjoint
