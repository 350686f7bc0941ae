#include "identification/warming/thermal_fit.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "identification/forward/closed_loop_kernel.h"
#include "identification/forward/row_products.h"

namespace warmjoint {
namespace {

/// What pulls E(0) to its expected value: weight (E(0) - mean)^2 beside the squared residuals.
struct StartPull {
  double mean = 0;    // N.m or N
  double weight = 0;  // of one squared residual
};

/// The condensed least-squares problem, as ceres::TinySolver wants it, over law parameters (d), k, log tau, E(0) where
/// it is estimated, jumps of E (J) and offsets (q). What is summed over the samples is compiled for each size of the
/// common laws; all else has its sizes at run time.
class CondensedProblem {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = Eigen::Dynamic, NUM_RESIDUALS = Eigen::Dynamic };

  /// warming: 2 for (k, log tau), 3 with E(0); jump_weights: [J] what each jump's square counts beside the squared
  /// residuals; pull: on E(0), where it is estimated; transform: of the rows, in the order of the samples that count;
  /// or none. The references are to outlive the problem.
  CondensedProblem(const ClosedLoop& loop, const Eigen::VectorXd& level,
                   const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                   const Eigen::VectorXd& jump_weights, int warming, const StartPull& pull,
                   double scale, const RowTransform* transform = nullptr);

  int NumParameters() const { return static_cast<int>(x_.size()); }
  int NumResiduals() const { return NumParameters() + 1; }

  /// A square factor R of the products, R^T R = [J r]^T [J r] / scale^2: its last column is the residuals [p + 1], the
  /// others the jacobian [p + 1 x p], where one is asked for.
  bool operator()(const double* x, double* residuals, double* jacobian) const;

  /// [J r]^T [J r] at x, r = measured - modelled level. [p + 1 x p + 1]
  const Eigen::MatrixXd& Evaluate(const Eigen::VectorXd& x) const;

  std::vector<ThermalIterate>& trace() const { return trace_; }

 private:
  /// Sums the products over the samples at x_. D: law parameters, or Dynamic, which jumps and offsets need; Q: warming.
  template <int D, int Q>
  void SumProducts() const;
  void SumProductsOfSize() const;

  /// The products of the mapped rows. The map is one of torque: rows of the level change
  /// their sign with the direction.
  template <typename FillRows>
  Eigen::MatrixXd TransformedProducts(const FillRows& fill) const;

  /// Sets the row [-da/dx, r] of sample n from the derivatives g [d] and S [d + 3 + J] of closed_loop_kernel.h.
  template <int D, int Q, typename Row>
  void Fill(Eigen::Index n, double residual, const double* g, const double* S, Row row) const;

  /// Adds the row sqrt(w) [-1, -b] of parameter i, which lies b from what it is known for but for its
  /// spread.
  void AddKnown(Eigen::Index i, double w, double b) const;

  const ClosedLoop& loop_;
  const Eigen::VectorXd& level_;
  const Eigen::MatrixXd& offsets_;
  Eigen::VectorXd weight_;        // [N] of each row, the root of its square's
  Eigen::VectorXd jump_weights_;  // [J]
  int warming_;
  StartPull pull_;
  double scale_;
  const RowTransform* transform_;
  Eigen::Index d_;

