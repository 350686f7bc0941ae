#include "identification/fields/field_block.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "identification/linear/linear_laws.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// numbers of knots; why: with half of them intervals of halves of real logs agree less often
constexpr Index kPlaceKnots = 40, kFewestPlaceKnots = 8, kTimeKnots = 24, kSpeedKnots = 10,
                kTemperatureKnots = 8;
constexpr double kPlaceSpacing =
    0.05;  // rad; why: what is finer returns within a row and acts as noise
constexpr double kTurn = 2 * std::numbers::pi;
// of the travel, and rad; why: what is longer, a law, gravity or a curve over the speed can imitate
constexpr double kLongestOfTravel = 1.0 / 20, kLongestAngle = 0.32, kLongestPart = 1.0 / 5;
constexpr double kShortestOfTravel = 1.0 / 40, kShortestInKnots = 1.5;
constexpr int kPlaceLengths = 5;
constexpr double kFewLengths = 1.3;  // why: between lengths this near there is nothing to choose
constexpr double kNugget = 1e-6;     // of a kernel's variance; why: rounding leaves less
constexpr double kFastest = 0.99;    // quantile of the speed
constexpr double kOneWay = 0.03;     // share of the rows
constexpr double kLeastSpeedRange = 0.05;

/// exp(-d/l), and Matern 3/2: (1 + sqrt(3) d/l) exp(-sqrt(3) d/l)
MatrixXd Exponential(const MatrixXd& distance, double length) {
  return (-distance.array() / length).exp();
}
MatrixXd Matern(const MatrixXd& distance, double length) {
  const Eigen::ArrayXXd x = std::numbers::sqrt3 / length * distance.array();
  return (1 + x) * (-x).exp();
}

/// Gives a block its lengths, and the kernel at each.
void AddKernels(std::vector<double> lengths, MatrixXd (*kernel)(const MatrixXd&, double),
                FieldBlock& block) {
  const MatrixXd distances = block.knots.Distances();
  for (const double length : lengths) block.kernels.push_back(kernel(distances, length));
  block.lengths = std::move(lengths);
}

Knots Even(double first, double last, Index count) {
  return {VectorXd::LinSpaced(count, first, last), std::nullopt};
}

/// Knots over the position of the rows.
Knots PlaceKnots(const VectorXd& position, JointKind joint) {
  const double first = position.minCoeff(), last = position.maxCoeff(), travel = last - first;
  if (joint == JointKind::linear) return Even(first, last, kPlaceKnots);
  if (travel > 2 * kTurn) {
    return {VectorXd::LinSpaced(kPlaceKnots + 1, 0, kTurn).head(kPlaceKnots), kTurn};
  }
  const auto count = static_cast<Index>(travel / kPlaceSpacing);
  return Even(first, last, std::clamp(count, kFewestPlaceKnots, kPlaceKnots));
}

/// Lengths of a field over the position.
std::vector<double> PlaceLengths(const Knots& knots, JointKind joint) {
  const double extent = knots.period ? *knots.period : knots.at[knots.size() - 1] - knots.at[0];
  const double spacing = knots.at[1] - knots.at[0];
  double longest = kLongestOfTravel * extent;
  if (joint == JointKind::rotary) {
    longest = std::max(longest, std::min(kLongestAngle, kLongestPart * extent));
  }
  const double shortest = std::max(kShortestInKnots * spacing, kShortestOfTravel * extent);
  if (longest <= kFewLengths * shortest) return {std::min(shortest, longest), longest};
  std::vector<double> lengths;
  for (int i = 0; i < kPlaceLengths; ++i) {
    lengths.push_back(shortest * std::pow(longest / shortest, i / (kPlaceLengths - 1.0)));
  }
  return lengths;
}

/// K -> P K P^T, P = I - N (W N)^+ W: values whose weighed sums are 0. others: N, [m x d]; weights: W, [d x m]
void MakeOrthogonal(const MatrixXd& others, const MatrixXd& weights, FieldBlock& block) {
  const MatrixXd inverse = (weights * others).completeOrthogonalDecomposition().pseudoInverse();
  const MatrixXd project =
      MatrixXd::Identity(block.size(), block.size()) - others * inverse * weights;
  for (MatrixXd& kernel : block.kernels) kernel = project * kernel * project.transpose();
}

