#include "identification/maps/map_block.h"

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include "identification/identifiers/identifier_list.h"
#include "identification/maps/map_options.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

/// A joint that ripples over its position, seen by energy-ml with a map.
class MapBlockTest : public ::testing::Test {
 protected:
  MapBlockTest() {
    Friction friction{"viscous_coulomb", {{"viscous", 0.5}, {"coulomb", 2}}, {}, 0, 1};
    friction.maps = {test::PositionLevel(1, 0.3)};
    m_ =
        test::RecordFriction(friction, 0.2, test::Travel(3000, 0.2, 1, {0.31, 0.57, 0.83}), 0.1, 1);
  }

  /// Expects that a block fits beside a course of E as one that is made anew.
  void ExpectTheSame(const std::map<std::string, std::string>& given) {
    const Identifier identifier = EnergyMl();
    const Options options = identifier.options.Read(given);
    const IdentifierInput input{Prepare(m_), options, {}};
    MapBeginning begin = BeginMaps(input, "energy-ml", {MapQuantity::position});
    begin.task.candidates = PositionMaps(options, begin.points);
    MapBlock block(input, begin.task);
    ASSERT_TRUE(block.ChooseBeside({}));
    const Eigen::VectorXd energy = Eigen::VectorXd::LinSpaced(input.measurements.size(), 0, -0.5);
    ASSERT_TRUE(block.FitBeside(energy));

    const auto anew = ChooseAndFit(input, block.Settled());
    ASSERT_TRUE(anew);
    // sums in another order: rounding, times the condition of a weak prior
    EXPECT_LE((block.fit().x - anew->fit.x).cwiseAbs().maxCoeff(), 1e-8);
    const Eigen::VectorXd values = EvaluateMaps(anew->fit.maps, PointsOf(input.measurements));
    EXPECT_LE((block.Everywhere() - values).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_NEAR(block.Complete().effective, anew->fit.effective, 1e-6);
  }

  Measurements m_;
};

TEST_F(MapBlockTest, FitsAsOneMadeAnew) {
  ExpectTheSame({{"position", "map"}, {"kernels", "20"}, {"width", "1"}});
}

TEST_F(MapBlockTest, DoesSoWithShapesToChooseFrom) {
  ExpectTheSame({{"position", "map"}, {"kernels", "20"}});
}

}  // namespace
}  // namespace warmjoint
