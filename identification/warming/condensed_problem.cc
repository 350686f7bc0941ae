#include "identification/warming/condensed_problem.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "identification/forward/closed_loop_kernel.h"
#include "identification/forward/row_products.h"

namespace warmjoint {
namespace {

/// Columns of [J r] for D law parameters and Q of warming; Dynamic where D is.
template <int D, int Q>
constexpr int kColumns = D == Eigen::Dynamic ? Eigen::Dynamic : D + Q + 1;

}  // namespace

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

}  // namespace warmjoint
