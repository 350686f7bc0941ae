#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <numbers>

#include "identification/answer/identify.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/map_options.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

/// A log of ten minutes of a joint whose level varies in so many cycles over its travel.
Measurements Wavy(double cycles, const std::vector<double>& speeds, std::uint64_t seed) {
  const Eigen::VectorXd velocity = test::Travel(12000, 0.05, 1, speeds);
  Measurements m = test::Record(0.05, velocity, velocity);
  m.position.array() -= 1;
  m.torque =
      5 * velocity.array() +
      velocity.array().sign() * (15 + (std::numbers::pi * cycles * m.position.array()).sin());
  test::AddNoise(m, 0.5, 0, seed);
  return m;
}

struct Across {
  size_t kernels = 0;
  double width = 0;  // of them in spacings
  double error = 0;  // mean square on the other file
};

Across FitAndTry(const PreparedLog& log, const PreparedLog& other,
                 const std::map<std::string, std::string>& given) {
  const Identifier& identifier = FindIdentifier("position-ridge");
  const Fit fit = identifier.fit({log, identifier.options.Read(given), {}});
  const GaussianAxis& axis = fit.friction.maps.at(0).axes[0].kernels;
  const double rmse = HoldOut(identifier, fit, other)->rmse;
  return {axis.size(), axis.width / (axis.centres[1] - axis.centres[0]), rmse * rmse};
}

TEST(PositionMaps, TheShapeThatIsChosenIsAsGoodOnAnotherFileAsHalfItsKernels) {
  size_t most = 0;
  for (const double cycles : {0.5, 2.0, 8.0, 30.0}) {
    double chosen = 0, half = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const PreparedLog log = Prepare(Wavy(cycles, {0.2, 0.5, 0.9}, seed));
      const PreparedLog other = Prepare(Wavy(cycles, {0.3, 0.7, 0.4}, 100 + seed));
      const Across own = FitAndTry(log, other, {});
      const Across fewer = FitAndTry(
          log, other,
          {{"kernels", std::to_string(own.kernels / 2)}, {"width", std::to_string(own.width)}});
      chosen += own.error;
      half += fewer.error;
      most = std::max(most, own.kernels);
    }
    // a mean square of 48,000 samples of noise is known to 0.7 %
    EXPECT_LT(chosen, 1.01 * half) << cycles;
  }
  EXPECT_GT(most, 40u) << "30 cycles need more than 60 kernels";
}

}  // namespace
}  // namespace warmjoint
