#include "identification/maps/finer_maps.h"

#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/map_options.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

TEST(FinerMaps, HaveTwiceTheKernelsOverTheSameRange) {
  FrictionMap map{{{MapQuantity::position, EvenAxis(-1, 2, 4)}}, KernelKind::normalised, {}};
  map.axes[0].kernels.width *= 1.5;
  const GaussianAxis finer = TwiceAsFine({map})[0].axes[0].kernels;
  ASSERT_EQ(finer.centres.size(), 8u);
  EXPECT_EQ(finer.centres.front(), -1);
  EXPECT_EQ(finer.centres.back(), 2);
  EXPECT_NEAR(finer.width, 1.5 * 3 / 7, 1e-12);  // three in seven of a range of 3
}

TEST(FinerMaps, StayOnTheirCircleAndLeaveOtherQuantitiesAlone) {
  const FrictionMap turn{
      {{MapQuantity::motor_position, CircleAxis(6, 3)}}, KernelKind::normalised, {}};
  const FrictionMap heat{{{MapQuantity::energy, EvenAxis(-1, 0, 4)}}, KernelKind::normalised, {}};
  const auto finer = TwiceAsFine({turn, heat});
  EXPECT_EQ(finer[0].axes[0].kernels.centres, (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(finer[1].axes[0].kernels.centres.size(), 4u);
}

/// Law viscous_coulomb beside a map of so many kernels over position, of a joint that travels to and fro.
MapProblem Travelling(int kernels) {
  Measurements m = test::Record(0.1, test::Travel(3000, 0.1, 1, {0.31, 0.57, 0.83}),
                                Eigen::VectorXd::Zero(3000));
  m.torque = 3 * m.velocity.array().sign() * (1 + 0.2 * (4 * m.position.array()).sin());
  Selection all;
  all.keep = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(3000, true);
  const MapPoints points = PointsOf(m);
  return {{{{RangeAxis(MapQuantity::position, points, kernels, 1), VelocityAxis(points, 1, 1)},
            KernelKind::normalised,
            {}}},
          points,
          LawColumns(*FindLaw("viscous_coulomb"), m.velocity),
          m.torque,
          all};
}

/// L of x = L y, by rows of all samples. [d x n]
Eigen::MatrixXd Operator(const MapProblem& problem, const MapFit& fit) {
  const Eigen::Index n = problem.torque.size();
  Eigen::MatrixXd rows(n, fit.x.size());
  rows << problem.free, DenseKernels(problem.maps, problem.points, 0, n);
  return fit.inverse * rows.transpose();
}

TEST(FinerMaps, AreShakenByNoiseAsTheirEquationsSay) {
  const MapProblem problem = Travelling(10);
  const MapFit fit = FitMaps(problem, 1).value();
  NoiseModel noise;
  noise.variance = 0.01;
  noise.covariances = Eigen::VectorXd::Constant(1, 0.01);
  const FinerFit finer = FitFiner(problem, fit, noise).value();
  MapProblem twice = problem;
  twice.maps = TwiceAsFine(fit.maps);
  const MapFit same = FitMaps(twice, 1).value();
  EXPECT_LE((finer.twice.x - same.x).cwiseAbs().maxCoeff(), 1e-9);

  // chi2 of the changes, in units of what the noise makes of each direction that it moves
  const auto draws = static_cast<double>(finer.shaken.cols());
  ASSERT_GT(draws, 0);
  const auto expect_scatter = [&](const MapProblem& of, const MapFit& by,
                                  const Eigen::MatrixXd& shaken) {
    const Eigen::MatrixXd L = Operator(of, by);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(0.01 * L * L.transpose());
    double sum = 0, count = 0;
    for (Eigen::Index k = 0; k < L.rows(); ++k) {
      const double variance = directions.eigenvalues()[k];
      if (variance < 1e-9 * directions.eigenvalues().maxCoeff()) continue;
      for (const auto& x : shaken.colwise()) {
        sum += std::pow(directions.eigenvectors().col(k).dot(x), 2) / variance;
        ++count;
      }
    }
    EXPECT_NEAR(sum / count, 1, 4 * std::sqrt(2 / count));
  };
  expect_scatter(problem, fit, finer.shaken);
  expect_scatter(twice, same, finer.twice_shaken);
}

}  // namespace
}  // namespace warmjoint
