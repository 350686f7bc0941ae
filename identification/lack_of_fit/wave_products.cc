#include "identification/lack_of_fit/wave_products.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/lack_of_fit/column_products.h"

namespace warmjoint {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kAside =
    8;  // steps on either side of a centre; why: as many centres as that for some 200 frequencies
constexpr Index kRun = 64;                // angles; why: as many runs as that for some 4000
constexpr Index kApart = 2 * kAside + 1;  // steps between centres

/// Waves whose angles are the sums of those of two waves. Both [m x 2].
template <typename A, typename B>
MatrixXd Sum(const A& a, const B& b) {
  MatrixXd sum(a.rows(), 2);
  sum.col(0) = a.col(0).cwiseProduct(b.col(0)) - a.col(1).cwiseProduct(b.col(1));
  sum.col(1) = a.col(1).cwiseProduct(b.col(0)) + a.col(0).cwiseProduct(b.col(1));
  return sum;
}

/// Waves whose angles are a start and multiples of a turn, `count` of each: a pair after the other. [m x 2 count]
MatrixXd Turning(const MatrixXd& start, const MatrixXd& turn, Index count) {
  MatrixXd waves(start.rows(), 2 * count);
  waves.leftCols(2) = start;
  for (Index k = 1; k < count; ++k) {
    waves.middleCols(2 * k, 2) = Sum(waves.middleCols(2 * k - 2, 2), turn);
  }
  return waves;
}

}  // namespace

MatrixXd Waves(const ArrayXd& angles) {
  MatrixXd waves(angles.size(), 2);
  for (Index i = 0; i < angles.size(); ++i) {
    // of one number, so that both come out of one call
    const double angle = angles[i];
    waves(i, 0) = std::cos(angle);
    waves(i, 1) = std::sin(angle);
  }
  return waves;
}

MatrixXd EvenWaves(double first, double step, Index count) {
  const Index runs = (count + kRun - 1) / kRun;
  const MatrixXd begins =
      Waves(ArrayXd::LinSpaced(runs, 0, static_cast<double>(runs - 1)) * (step * kRun) + first);
  const MatrixXd within = Waves(ArrayXd::LinSpaced(kRun, 0, kRun - 1) * step);
  MatrixXd waves(count, 2);
  for (Index run = 0; run < runs; ++run) {
    const Index size = std::min<Index>(kRun, count - run * kRun);
    const double c = begins(run, 0), s = begins(run, 1);
    auto of_run = waves.middleRows(run * kRun, size);
    of_run.col(0) = c * within.col(0).head(size) - s * within.col(1).head(size);
    of_run.col(1) = s * within.col(0).head(size) + c * within.col(1).head(size);
  }
  return waves;
}

MatrixXd WaveProducts(const Eigen::VectorXd& values, const Eigen::VectorXd& times,
                      const Frequencies& frequencies) {
  // waves of up to kAside steps, and of the centres, each times its value
  const auto& [step, first, count] = frequencies;
  const Index centres = (count + kApart - 1) / kApart;
  const MatrixXd one = Waves(2 * std::numbers::pi * step * times.array());
  const MatrixXd aside = Turning(one, one, kAside);
  const auto last = aside.rightCols(2);
  // the first centre lies kAside steps above the first frequency
  MatrixXd centre = values.asDiagonal() * last;
  for (Index below = first; below > 0; below -= kAside) {
    centre = Sum(centre, aside.middleCols(2 * std::min(below, kAside) - 2, 2));
  }
  const MatrixXd centred = Turning(centre, Sum(Sum(last, last), one), centres);

  // cosines and sines of centres, with those of steps, and by themselves
  const MatrixXd products = ProductsBetween(centred, aside);
  const Eigen::RowVectorXd alone = centred.colwise().sum();

  // each frequency from its centre and its steps
  MatrixXd sums(count, 2);
  for (Index k = 0; k < count; ++k) {
    const Index centre_of = k / kApart, steps = k % kApart - kAside;
    if (steps == 0) {
      sums.row(k) = alone.segment<2>(2 * centre_of);
      continue;
    }
    // [cos cos, cos sin; sin cos, sin sin]
    const Eigen::Matrix2d both = products.block<2, 2>(2 * centre_of, 2 * (std::abs(steps) - 1));
    const double side = steps < 0 ? -1 : 1;
    sums(k, 0) = both(0, 0) - side * both(1, 1);
    sums(k, 1) = both(1, 0) + side * both(0, 1);
  }
  return sums;
}

}  // namespace warmjoint
