// Warm friction's least squares over N samples, condensed to as many residuals as parameters.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <vector>

#include "identification/forward/closed_loop_kernel.h"
#include "identification/forward/row_products.h"
#include "identification/uncertainty/row_transform.h"
#include "identification/warming/warm_fit.h"

namespace warmjoint::inline identification {

/// Sums n, or Dynamic where one of them is.
constexpr int Plus(int a, int b) { return a == Eigen::Dynamic ? a : a + b; }

/// What pulls E(0) to its expected value: weight (E(0) - mean)^2 beside the squared residuals.
struct StartPull {
  double mean = 0;    // N.m or N
  double weight = 0;  // of one squared residual
};

/// The condensed least-squares problem, as ceres::TinySolver wants it. D: law parameters, Q: 2 for
/// (k, log tau), 3 with E(0). Jumps of E and offsets come last, and only where D is Dynamic.
template <int D, int Q>
class CondensedProblem {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = Plus(D, Q), NUM_RESIDUALS = Plus(D, Q + 1) };
  using Square = Eigen::Matrix<double, NUM_RESIDUALS, NUM_RESIDUALS>;
  using Vector = Eigen::Matrix<double, NUM_PARAMETERS, 1>;

  /// jump_weights: [J] what each jump's square counts beside the squared residuals; pull: on E(0), where
  /// Q is 3; transform: of the rows, in the order of the samples that count; or none.
  CondensedProblem(const ClosedLoop& loop, const Eigen::VectorXd& level,
                   const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                   const Eigen::VectorXd& jump_weights, const StartPull& pull, double scale,
                   const RowTransform* transform = nullptr)
      : loop_(loop),
        level_(level),
        offsets_(offsets),
        weight_(kept.cwiseSqrt()),
        jump_weights_(jump_weights),
        pull_(pull),
        scale_(scale),
        transform_(transform),
        d_(loop.levels().cols()),
        x_(Vector::Constant(NumParameters(), std::numeric_limits<double>::quiet_NaN())) {}

  int NumParameters() const {
    return static_cast<int>(d_ + jump_weights_.size() + offsets_.cols()) + Q;
  }
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
    if (D == Eigen::Dynamic) measured_ = level_ - offsets_ * x.tail(offsets_.cols());
    const double* measured = D == Eigen::Dynamic ? measured_.data() : level_.data();
    const auto fill = [&](auto&& next) {
      WithHolds(loop_.intervals(), thermal, [&](const auto& hold) {
        RunWithSensitivities<D>(
            loop_, x.data(), thermal.gain, initial, x.data() + d_ + Q, hold,
            [&](Eigen::Index n, double level, const double* g, const double* S) {
              if (weight_[n] != 0) Fill(n, measured[n] - level, g, S, next(n));
            });
      });
    };
    if (transform_) {
      products_ = TransformedProducts(fill);
    } else {
      RowProducts<NUM_RESIDUALS> products(NumResiduals());
      fill([&](Eigen::Index) { return products.Next(); });
      products_ = products.Sums();
    }
    if (D == Eigen::Dynamic) {
      for (Eigen::Index i = 0; i < jump_weights_.size(); ++i) {
        AddKnown(d_ + Q + i, jump_weights_[i], x[d_ + Q + i]);
      }
    }
    if (Q == 3) AddKnown(d_ + 2, pull_.weight, initial - pull_.mean);
    return products_;
  }

  std::vector<WarmIterate>& trace() const { return trace_; }

 private:
  /// The products of the mapped rows. The map is one of torque: rows of the level change
  /// their sign with the direction.
  template <typename Fill>
  Square TransformedProducts(Fill&& fill) const {
    RowTransform::Rows rows(transform_->size(), NumResiduals());
    Eigen::VectorXd sign(transform_->size());
    Eigen::Index count = 0;
    fill([&](Eigen::Index n) {
      sign[count] = loop_.direction()[n];
      return rows.row(count++);
    });
    rows.array().colwise() *= sign.array();
    transform_->Apply(rows);
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(rows.cols(), rows.cols());
    products.selfadjointView<Eigen::Upper>().rankUpdate(rows.transpose());
    return products.selfadjointView<Eigen::Upper>();
  }

  /// Adds the row sqrt(w) [-1, -b] of parameter i, which lies b from what it is known for but for its
  /// spread.
  void AddKnown(Eigen::Index i, double w, double b) const {
    const Eigen::Index last = products_.rows() - 1;
    products_(i, i) += w;
    products_(i, last) += w * b;
    products_(last, i) += w * b;
    products_(last, last) += w * b * b;
  }

  /// Sets the row [-da/dx, r] of sample n.
  template <typename Row>
  void Fill(Eigen::Index n, double residual, const double* g, const double* S, Row row) const {
    const LoopSize<D> size(d_);
    const Eigen::Index d = size.value();
    const Eigen::Index q = D == Eigen::Dynamic ? offsets_.cols() : 0;
    const Eigen::Index j = D == Eigen::Dynamic ? jump_weights_.size() : 0;
    const double w = weight_[n];
    for (Eigen::Index i = 0; i < d; ++i) row[i] = -w * (g[i] + S[i]);
    for (Eigen::Index i = d; i < d + Q; ++i) row[i] = -w * S[i];
    for (Eigen::Index i = 0; i < j; ++i) row[d + Q + i] = -w * S[d + 3 + i];
    for (Eigen::Index i = 0; i < q; ++i) row[d + Q + j + i] = -w * offsets_(n, i);
    row[d + Q + j + q] = w * residual;
  }

  const ClosedLoop& loop_;
  const Eigen::VectorXd& level_;
  const Eigen::MatrixXd& offsets_;
  Eigen::VectorXd weight_;        // [N] of each row, the root of its square's
  Eigen::VectorXd jump_weights_;  // [J]
  StartPull pull_;
  double scale_;
  const RowTransform* transform_;
  Eigen::Index d_;

  // the latest evaluation: Ceres asks for the residuals at a point, then for the derivatives there
  mutable Vector x_;
  mutable Eigen::VectorXd measured_;  // [N] level less what the offsets explain
  mutable Square products_;
  mutable std::vector<WarmIterate> trace_;
};

}  // namespace warmjoint::inline identification
