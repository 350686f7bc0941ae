#include "identification/maps/map_fit.h"

#include <gtest/gtest.h>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/imitated_columns.h"
#include "identification/maps/map_options.h"
#include "identification/preparation/select.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

/// A log with its law viscous_coulomb and 20 kernels over position for each direction.
MapProblem ProblemOf(const Measurements& m, const Selection& moving) {
  MapProblem problem{{},
                     Kept(PointsOf(m), moving),
                     Kept(LawColumns(*FindLaw("viscous_coulomb"), m.velocity), moving),
                     Kept(m.torque, moving),
                     moving,
                     {0, 0}};
  problem.maps = {{{RangeAxis(MapQuantity::position, problem.points, 20, 1),
                    VelocityAxis(problem.points, 1, 1)},
                   KernelKind::normalised,
                   {}}};
  return problem;
}

/// A joint that ripples over its position, to and fro at three speeds.
Measurements Rippling(double coulomb) {
  const Eigen::VectorXd velocity = test::Travel(6000, 0.1, 1, {0.31, 0.57, 0.83});
  Measurements m = test::Record(0.1, velocity, velocity);
  m.torque =
      5 * velocity.array() + velocity.array().sign() * (coulomb + (4 * m.position.array()).sin());
  test::AddNoise(m, 0.1, 0, 1);
  return m;
}

MapProblem RipplingProblem(double coulomb) {
  const Measurements m = Rippling(coulomb);
  return ProblemOf(m, SelectMoving(m));
}

/// The same law, of which each place has its one speed; the places around its change are left out.
MapProblem OneSpeedForEachPlace() {
  Eigen::VectorXd velocity(6000);
  double position = 0, direction = 1;
  for (double& v : velocity) {
    v = direction * (position < 0.5 ? 0.2 : 1);
    position += 0.01 * v;
    if (position > 1 || position < 0) direction = -direction;
  }
  Measurements m = test::Record(0.01, velocity, velocity);
  m.torque = 5 * velocity.array() + 15 * velocity.array().sign();
  test::AddNoise(m, 0.1, 0, 1);
  Selection away = SelectMoving(m);
  away.keep = away.keep && (m.position.array() - 0.5).abs() > 0.15;
  return ProblemOf(m, away);
}

/// x_j^T (kernels w) over |x_j| |kernels w|.
double Overlap(const MapProblem& problem, const MapFit& fit, Eigen::Index j) {
  const Eigen::VectorXd map = EvaluateMaps(fit.maps, problem.points);
  return problem.free.col(j).dot(map) / problem.free.col(j).norm() / map.norm();
}

TEST(FitMaps, LetsMapsBeWhatDeviatesFromTheLaw) {
  const MapProblem problem = RipplingProblem(15);
  for (const double strength : {1e-6, 1e-2, 1.0}) {
    const MapFit fit = FitMaps(problem, strength).value();
    EXPECT_EQ(ImitatedColumns(fit.gram, fit.free), std::vector<Eigen::Index>{1});
    EXPECT_NEAR(Overlap(problem, fit, 1), 0, 1e-9);
    // the level in the mean over the samples, known to the slope's few hundredths
    const Eigen::VectorXd ripple = (4 * problem.points.col(0).array()).sin();
    EXPECT_NEAR(fit.x[1], 15 + ripple.mean(), 0.03) << strength;
    EXPECT_NEAR(fit.x[0], 5, 0.05);
  }
}

TEST(FitMaps, GivesALawThatMapsImitateWhollyItsOwnLeastSquares) {
  const MapProblem problem = OneSpeedForEachPlace();
  const Eigen::VectorXd alone = problem.free.householderQr().solve(problem.torque);
  for (const double strength : {1e-6, 1.0}) {
    const MapFit fit = FitMaps(problem, strength).value();
    EXPECT_NEAR(fit.x[0], alone[0], 1e-6);
    EXPECT_NEAR(fit.x[1], alone[1], 1e-6);
  }
}

TEST(FitMaps, HoldsWhatMapsImitateAtItsBound) {
  // an offset of the level below 0 is taken by the map
  const MapProblem problem = RipplingProblem(-0.5);
  const MapFit fit = FitMaps(problem, 1e-2).value();
  EXPECT_NEAR(fit.x[1], 0, 1e-9);
  const double rms = (problem.torque - fit.fitted).norm() / std::sqrt(problem.torque.size());
  EXPECT_NEAR(rms, 0.1, 0.01);
}

/// Largest difference of the solutions of a repeated fit and of one made anew.
double Apart(RepeatedFit& repeated, MapProblem problem, const Eigen::VectorXd& torque) {
  problem.torque = torque;
  const Eigen::VectorXd anew = FitMaps(problem, 1e-2).value().x;
  return (repeated.To(torque).value().x - anew).cwiseAbs().maxCoeff();
}

// sums in another order: rounding, times the condition of a weak prior
constexpr double kRounding = 1e-8;

TEST(RepeatedFit, IsAsOneMadeAnew) {
  // to a level above its bound, below it, and above it again
  MapProblem problem = RipplingProblem(15);
  RepeatedFit repeated(problem, NormalOf(problem), 1e-2);
  for (const double coulomb : {15.0, -0.5, 3.0}) {
    EXPECT_LE(Apart(repeated, problem, RipplingProblem(coulomb).torque), kRounding) << coulomb;
  }
}

TEST(RepeatedFit, IsTheSameFromRowsThatAreKept) {
  MapProblem problem = RipplingProblem(15);
  const MapProblem plain = problem;
  problem.rows = std::make_shared<const KernelRows>(problem.maps, problem.points, 3);
  RepeatedFit repeated(problem, NormalOf(problem), 1e-2);
  EXPECT_LE(Apart(repeated, plain, 2 * problem.torque), kRounding);
}

TEST(RepeatedFit, SolvesForXAlone) {
  const MapProblem problem = RipplingProblem(15);
  RepeatedFit repeated(problem, NormalOf(problem), 1e-2);
  Eigen::MatrixXd torques(problem.torque.size(), 2);
  torques << 2 * problem.torque, problem.torque.array().square().matrix();
  const Eigen::MatrixXd alone = repeated.Solve(torques).value();
  for (const Eigen::Index k : {0, 1}) {
    const Eigen::VectorXd x = repeated.To(torques.col(k)).value().x;
    EXPECT_LE((alone.col(k) - x).cwiseAbs().maxCoeff(), kRounding);
  }
}

TEST(RepeatedFit, CompletesTheLatestFit) {
  const MapProblem problem = RipplingProblem(15);
  RepeatedFit repeated(problem, NormalOf(problem), 1e-2);
  const MapFit complete = repeated.Complete(repeated.Fit().value());
  const MapFit fit = FitMaps(problem, 1e-2).value();
  EXPECT_EQ(complete.x, fit.x);
  EXPECT_EQ(complete.effective, fit.effective);
  EXPECT_EQ(complete.inverse, fit.inverse);
}

}  // namespace
}  // namespace warmjoint