/// The mean of a block's columns over the motion, without signs. [m]
VectorXd MeanInMotion(const FieldBlock& block, const FieldMotion& motion) {
  const SparseRows columns = block.UnsignedAt(motion);
  const auto samples = static_cast<double>(std::max<Index>(columns.rows(), 1));
  return columns.transpose() * VectorXd::Constant(columns.rows(), 1 / samples);
}

/// The root of the speed among the knots.
VectorXd RootOfSpeed(const VectorXd& velocity, double fastest) {
  return (velocity.cwiseAbs() / fastest).cwiseSqrt();
}

FieldBlock OverPlace(FieldKind kind, double scale, const FieldRows& rows, JointKind joint) {
  FieldBlock block{.kind = kind, .knots = PlaceKnots(rows.position, joint)};
  AddKernels(PlaceLengths(block.knots, joint), Matern, block);
  block.amplitude_scale = scale;
  return block;
}

/// Knots over the time of each recording.
Knots TimeKnots(const FieldRows& rows) {
  const std::vector<SampleRange> recordings = CutAt(rows.starts, rows.size());
  const auto length = [&](const SampleRange& one) {
    return rows.time[one.end() - 1] - rows.time[one.first];
  };
  double all = 0;
  for (const SampleRange& one : recordings) all += length(one);
  Knots knots;
  for (const SampleRange& one : recordings) {
    const auto count = std::lround(static_cast<double>(kTimeKnots) * length(one) / all);
    const double first = rows.time[one.first];
    const double last = std::max(rows.time[one.end() - 1], first + rows.step);
    const Index m = std::max<Index>(count, 2), begin = knots.size();
    if (begin > 0) knots.starts.push_back(begin);
    knots.at.conservativeResize(begin + m);
    knots.at.tail(m) = VectorXd::LinSpaced(m, first, last);
  }
  return knots;
}

FieldBlock OverTime(FieldKind kind, double scale, const FieldRows& rows) {
  FieldBlock block{.kind = kind, .knots = TimeKnots(rows)};
  double longest = 0;
  for (const SampleRange& piece : block.knots.Pieces()) {
    longest = std::max(longest, block.knots.at[piece.end() - 1] - block.knots.at[piece.first]);
  }
  AddKernels({0.1 * longest, 1.0 / 3 * longest, longest, 4 * longest}, Exponential, block);
  block.amplitude_scale = scale;
  return block;
}

FieldBlock OverSpeed(double scale, const FieldRows& rows) {
  VectorXd speeds = rows.velocity.cwiseAbs();
  FieldBlock block{.kind = FieldKind::speed_friction};
  block.fastest = QuantileInPlace(speeds, kFastest);
  const VectorXd root = RootOfSpeed(rows.velocity, block.fastest);
  const double least = root.minCoeff();
  block.knots = Even(least, std::max(root.maxCoeff(), least + kLeastSpeedRange), kSpeedKnots);
  AddKernels({0.3, 0.6, 1.2}, Matern, block);
  block.amplitude_scale = scale;
  return block;
}

FieldBlock OverTemperature(double scale, const FieldRows& rows) {
  const VectorXd& at = rows.temperature;
  FieldBlock block{.kind = FieldKind::temperature_friction};
  block.knots = Even(at.minCoeff(), at.maxCoeff(), kTemperatureKnots);
  const double range = at.maxCoeff() - at.minCoeff();
  AddKernels({0.5 * range, range, 2 * range}, Matern, block);
  block.amplitude_scale = scale;
  return block;
}

// half-normal priors of the amplitudes, shares of the friction; why: without them a curve over the speed goes to three times
// the friction, and the law to its negative
constexpr double kLoadScale = 0.5, kTorqueDriftScale = 0.3, kFrictionScale = 0.15;

FieldBlock Make(FieldKind kind, const FieldRows& rows, JointKind joint) {
  switch (kind) {
    case FieldKind::place_torque:
      return OverPlace(kind, kLoadScale, rows, joint);
    case FieldKind::place_friction:
      return OverPlace(kind, kFrictionScale, rows, joint);
    case FieldKind::speed_friction:
      return OverSpeed(kFrictionScale, rows);
    case FieldKind::temperature_friction:
      return OverTemperature(kFrictionScale, rows);
    case FieldKind::time_friction:
      return OverTime(kind, kFrictionScale, rows);
    case FieldKind::time_torque:
      break;
  }
  return OverTime(kind, kTorqueDriftScale, rows);
}

}  // namespace

int OnlyWay(const VectorXd& velocity) {
  const double forwards = (velocity.array() > 0).cast<double>().mean();
  if (forwards >= 1 - kOneWay) return 1;
  return forwards <= kOneWay ? -1 : 0;
}

