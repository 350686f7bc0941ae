// A real linear axis (EMPS): what its recording holds, and the friction laws on its samples at
// constant speed. Expected figures: an independent fit, see the data's PROVENANCE.txt.
#include <gmock/gmock.h>

#include "identification/preparation/check.h"
#include "identification/preparation/check_report.h"
#include "identification/preparation/prepare.h"
#include "identification/preparation/select.h"
#include "models/friction/law.h"
#include "models/recording/csv.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

class Emps : public testing::Test {
 protected:
  void SetUp() override {
    WARMJOINT_NEED_SHARED("data/emps/DATA_EMPS.csv");
    const std::string path = test::SharedFolder() / "data/emps/DATA_EMPS.csv";

    ReadSettings layout;
    layout.joint = JointKind::linear;
    layout.map = {{"time", "t_s"}, {"position", "q_m"}, {"torque", "force_N"}};
    log_ = Prepare(ReadCsv(path, layout)).taken().measurements;
  }

  Measurements log_;
};

TEST_F(Emps, MovesAtThreeSpeedsInBothDirections) {
  const RecordingCheck check = CheckRecording(log_);
  EXPECT_EQ(check.motion.segments, 32);
  EXPECT_NEAR(check.motion.constant_share, 0.67, 0.01);
  ASSERT_EQ(check.motion.levels.size(), 6U);
  const double speeds[] = {-0.125, -0.083, -0.042, 0.042, 0.083, 0.125};  // m/s
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(check.motion.levels[i].velocity, speeds[i], 0.0005);
  }
  EXPECT_NEAR(check.sampling.rate, 1000, 0.01);
  EXPECT_EQ(check.sampling.gaps, 0);
}

TEST_F(Emps, IsTooShortForWarmUp) {
  const RecordingCheck check = CheckRecording(log_);
  for (const Excitation& excitation : check.excitation) {
    const bool is_law =
        excitation.what == "law coulomb" || excitation.what == "law viscous_coulomb" ||
        excitation.what == "law asymmetric" || excitation.what == "position dependence";
    EXPECT_EQ(excitation.sufficient, is_law) << excitation.what << ": " << excitation.reason;
  }
  EXPECT_THAT(CheckToText(check), testing::HasSubstr("the log lasts 24.8 s"));
}

}  // namespace
}  // namespace warmjoint
