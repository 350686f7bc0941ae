#include "identification/fields/field_evidence.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A joint that turns to and fro, with viscous and Coulomb friction and a ripple of it over the place. Rows in runs of one direction.
FieldRows RowsWithRipple(double ripple, double correlation, std::uint64_t seed, Index n = 300) {
  RandomStream random({seed, 0}, Stream::test);
  FieldRows rows;
  rows.time = VectorXd::LinSpaced(n, 0, 0.04 * static_cast<double>(n - 1));
  rows.position = (0.9 * rows.time.array()).sin();
  rows.velocity = 0.9 * (0.9 * rows.time.array()).cos() + 0.4 * (0.23 * rows.time.array()).cos();
  rows.flat.resize(n, 2);
  rows.torque.resize(n);
  rows.follows.resize(n);
  double noise = 0;
  for (Index i = 0; i < n; ++i) {
    const double v = rows.velocity[i], sign = Sign(v);
    rows.follows[i] = i > 0 && sign == Sign(rows.velocity[i - 1]);
    const double fresh = 0.1 * random.Normal();
    noise = rows.follows[i] ? correlation * noise + fresh
                            : fresh / std::sqrt(1 - correlation * correlation);
    rows.flat.row(i) << v, sign;
    rows.torque[i] = 2 * v + sign * (5 + ripple * std::sin(8 * rows.position[i])) + noise;
  }
  rows.motion = {rows.time, rows.position, rows.velocity};
  return rows;
}

const Law& ViscousCoulombLaw() { return *FindLaw("viscous_coulomb"); }

/// -2 log of the normal density of the torque whose covariance is that of flat columns, fields and noise, and of the amplitudes.
double DenseCost(const FieldRows& rows, const std::vector<FieldBlock>& blocks, double friction,
                 const FieldHyperparameters& at) {
  const Index n = rows.size();
  const double spread = 1e3 * std::sqrt((rows.torque.array() - rows.torque.mean()).square().mean());
  const VectorXd scale = rows.flat.colwise().norm() / std::sqrt(static_cast<double>(n));
  const MatrixXd flat = spread * rows.flat * scale.cwiseInverse().asDiagonal();
  MatrixXd covariance = flat * flat.transpose();
  double penalty = 0;
  for (size_t k = 0; k < blocks.size(); ++k) {
    const MatrixXd columns = MatrixXd(blocks[k].columns) * at.amplitudes[k] * friction;
    covariance += columns * blocks[k].kernels[at.lengths[k]] * columns.transpose();
    penalty += std::pow(at.amplitudes[k] / blocks[k].amplitude_scale, 2);
  }
  const double variance = at.innovation / (1 - at.correlation * at.correlation);
  Index run = 0;
  std::vector<Index> runs;
  for (Index i = 0; i < n; ++i) runs.push_back(rows.follows[i] ? run : ++run);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      if (runs[static_cast<size_t>(i)] != runs[static_cast<size_t>(j)]) continue;
      covariance(i, j) += variance * std::pow(at.correlation, std::abs(i - j));
    }
  }
  const Eigen::LLT<MatrixXd> llt(covariance);
  return 2 * llt.matrixLLT().diagonal().array().log().sum() +
         rows.torque.dot(llt.solve(rows.torque)) + penalty;
}

TEST(FieldEvidence, IsTheDensityOfTheTorque) {
  const FieldRows rows = RowsWithRipple(0.5, 0.5, 1, 150);
  const auto blocks = MakeFields({FieldKind::place_torque, FieldKind::place_friction,
                                  FieldKind::speed_friction, FieldKind::time_torque},
                                 rows, JointKind::rotary, ViscousCoulombLaw());
  const FieldEvidence evidence(rows, blocks, 5);
  const FieldHyperparameters one{{0.1, 0.05, 0.02, 0.03}, {0, 1, 2, 3}, 0.5, 0.01};
  const FieldHyperparameters other{{0.01, 0.2, 0.1, 0.1}, {1, 0, 0, 1}, 0.2, 0.02};
  // differences, since the program leaves constants out
  const double dense = DenseCost(rows, blocks, 5, one) - DenseCost(rows, blocks, 5, other);
  EXPECT_NEAR(evidence.Cost(one) - evidence.Cost(other), dense, 1e-5 * std::abs(dense));
}

TEST(FieldEvidence, FindsWhatIsThereAndNothingElse) {
  // the ripple by the field whose direction and place are its own, with the noise's correlation
  const FieldRows rippled = RowsWithRipple(0.5, 0.8, 2, 1500);
  const std::vector<FieldKind> kinds{FieldKind::place_torque, FieldKind::place_friction,
                                     FieldKind::speed_friction, FieldKind::time_friction,
                                     FieldKind::time_torque};
  const auto blocks = MakeFields(kinds, rippled, JointKind::rotary, ViscousCoulombLaw());
  const FieldHyperparameters found = FieldEvidence(rippled, blocks, 6).Maximise();
  EXPECT_GT(found.amplitudes[1], 0.03);
  for (const size_t other : {0, 2, 3, 4}) EXPECT_LT(found.amplitudes[other], 0.02) << other;
  EXPECT_NEAR(found.correlation, 0.8, 0.11);
  EXPECT_NEAR(found.innovation, 0.01, 0.003);

  const FieldRows plain = RowsWithRipple(0, 0.8, 3, 1500);
  const auto none = MakeFields(kinds, plain, JointKind::rotary, ViscousCoulombLaw());
  for (const double amplitude : FieldEvidence(plain, none, 6).Maximise().amplitudes) {
    EXPECT_LT(amplitude, 0.02);
  }
}