SparseRows Knots::Columns(const VectorXd& x) const {
  const std::vector<SampleRange> pieces = Pieces();
  SparseRows columns(x.size(), size());
  columns.reserve(Eigen::VectorXi::Constant(x.size(), 2));
  for (Index n = 0; n < x.size(); ++n) {
    // the nearest piece
    std::size_t piece = pieces.size() - 1;
    const auto begins = [&](const SampleRange& one) {
      return (at[one.first - 1] + at[one.first]) / 2;
    };
    while (piece > 0 && x[n] < begins(pieces[piece])) --piece;
    const auto [begin, m] = pieces[piece];
    double u = (x[n] - at[begin]) / (at[begin + 1] - at[begin]);
    if (!period) u = std::clamp(u, 0.0, static_cast<double>(m - 1));
    const double below =
        period ? std::floor(u) : std::min(std::floor(u), static_cast<double>(m - 2));
    const Index i =
        static_cast<Index>(std::fmod(below, static_cast<double>(m))) + (below < 0 ? m : 0);
    const double share = u - below;
    columns.coeffRef(n, begin + i % m) += 1 - share;
    columns.coeffRef(n, begin + (i + 1) % m) += share;
  }
  columns.makeCompressed();
  return columns;
}

MatrixXd Knots::Distances() const {
  constexpr double never = std::numeric_limits<double>::infinity();
  MatrixXd distances = MatrixXd::Constant(size(), size(), never);
  for (const SampleRange& piece : Pieces()) {
    for (Index i = piece.first; i < piece.end(); ++i) {
      for (Index j = piece.first; j < piece.end(); ++j) {
        const double d = std::abs(at[i] - at[j]);
        distances(i, j) =
            period ? *period / std::numbers::pi * std::sin(std::numbers::pi * d / *period) : d;
      }
    }
  }
  return distances;
}

FieldMotion MotionOf(const LogSamples& m) {
  return {m.time, m.position, m.velocity, m.temperature.value_or(VectorXd())};
}

SparseRows FieldBlock::UnsignedAt(const FieldMotion& at) const {
  switch (kind) {
    case FieldKind::place_torque:
    case FieldKind::place_friction:
      return knots.Columns(at.position);
    case FieldKind::speed_friction:
      return knots.Columns(RootOfSpeed(at.velocity, fastest));
    case FieldKind::temperature_friction:
      return knots.Columns(at.temperature);
    case FieldKind::time_friction:
    case FieldKind::time_torque:
      break;
  }
  return knots.Columns(at.time);
}

SparseRows FieldBlock::ColumnsAt(const FieldMotion& at) const {
  SparseRows signed_columns = UnsignedAt(at);
  if (!IsFriction(kind)) return signed_columns;
  for (Index n = 0; n < signed_columns.rows(); ++n) signed_columns.row(n) *= Sign(at.velocity[n]);
  return signed_columns;
}

bool IsSymmetric(const Law& law) {
  const VectorXd speed = VectorXd::LinSpaced(3, 0.5, 2);
  return LawColumns(law, speed).isApprox(-LawColumns(law, -speed));
}

std::vector<FieldBlock> MakeFields(const std::vector<FieldKind>& kinds, const FieldRows& rows,
                                   JointKind joint, const Law& law) {
  std::vector<FieldBlock> blocks;
  for (const FieldKind kind : kinds) {
    FieldBlock& block = blocks.emplace_back(Make(kind, rows, joint));
    block.columns = block.ColumnsAt(rows);
    block.mean = MeanInMotion(block, rows.motion);
    const bool levels_differ = kind == FieldKind::place_torque && !IsSymmetric(law);
    const bool has_level =
        kind == FieldKind::place_friction || kind == FieldKind::temperature_friction;
    if (has_level || levels_differ) {
      MakeOrthogonal(MatrixXd::Ones(block.size(), 1), block.mean.transpose(), block);
    } else if (kind == FieldKind::speed_friction) {
      const MatrixXd of_law = LawColumns(law, block.fastest * block.knots.at.cwiseAbs2());
      const MatrixXd gram = MatrixXd(SparseRows(block.columns.transpose()) * block.columns) /
                            static_cast<double>(rows.size());
      MakeOrthogonal(of_law, of_law.transpose() * gram, block);
    }
    for (MatrixXd& kernel : block.kernels) kernel.diagonal().array() += kNugget;
  }
  return blocks;
}

}  // namespace warmjoint