  // the latest evaluation: Ceres asks for the residuals at a point, then for the derivatives there
  mutable Eigen::VectorXd x_;         // [p]
  mutable Eigen::VectorXd measured_;  // [N] level less what the offsets explain
  mutable Eigen::MatrixXd products_;  // [p + 1 x p + 1]
  mutable std::vector<ThermalIterate> trace_;
};

/// Columns of [J r] for D law parameters and Q of warming; Dynamic where D is.
template <int D, int Q>
constexpr int kColumns = D == Eigen::Dynamic ? Eigen::Dynamic : D + Q + 1;

CondensedProblem::CondensedProblem(const ClosedLoop& loop, const Eigen::VectorXd& level,
                                   const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                                   const Eigen::VectorXd& jump_weights, int warming,
                                   const StartPull& pull, double scale,
                                   const RowTransform* transform)
    : loop_(loop),
      level_(level),
      offsets_(offsets),
      weight_(kept.cwiseSqrt()),
      jump_weights_(jump_weights),
      warming_(warming),
      pull_(pull),
      scale_(scale),
      transform_(transform),
      d_(loop.levels().cols()),
      x_(Eigen::VectorXd::Constant(d_ + warming + jump_weights.size() + offsets.cols(),
                                   std::numeric_limits<double>::quiet_NaN())) {}

bool CondensedProblem::operator()(const double* x, double* residuals, double* jacobian) const {
  Evaluate(Eigen::Map<const Eigen::VectorXd>(x, NumParameters()));

  // a factor R of the products, R^T R = [J r]^T [J r] / scale^2
  const Eigen::Index p = NumParameters();
  const Eigen::LDLT<Eigen::MatrixXd> factors(products_ / (scale_ * scale_));
  Eigen::MatrixXd root = factors.transpositionsP() * Eigen::MatrixXd::Identity(p + 1, p + 1);
  root = factors.matrixU() * root;
  root = factors.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal() * root;
  // residual and Jacobian of p + 1 rows, with the same squares as those of all samples
  Eigen::Map<Eigen::VectorXd>(residuals, p + 1) = root.col(p);
  if (jacobian) {
    Eigen::Map<Eigen::MatrixXd>(jacobian, p + 1, p) = root.leftCols(p);
    trace_.push_back({x_, products_(p, p)});
  }
  return true;
}

const Eigen::MatrixXd& CondensedProblem::Evaluate(const Eigen::VectorXd& x) const {
  if (x_ == x) return products_;
  x_ = x;

  // what the samples tell
  measured_ = level_;
  if (offsets_.cols() > 0) measured_ -= offsets_ * x_.tail(offsets_.cols());
  SumProductsOfSize();

  // what is known beside them
  for (Eigen::Index i = 0; i < jump_weights_.size(); ++i) {
    AddKnown(d_ + warming_ + i, jump_weights_[i], x_[d_ + warming_ + i]);
  }
  if (warming_ == 3) AddKnown(d_ + 2, pull_.weight, x_[d_ + 2] - pull_.mean);
  return products_;
}

void CondensedProblem::SumProductsOfSize() const {
  const auto sum = [&]<int D>() { warming_ == 2 ? SumProducts<D, 2>() : SumProducts<D, 3>(); };
  // sizes that the compiler knows, without jumps and offsets; else of any size
  switch (jump_weights_.size() + offsets_.cols() == 0 ? d_ : Eigen::Dynamic) {
    case 1:
      return sum.template operator()<1>();
    case 2:
      return sum.template operator()<2>();
    case 3:
      return sum.template operator()<3>();
    default:
      return sum.template operator()<Eigen::Dynamic>();
  }
}

template <int D, int Q>
void CondensedProblem::SumProducts() const {
  const Thermal thermal{x_[d_], std::exp(x_[d_ + 1])};
  const double initial = Q == 3 ? x_[d_ + 2] : 0;
  const double* jumps = x_.data() + d_ + Q;
  // rows of the kept samples along one simulation
  const auto fill = [&](auto&& next) {
    WithHolds(loop_.intervals(), thermal, [&](const auto& hold) {
      RunWithSensitivities<D>(loop_, x_.data(), thermal.gain, initial, jumps, hold,
                              [&](Eigen::Index n, double level, const double* g, const double* S) {
                                if (weight_[n] != 0)
                                  Fill<D, Q>(n, measured_[n] - level, g, S, next(n));
                              });
    });
  };
  // a transform takes all rows at once; else they are summed as they come
  if (transform_) {
    products_ = TransformedProducts(fill);
    return;
  }
  RowProducts<kColumns<D, Q>> products(NumResiduals());
  fill([&](Eigen::Index) { return products.Next(); });
  products_ = products.Sums();
}

template <typename FillRows>
Eigen::MatrixXd CondensedProblem::TransformedProducts(const FillRows& fill) const {
  RowTransform::Rows rows(transform_->size(), NumResiduals());
  Eigen::VectorXd sign(transform_->size());
  Eigen::Index count = 0;
  fill([&](Eigen::Index n) {
    sign[count] = loop_.direction()[n];
    return rows.row(count++);
  });
  // levels back to torques, whose noise the transform knows
  rows.array().colwise() *= sign.array();
  transform_->Apply(rows);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(rows.cols(), rows.cols());
  products.selfadjointView<Eigen::Upper>().rankUpdate(rows.transpose());
  return products.selfadjointView<Eigen::Upper>();
}

template <int D, int Q, typename Row>
void CondensedProblem::Fill(Eigen::Index n, double residual, const double* g, const double* S,
                            Row row) const {
  const LoopSize<D> size(d_);
  const Eigen::Index d = size.value();
  const Eigen::Index q = D == Eigen::Dynamic ? offsets_.cols() : 0;
  const Eigen::Index j = D == Eigen::Dynamic ? jump_weights_.size() : 0;
  const double w = weight_[n];
  // derivatives by law, warming, jumps and offsets, then the residual itself
  for (Eigen::Index i = 0; i < d; ++i) row[i] = -w * (g[i] + S[i]);
  for (Eigen::Index i = d; i < d + Q; ++i) row[i] = -w * S[i];
  for (Eigen::Index i = 0; i < j; ++i) row[d + Q + i] = -w * S[d + 3 + i];
  for (Eigen::Index i = 0; i < q; ++i) row[d + Q + j + i] = -w * offsets_(n, i);
  row[d + Q + j + q] = w * residual;
}

void CondensedProblem::AddKnown(Eigen::Index i, double w, double b) const {
  const Eigen::Index last = products_.rows() - 1;
  products_(i, i) += w;
  products_(i, last) += w * b;
  products_(last, i) += w * b;
  products_(last, last) += w * b * b;
}

constexpr int kMostIterations = 50;

ThermalFit Solve(const CondensedProblem& problem, const Eigen::VectorXd& start) {
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
  ThermalFit fit;
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

Thermal ThermalFit::thermal() const {
  return {solution.x[law_parameters], std::exp(solution.x[law_parameters + 1])};
}

Eigen::VectorXd ThermalFit::parameters() const { return solution.x.head(law_parameters); }

double ThermalFit::initial_energy() const {
  return estimates_initial_energy() ? solution.x[law_parameters + 2] : 0;
}

Eigen::VectorXd ThermalFit::jump_values() const {
  const Eigen::Index count = jump_weights.size();
  return solution.x.segment(solution.x.size() - offsets - count, count);
}

Eigen::VectorXd ThermalFit::prior() const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(solution.x.size());
  all.segment(all.size() - offsets - jump_weights.size(), jump_weights.size()) = jump_weights;
  if (estimates_initial_energy()) all[law_parameters + 2] = start_weight;
  return all;
}

InitialGuess StartFrom(const ThermalFit& fit) {
  InitialGuess start;
  start.parameters.resize(fit.law_parameters + fit.offsets);
  start.parameters << fit.parameters(), fit.offset_values();
  start.thermal = fit.thermal();
  return start;
}

ThermalFit FitThermalFriction(const ClosedLoop& loop, const Eigen::VectorXd& level,
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

  ThermalFit fit = Solve(
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
