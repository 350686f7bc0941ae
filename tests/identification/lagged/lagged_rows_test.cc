#include "identification/lagged/lagged_rows.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "models/foundation/low_pass.h"
#include "models/foundation/random_stream.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLag = 0.3;  // s

/// Three runs of uneven lengths and steps.
std::shared_ptr<const KeptRuns> ThreeRuns() {
  auto runs = std::make_shared<KeptRuns>();
  runs->runs = {{0, 12}, {12, 13}, {13, 40}};
  runs->time.resize(40);
  double t = 0;
  for (int i = 0; i < 40; ++i) {
    runs->samples.push_back(2 * i);
    runs->time[i] = t += i == 12 || i == 13 ? 1.0 : 0.05 + 0.02 * (i % 3);
  }
  return runs;
}

MatrixXd Noise(int rows, int columns, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  MatrixXd noise(rows, columns);
  for (double& value : noise.reshaped()) value = random.Normal();
  return noise;
}

TEST(LaggedRows, LagWithinARunAsTheLowPassDoes) {
  const auto runs = ThreeRuns();
  const MatrixXd rows = Noise(40, 2, 1);
  const MatrixXd lagged = LaggedRows(runs, kLag).Lagged(rows);
  for (const KeptRun& run : runs->runs) {
    for (int column = 0; column < 2; ++column) {
      const VectorXd expected = LowPass(runs->time.segment(run.begin, run.size()),
                                        rows.col(column).segment(run.begin, run.size()), kLag);
      EXPECT_LT((lagged.col(column).segment(run.begin, run.size()) - expected).norm(), 1e-13);
    }
  }
}

TEST(LaggedRows, TakeUnlaggedTorqueBackToItself) {
  const LaggedRows rows(ThreeRuns(), kLag);
  const VectorXd torque = Noise(40, 1, 2).col(0);
  const VectorXd back = rows.Lagged(rows.Unlagged(torque));
  const VectorXd apart = torque - back;
  EXPECT_LT((apart - rows.Dying(rows.HeldBy(apart))).norm(), 1e-12)
      << "but for what each run begins with";
}

/// Least squares of y over L A and a column exp(-(t - t0)/T) for each run, by dense QR of the rows that
/// `noise_root` makes white.
VectorXd BySpelledOutColumns(const LaggedRows& rows, const MatrixXd& A, const VectorXd& y,
                             const MatrixXd& noise_root) {
  const auto count = rows.runs()->run_count();
  MatrixXd all(A.rows(), A.cols() + count);
  all.leftCols(A.cols()) = rows.Lagged(A);
  all.rightCols(count) = rows.Dying(MatrixXd::Identity(count, count));
  const MatrixXd white = noise_root.triangularView<Eigen::Lower>().solve(all);
  const VectorXd torque = noise_root.triangularView<Eigen::Lower>().solve(y);
  return white.colPivHouseholderQr().solve(torque).head(A.cols());
}

VectorXd ByMappedRows(const LaggedRows& rows, const MatrixXd& A, const VectorXd& y) {
  return rows.Of(A).colPivHouseholderQr().solve(rows.Of(rows.Unlagged(y)).col(0));
}

TEST(LaggedRows, FitAsBesideAColumnForWhatEachRunBeginsWith) {
  const LaggedRows rows(ThreeRuns(), kLag);
  const MatrixXd A = Noise(40, 3, 3);
  const VectorXd y = Noise(40, 1, 4).col(0);
  const VectorXd expected = BySpelledOutColumns(rows, A, y, MatrixXd::Identity(40, 40));
  EXPECT_LT((ByMappedRows(rows, A, y) - expected).norm(), 1e-11);
}

TEST(LaggedRows, FitColouredNoiseByItsCovariance) {
  // even steps, so that AR(1) has one correlation between neighbours
  auto runs = std::make_shared<KeptRuns>();
  runs->runs = {{0, 15}, {15, 40}};
  runs->time = VectorXd::LinSpaced(40, 0, 3.9);
  runs->time.tail(25).array() += 5;
  for (int i = 0; i < 40; ++i) runs->samples.push_back(i);
  constexpr double a = 0.7;
  NoiseModel noise;
  noise.coefficients = VectorXd::Constant(1, -a);
  noise.covariances = Eigen::Vector2d(1, a);
  noise.variance = 1;
  noise.innovation = 1 - a * a;
  noise.correlation = a;
  const LaggedRows rows(runs, kLag, WhiteningOfRuns(noise, *runs));

  MatrixXd covariance = MatrixXd::Zero(40, 40);
  for (const KeptRun& run : runs->runs) {
    for (auto i = run.begin; i < run.end; ++i) {
      for (auto j = run.begin; j < run.end; ++j) covariance(i, j) = std::pow(a, std::abs(i - j));
    }
  }
  const MatrixXd A = Noise(40, 2, 5);
  const VectorXd y = Noise(40, 1, 6).col(0);
  const VectorXd expected = BySpelledOutColumns(rows, A, y, covariance.llt().matrixL());
  EXPECT_LT((ByMappedRows(rows, A, y) - expected).norm(), 1e-10);
}

TEST(KeptRuns, EndWhereASampleIsLeftOutASegmentBeginsOrTheJointIsColdAgain) {
  Measurements m = test::Record(1, VectorXd::Ones(12), VectorXd::Ones(12));
  m.starts = {9};
  Selection selection;
  selection.keep.setConstant(12, true);
  selection.keep[2] = false;
  selection.segments = {{0, 6, 1}, {6, 12, 1}};
  const KeptRuns found = FindRuns(m, selection);
  ASSERT_EQ(found.run_count(), 4);
  const std::vector<Eigen::Index> begins{0, 2, 5, 8};  // among the 11 kept: samples 0, 3, 6, 9
  for (size_t r = 0; r < 4; ++r) EXPECT_EQ(found.runs[r].begin, begins[r]);
  EXPECT_EQ(found.samples[2], 3);
  EXPECT_EQ(found.time[2], m.time[3]);
  EXPECT_EQ(found.runs.back().end, found.count());
}

}  // namespace
}  // namespace warmjoint
