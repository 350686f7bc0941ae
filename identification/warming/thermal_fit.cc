#include "identification/warming/thermal_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "identification/forward/closed_loop_kernel.h"
#include "identification/forward/row_products.h"
#include "identification/model/minimise.h"
#include "identification/model/normal_equations.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {
namespace {

/// The residuals' variance over the prior variance of each unknown, or 0 without a prior. Jumps have one, and an E(0) that is expected. [p]
Eigen::VectorXd Prior(const ThermalRows& rows) {
  const Layout layout = rows.layout();
  const auto weight = [&](double spread) {
    return std::pow(rows.scale / std::max(spread, 1e-9 * rows.scale), 2);
  };
  Eigen::VectorXd prior = Eigen::VectorXd::Zero(layout.size());
  for (Eigen::Index i = 0; i < layout.jumps.size; ++i) {
    prior[layout.jumps.begin + i] = weight(rows.jump_spread[i]);
  }
  if (layout.start.size > 0 && rows.initial.is_expected()) {
    prior[layout.energy()] = weight(rows.initial.spread);
  }
  return prior;
}

/// Columns of [J r] for D law parameters and Q of warming; Dynamic where D is.
template <int D, int Q>
constexpr int kColumns = D == Eigen::Dynamic ? Eigen::Dynamic : D + Q + 1;

/// The products of one log's rows with each other, for any x. What is summed over the samples is compiled for each size
/// of the common laws; all else has its sizes at run time.
class LogProducts {
 public:
  explicit LogProducts(const ThermalRows& rows)
      : rows_(rows),
        layout_(rows.layout()),
        weight_(rows.weight.cwiseSqrt()),
        prior_(Prior(rows)) {}

  /// At x, over the log's variance. x: [p]
  RowSums At(const Eigen::VectorXd& x) {
    measured_ = rows_.level;
    if (layout_.rigid.size > 0) measured_ -= rows_.offsets * layout_.rigid.Of(x);
    const Eigen::MatrixXd products = SumProductsOfSize(x);

    // prior knowledge counts as rows of its own
    Eigen::VectorXd off = x;
    if (layout_.start.size > 0) off[layout_.energy()] -= rows_.initial.mean;
    const Eigen::Index p = layout_.size();
    const double variance = rows_.scale * rows_.scale;
    RowSums sums{products.topLeftCorner(p, p) / variance, products.col(p).head(p) / variance,
                 (products(p, p) + prior_.dot(off.cwiseAbs2())) / variance};
    sums.gram.diagonal() += prior_ / variance;
    sums.product -= prior_.cwiseProduct(off) / variance;
    return sums;
  }

 private:
  /// Sums the products over the samples at x. D: law parameters, or Dynamic, which jumps and offsets need; Q: gain,
  /// log(tau) and maybe E(0).
  template <int D, int Q>
  Eigen::MatrixXd SumProducts(const Eigen::VectorXd& x) const {
    const Thermal thermal = layout_.ThermalAt(x);
    const double initial = Q == 3 ? x[layout_.energy()] : 0;
    const double* jumps = x.data() + layout_.jumps.begin;
    // rows of the kept samples along one simulation
    const auto fill = [&](auto&& next) {
      WithHolds(rows_.loop.intervals(), thermal, [&](const auto& hold) {
        RunWithSensitivities<D>(
            rows_.loop, x.data(), thermal.gain, initial, jumps, hold,
            [&](Eigen::Index n, double level, const double* g, const double* S) {
              if (weight_[n] != 0) Fill<D, Q>(n, measured_[n] - level, g, S, next(n));
            });
      });
    };
    // a transform takes all rows at once; else they are summed as they come
    if (rows_.transform) return TransformedProducts(fill);
    RowProducts<kColumns<D, Q>> products(layout_.size() + 1);
    fill([&](Eigen::Index) { return products.Next(); });
    return products.Sums();
  }

