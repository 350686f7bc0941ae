#include "identification/preparation/column_lag.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "identification/preparation/local_motion.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kCertain = 5;    // standard errors; why 5: by chance 1 in 2 million
constexpr double kOfAStep = 0.1;  // why: an inertia takes as little from a slope as its own error
// why: friction at that speed changes by less than a hundredth
constexpr double kOfTheSpeed = 0.01;
constexpr Index kFewest = 30;    // windows; why: their scatter is known to a seventh
constexpr Index kLongest = 256;  // samples of a window; why: longer ones hold whole motions
constexpr double kBend = 1.345;  // deviations; why: Huber's loss keeps 95 % of efficiency there
constexpr int kRounds = 5;       // of its weights

/// Windows one after the other: by how much the integral of the column exceeds the positions' change, and columns that explain it.
struct Windows {
  VectorXd excess;      // [n] rad or m
  Eigen::MatrixX3d by;  // [n x 3] change of velocity, duration, change of position
};

Windows WindowsOf(const Measurements& m, const std::vector<SampleRange>& pieces, Index length) {
  std::vector<Index> begins;
  for (const SampleRange& piece : pieces) {
    for (Index i = piece.first; i + length < piece.end(); i += length) begins.push_back(i);
  }
  const auto n = static_cast<Index>(begins.size());
  Windows windows{VectorXd(n), Eigen::MatrixX3d(n, 3)};
  for (Index k = 0; k < n; ++k) {
    const Index first = begins[static_cast<size_t>(k)], last = first + length;
    double integral = 0;
    for (Index i = first; i < last; ++i) {
      integral += 0.5 * (m.velocity[i] + m.velocity[i + 1]) * (m.time[i + 1] - m.time[i]);
    }
    const double change = m.position[last] - m.position[first];
    windows.excess[k] = integral - change;
    windows.by.row(k) << m.velocity[last] - m.velocity[first], m.time[last] - m.time[first], change;
  }
  return windows;
}

/// Least squares with weights by Huber's loss.
struct Solved {
  Eigen::Vector3d x;
  Eigen::Vector3d error;  // standard errors
};

std::optional<Solved> Solve(const Windows& windows) {
  const Index n = windows.excess.size();
  VectorXd weights = VectorXd::Ones(n);
  Solved solved;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Matrix3d normal = windows.by.transpose() * weights.asDiagonal() * windows.by;
    const Eigen::LDLT<Eigen::Matrix3d> factors(normal);
    if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-14)) return std::nullopt;
    solved.x = factors.solve(windows.by.transpose() * weights.cwiseProduct(windows.excess));
    const VectorXd left = (windows.excess - windows.by * solved.x).cwiseAbs();
    const double scale = MedianOf(left) / 0.6745;  // of |z|, z a standard normal variable
    // an exact column has no errors
    if (!(scale > 0)) {
      solved.error.setZero();
      return solved;
    }
    weights = (kBend * scale * left.cwiseMax(kBend * scale).cwiseInverse()).eval();
    solved.error =
        scale * factors.solve(Eigen::Matrix3d::Identity()).diagonal().cwiseMax(0).cwiseSqrt();
  }
  return solved;
}

}  // namespace

bool ColumnAgainstSlope::IsLate() const {
  return lag > std::max(kOfAStep * step, kCertain * lag_error);
}

bool ColumnAgainstSlope::IsOff() const {
  return std::abs(offset) > std::max(kOfTheSpeed * speed, kCertain * offset_error);
}

std::optional<ColumnAgainstSlope> CompareColumn(const Measurements& m) {
  const std::vector<SampleRange> pieces = PiecesOf(m.time);
  const double n = static_cast<double>(m.size());
  std::optional<ColumnAgainstSlope> best;
  for (Index length = 4; length <= kLongest; length *= 2) {
    const Windows windows = WindowsOf(m, pieces, length);
    if (windows.excess.size() < kFewest) break;
    const auto solved = Solve(windows);
    if (!solved || (best && solved->error[0] >= best->lag_error)) continue;
    best =
        ColumnAgainstSlope{-solved->x[0],    solved->error[0],   solved->x[1],
                           solved->error[1], MedianStep(m.time), m.velocity.norm() / std::sqrt(n)};
  }
  return best;
}

std::string Describe(const ColumnAgainstSlope& column, JointKind joint) {
  std::string how;
  if (column.IsLate()) {
    how = fmt::format("lags its positions by {:.3g} ms ({:.2g} samples)", 1e3 * column.lag,
                      column.lag / column.step);
  }
  if (column.IsOff()) {
    how += fmt::format("{}is off by {:.3g} {}, its speed at rest", how.empty() ? "" : " and ",
                       column.offset, kVelocityUnit.For(joint));
  }
  return fmt::format("the velocity column {}, so the velocity is computed from the positions", how);
}

}  // namespace warmjoint
