// A real linear axis (EMPS): what its recording holds, and the friction laws on its samples at
// constant speed. Expected figures: an independent fit, see the data's PROVENANCE.txt.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Dense>

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

struct Fit {
  Eigen::VectorXd parameters;
  double rmse = 0;  // N
  double fit = 0;   // %
};

Fit LeastSquares(const Measurements& log, const std::string& law_name) {
  const Law& law = *FindLaw(law_name);
  const Selection selection = SelectConstantSpeed(log);
  const auto d = static_cast<Eigen::Index>(law.parameters.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(selection.count(), d);
  Eigen::VectorXd force(selection.count());
  for (Eigen::Index i = 0, k = 0; i < log.size(); ++i) {
    if (!selection.keep[i]) continue;
    Regressor(law, log.velocity[i], &rows(k, 0));
    force[k++] = log.torque[i];
  }
  const Eigen::VectorXd parameters = rows.colPivHouseholderQr().solve(force);
  const Eigen::VectorXd error = force - rows * parameters;
  const double spread = (force.array() - force.mean()).matrix().norm();
  return {parameters, std::sqrt(error.squaredNorm() / static_cast<double>(force.size())),
          100 * (1 - error.norm() / spread)};
}

// the reference cut its segments by its own rule: where the cuts differ by some hundredths of a
// second the figures differ in their third digit
TEST_F(Emps, IsDescribedByTheAsymmetricLaw) {
  const Fit fit = LeastSquares(log_, "asymmetric");
  EXPECT_NEAR(fit.parameters[0], 193, 2);
  EXPECT_NEAR(fit.parameters[1], 18.0, 0.1);
  EXPECT_NEAR(fit.parameters[2], 25.2, 0.1);
  EXPECT_NEAR(fit.rmse, 1.78, 0.02);
  EXPECT_NEAR(fit.fit, 95.5, 0.1);
}

TEST_F(Emps, IsNotDescribedByOneLevelForBothDirections) {
  const Fit fit = LeastSquares(log_, "viscous_coulomb");
  EXPECT_NEAR(fit.parameters[1], 21.47, 0.1);
  EXPECT_NEAR(fit.rmse, 4.02, 0.03);
}

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