  Eigen::MatrixXd SumProductsOfSize(const Eigen::VectorXd& x) const {
    const auto sum = [&]<int D>() {
      return layout_.start.size == 0 ? SumProducts<D, 2>(x) : SumProducts<D, 3>(x);
    };
    // sizes that the compiler knows, without jumps and offsets; else of any size
    switch (layout_.jumps.size + layout_.rigid.size == 0 ? layout_.law.size : Eigen::Dynamic) {
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

  /// The products of the mapped rows. The map is one of torque: rows of the level change
  /// their sign with the direction.
  template <typename FillRows>
  Eigen::MatrixXd TransformedProducts(const FillRows& fill) const {
    RowTransform::Rows rows(rows_.transform->size(), layout_.size() + 1);
    Eigen::VectorXd sign(rows_.transform->size());
    Eigen::Index count = 0;
    fill([&](Eigen::Index n) {
      sign[count] = rows_.loop.direction()[n];
      return rows.row(count++);
    });
    // levels back to torques, for whose noise the transform is
    rows.array().colwise() *= sign.array();
    rows_.transform->Apply(rows);
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(rows.cols(), rows.cols());
    products.selfadjointView<Eigen::Upper>().rankUpdate(rows.transpose());
    return products.selfadjointView<Eigen::Upper>();
  }

  /// Sets the row [da/dx, r] of sample n from the derivatives g [d] and S [d + 3 + J] of closed_loop_kernel.h.
  template <int D, int Q, typename Row>
  void Fill(Eigen::Index n, double residual, const double* g, const double* S, Row row) const {
    const Eigen::Index d = LoopSize<D>(layout_.law.size);
    const Eigen::Index q = D == Eigen::Dynamic ? layout_.rigid.size : 0;
    const Eigen::Index j = D == Eigen::Dynamic ? layout_.jumps.size : 0;
    const double w = weight_[n];
    // derivatives by law, warming, jumps and offsets, then the residual itself
    for (Eigen::Index i = 0; i < d; ++i) row[i] = w * (g[i] + S[i]);
    for (Eigen::Index i = d; i < d + Q; ++i) row[i] = w * S[i];
    for (Eigen::Index i = 0; i < j; ++i) row[d + Q + i] = w * S[d + 3 + i];
    for (Eigen::Index i = 0; i < q; ++i) row[d + Q + j + i] = w * rows_.offsets(n, i);
    row[d + Q + j + q] = w * residual;
  }

  ThermalRows rows_;
  Layout layout_;
  Eigen::VectorXd weight_;    // [N] of each row, the root of its square's
  Eigen::VectorXd prior_;     // [p]
  Eigen::VectorXd measured_;  // [N] level less what the offsets explain
};

}  // namespace

Layout ThermalRows::layout() const {
  return Layout::InOrder({{&Layout::law, loop.levels().cols()},
                          {&Layout::heat, 2},
                          {&Layout::start, initial.spread > 0 ? 1 : 0},
                          {&Layout::jumps, std::ssize(loop.jumps())},
                          {&Layout::rigid, offsets.cols()}});
}

InitialGuess StartFrom(const ThermalFit& fit) {
  InitialGuess start;
  start.parameters.resize(fit.layout.law.size + fit.layout.rigid.size);
  start.parameters << fit.law(), fit.rigid();
  start.thermal = fit.thermal();
  return start;
}

ThermalFit FitThermalFriction(const ThermalRows& rows, const InitialGuess& start) {
  ThermalFit fit;
  fit.layout = rows.layout();
  fit.initial = rows.initial;
  fit.prior = Prior(rows);
  // from the scanned law and heat, without jumps, with the E(0) that is expected
  const Layout& at = fit.layout;
  fit.x = Eigen::VectorXd::Zero(at.size());
  at.law.In(fit.x) = start.parameters.head(at.law.size);
  fit.x[at.gain()] = start.thermal.gain;
  fit.x[at.log_time_constant()] = std::log(start.thermal.time_constant);
  if (at.start.size > 0) fit.x[at.energy()] = rows.initial.mean;
  at.rigid.In(fit.x) = start.parameters.tail(at.rigid.size);

  LogProducts products(rows);
  SquaresProblem problem;
  problem.sums = [&](const Eigen::VectorXd& x) { return products.At(x); };
  problem.least = rows.weight.sum() * RoundingVariance(rows.level) / (rows.scale * rows.scale);
  Minimum found = Minimise(problem, fit.x);
  fit.x = std::move(found.x);
  fit.squares = found.sums.squares;
  fit.cofactor = Cofactor(found.sums.gram);
  fit.trace = std::move(found.trace);
  fit.converged = found.converged && fit.x.allFinite();

  // squares are the torque's
  const double variance = rows.scale * rows.scale;
  for (FitPoint& iterate : fit.trace) iterate.squares *= variance;
  fit.squares *= variance;
  fit.cofactor /= variance;
  return fit;
}

}  // namespace warmjoint
