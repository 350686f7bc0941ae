#include "identification/warming/scan_time_constant.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace warmjoint {
namespace {

constexpr int kTaus = 16;
constexpr Eigen::Index kBlocks = 1000;
using Taus = Eigen::Array<double, kTaus, 1>;

/// Neighbouring samples taken together.
struct Averages {
  Eigen::VectorXd length;   // [m] duration, s
  Eigen::VectorXd loss;     // [m] mean of the measured loss over the duration, W
  Eigen::VectorXd weight;   // [m] number of kept samples
  ClosedLoop::Rows levels;  // [m x d] mean of g over the kept samples
  Eigen::VectorXd level;    // [m] mean of the measured level over them
  std::vector<bool> last;   // [m] whether the joint is cold after the block
};

Averages MakeAverages(const ClosedLoop& loop, const Eigen::VectorXd& level,
                      const Eigen::VectorXd& kept) {
  // blocks of as many samples each
  const Eigen::Index size = 1 + (loop.size() - 1) / kBlocks;
  const Eigen::Index m = (loop.size() + size - 1) / size;
  const Eigen::Index d = loop.levels().cols();
  const Intervals& intervals = loop.intervals();
  Averages blocks{Eigen::VectorXd::Zero(m), Eigen::VectorXd::Zero(m),
                  Eigen::VectorXd::Zero(m), ClosedLoop::Rows::Zero(m, d),
                  Eigen::VectorXd::Zero(m), std::vector<bool>(static_cast<size_t>(m))};

  for (Eigen::Index b = 0; b < m; ++b) {
    const Eigen::Index begin = b * size, end = std::min(loop.size(), begin + size);
    // length and losses of all samples, level of those that a fit uses
    double length = 0, loss = 0, weight = 0, mean = 0;
    for (Eigen::Index n = begin; n < end; ++n) {
      double h = intervals.length[intervals.which[n]];
      // an infinite interval ends a recording
      if (std::isinf(h)) {
        h = intervals.typical;
        blocks.last[static_cast<size_t>(b)] = true;
      }
      length += h;
      loss += h * loop.speed()[n] * level[n];
      weight += kept[n];
      mean += kept[n] * level[n];
    }
    // means over the block
    blocks.length[b] = length;
    blocks.loss[b] = loss / length;
    if (weight == 0) continue;
    blocks.weight[b] = weight;
    blocks.level[b] = mean / weight;
    // means of the law's columns over the same samples
    for (Eigen::Index i = 0; i < d; ++i) {
      double sum = 0;
      for (Eigen::Index n = begin; n < end; ++n) sum += kept[n] * loop.levels()(n, i);
      blocks.levels(b, i) = sum / weight;
    }
  }
  return blocks;
}

/// Inner products of the filtered loss x with the level, itself and the law's columns.
struct Products {
  Taus level = Taus::Zero();
  Taus self = Taus::Zero();
  Eigen::Array<double, kTaus, Eigen::Dynamic> columns;  // [kTaus x d]
};

/// Filters the loss with every tau at once; x in the middle of a block represents the block.
Products Filter(const Averages& blocks, const Taus& tau) {
  const Eigen::Index d = blocks.levels.cols();
  Products products;
  products.columns.setZero(kTaus, d);
  Taus x = Taus::Zero();
  ThermalHold<Taus> half = ThermalHold<Taus>::Over(Taus::Zero());
  double length = -1;
  // blocks of one length share their hold
  for (Eigen::Index b = 0; b < blocks.length.size(); ++b) {
    if (std::abs(blocks.length[b] - length) > 1e-6 * length) {
      length = blocks.length[b];
      half = ThermalHold<Taus>::Over(0.5 * length / tau);
    }
    const double loss = blocks.loss[b], weight = blocks.weight[b];
    // to the middle of the block, where it counts in the products
    x = half.After(x, loss);
    const Taus weighted = weight * x;
    products.level += weighted * blocks.level[b];
    products.self += weighted * x;
    for (Eigen::Index i = 0; i < d; ++i) products.columns.col(i) += weighted * blocks.levels(b, i);
    // to its end; the next recording starts cold
    x = half.After(x, loss);
    if (blocks.last[static_cast<size_t>(b)]) x = Taus::Zero();
  }
  return products;
}

/// A parabola through three points with even steps between them.
struct Parabola {
  double before, at, after;

  /// Offset of the maximum in steps, within half a step; 0 where there is none.
  double Peak() const {
    const double bend = before - 2 * at + after;
    return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
  }

  /// Value at an offset in steps from the middle point.
  double Value(double offset) const {
    return at + 0.5 * offset * ((after - before) + offset * (before - 2 * at + after));
  }
};

}  // namespace

InitialGuess ScanTimeConstant(const ClosedLoop& loop, const Eigen::VectorXd& torque,
                              const Eigen::VectorXd& kept) {
  const Averages blocks = MakeAverages(loop, loop.direction().cwiseProduct(torque), kept);
  const double total = blocks.length.sum();
  InitialGuess start;
  // time constants between those that the sampling and the duration can show, evenly in their logarithm
  start.shortest = std::max(2 * loop.intervals().typical, total / 500);
  start.longest = kScannedBeyond * total;
  const double step = std::log(start.longest / start.shortest) / (kTaus - 1);
  const Taus tau = start.shortest * (step * Taus::LinSpaced(0, kTaus - 1)).exp();
  const Products products = Filter(blocks, tau);

  // projections orthogonal to the law's columns: what is left of x and of its product with the level
  const Eigen::MatrixXd weighted = blocks.weight.asDiagonal() * blocks.levels;
  const Eigen::LDLT<Eigen::MatrixXd> normal(weighted.transpose() * blocks.levels);
  const Eigen::VectorXd nominal = normal.solve(weighted.transpose() * blocks.level);
  const Eigen::MatrixXd slopes = normal.solve(products.columns.matrix().transpose());
  const Taus left = products.level - (products.columns.matrix() * nominal).array();
  const Taus self = products.self - (products.columns * slopes.transpose().array()).rowwise().sum();

  // the tau that explains most
  const Taus gain = (self > 1e-9 * products.self).select(left / self, 0);
  const Taus explained = gain * left;
  Eigen::Index best = 0;
  explained.maxCoeff(&best);
  start.thermal = {gain[best], tau[best]};
  Eigen::VectorXd slope = slopes.col(best);
  // between grid points: the vertex of a parabola through the best and its neighbours
  if (best > 0 && best + 1 < kTaus) {
    const auto through = [best](const auto& values) {
      return Parabola{values[best - 1], values[best], values[best + 1]};
    };
    const double offset = through(explained).Peak();
    start.thermal = {through(gain).Value(offset), tau[best] * std::exp(step * offset)};
    for (Eigen::Index i = 0; i < slope.size(); ++i) slope[i] = through(slopes.row(i)).Value(offset);
  }

  // no more feedback than a loop that settles can have, k |v| < 1
  start.thermal.gain = std::min(start.thermal.gain, 0.9 / loop.speed().maxCoeff());
  start.parameters = nominal - start.thermal.gain * slope;
  return start;
}

InitialGuess ScanBeside(const RigidGuess& rigid, const ClosedLoop& loop,
                        const Eigen::VectorXd& torque, const Eigen::VectorXd& kept) {
  const Eigen::Index count = rigid.values.size();
  if (count == 0) return ScanTimeConstant(loop, torque, kept);
  InitialGuess start = ScanTimeConstant(loop, torque - rigid.columns * rigid.values, kept);
  start.parameters.tail(count) += rigid.values;
  return start;
}

}  // namespace warmjoint