TEST(FieldEvidence, AveragesAlikeEachTime) {
  const FieldRows rows = RowsWithRipple(0.3, 0.5, 4);
  const auto blocks = MakeFields({FieldKind::place_torque, FieldKind::place_friction}, rows,
                                 JointKind::rotary, ViscousCoulombLaw());
  const FieldEvidence evidence(rows, blocks, 6);
  const FieldHyperparameters best = evidence.Maximise();
  const FieldPosterior one = evidence.Averaged(best), other = evidence.Averaged(best);
  EXPECT_EQ(one.mean, other.mean);
  EXPECT_EQ(one.covariance, other.covariance);
  // about the posterior at the maximum, and about as sure
  EXPECT_NEAR(one.mean[1], evidence.At(best).mean[1], std::sqrt(one.covariance(1, 1)));
  EXPECT_GT(one.covariance.topLeftCorner(2, 2).trace(),
            0.5 * evidence.At(best).covariance.topLeftCorner(2, 2).trace());
}

TEST(FieldEvidence, KeepsTheLawThatOfTheBestLine) {
  // friction over the place has no mean over the motion, of which rows may leave out a part; that over the speed none over the rows
  FieldRows rows = RowsWithRipple(0.5, 0, 5);
  const Index part = rows.size() / 3;
  rows.motion = {rows.time.head(part), rows.position.head(part), rows.velocity.head(part)};
  const auto blocks = MakeFields({FieldKind::place_friction, FieldKind::speed_friction}, rows,
                                 JointKind::rotary, ViscousCoulombLaw());
  const VectorXd sign = rows.velocity.array().sign().matrix();
  const SparseRows moving = blocks[0].UnsignedAt(rows.motion);
  const VectorXd of_place = moving.transpose() * VectorXd::Ones(part) / part;
  const VectorXd of_speed = blocks[1].columns.transpose() * sign / rows.size();
  for (const MatrixXd& kernel : blocks[0].kernels) {
    EXPECT_LT(of_place.dot(kernel * of_place), 1e-5);
  }
  for (const MatrixXd& kernel : blocks[1].kernels) {
    EXPECT_LT(of_speed.dot(kernel * of_speed), 1e-5);
  }
}

TEST(FieldEvidence, TellsATemperatureFromADrift) {
  // friction follows a temperature that rises and falls; without that column it is a drift
  constexpr double slope = -0.2;  // N.m/K
  FieldRows rows = RowsWithRipple(0.5, 0, 8);
  const VectorXd rise = 4 * (VectorXd::LinSpaced(rows.size(), 0, 15)).array().sin();
  rows.torque += slope * rise.cwiseProduct(rows.velocity.cwiseSign());
  rows.temperature = 25 + rise.array();
  rows.motion.temperature = rows.temperature;
  const auto both = MakeFields({FieldKind::temperature_friction, FieldKind::time_friction}, rows,
                               JointKind::rotary, ViscousCoulombLaw());
  const FieldEvidence evidence(rows, both, 5);
  const FieldHyperparameters best = evidence.Maximise();
  EXPECT_GT(best.amplitudes[0], 0.05);
  EXPECT_LT(best.amplitudes[1], 0.2 * best.amplitudes[0]);
  // the values at its knots rise as the friction does
  const VectorXd values = evidence.At(best).mean.segment(evidence.Begin(0), both[0].size());
  const VectorXd& at = both[0].knots.at;
  EXPECT_NEAR((values[at.size() - 1] - values[0]) / (at[at.size() - 1] - at[0]), slope, 0.02);
}

TEST(FieldEvidence, GivesEachRecordingADriftOfItsOwn) {
  FieldRows rows = RowsWithRipple(0, 0, 7);
  const Index half = rows.size() / 2;
  rows.starts = {half};
  const auto blocks =
      MakeFields({FieldKind::time_friction}, rows, JointKind::rotary, ViscousCoulombLaw());
  const auto at = [&](Index row) {
    const auto one = [row](const VectorXd& column) { return VectorXd(column.segment(row, 1)); };
    return MatrixXd(blocks[0].ColumnsAt({one(rows.time), one(rows.position), one(rows.velocity)}));
  };
  // neighbours in time on both sides of the start, and within a recording
  for (const MatrixXd& kernel : blocks[0].kernels) {
    const auto covariance = [&](Index a, Index b) {
      return std::abs((at(a) * kernel * at(b).transpose())(0, 0));
    };
    EXPECT_LT(covariance(half - 1, half), 1e-9);
    EXPECT_GT(covariance(half, half + 1), 0.5);
    EXPECT_GT(covariance(half - 2, half - 1), 0.5);
  }
}

TEST(FieldEvidence, FollowsATurn) {
  // of a joint that turns on, places a turn from each other are one
  FieldRows rows = RowsWithRipple(0, 0, 6);
  rows.position = VectorXd::LinSpaced(rows.size(), -1, 30);
  const auto blocks =
      MakeFields({FieldKind::place_torque}, rows, JointKind::rotary, ViscousCoulombLaw());
  const VectorXd here = VectorXd::Constant(1, -0.7);
  const VectorXd there = here.array() + 4 * std::numbers::pi;
  const VectorXd zero = VectorXd::Zero(1), forwards = VectorXd::Ones(1);
  const MatrixXd one = blocks[0].ColumnsAt({zero, here, forwards});
  const MatrixXd other = blocks[0].ColumnsAt({zero, there, forwards});
  EXPECT_LT((one - other).norm(), 1e-12);
  EXPECT_NEAR(one.sum(), 1, 1e-12);
}

}  // namespace
}  // namespace warmjoint
