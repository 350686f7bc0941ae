#include "tools/report/page/log_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/lack_of_fit/table.h"
#include "tests/tools/report/warm_recording.h"
#include "tools/report/page/chart_library.h"
#include "tools/report/page/plain_words.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string PageOf(const WarmRecording& warm) {
  return MakeLogPage({MakeFitView(warm.measurements, warm.selection, warm.estimate),
                      CheckRecording(warm.measurements),
                      {"warmjoint identify warm.csv"}});
}

TEST(LogPage, SaysWhyALogWasRefusedAndWhatToRecord) {
  WarmRecording warm;
  warm.estimate.status = Status::inadequate_model;
  warm.estimate.message = "the residual depends on direction <3 N.m>";
  Diagnostic direction;
  direction.test = "direction";
  direction.made = direction.rejected = true;
  direction.effect = 3;
  direction.effect_unit = "N.m";
  warm.estimate.diagnostics = {direction};
  const std::string page = PageOf(warm);
  EXPECT_THAT(page, HasSubstr("the model does not describe these data: do not use the numbers"));
  EXPECT_THAT(page, HasSubstr("The residual depends on direction &lt;3 N·m&gt;."));
  EXPECT_THAT(page, HasSubstr("Do forward and backward motion leave different residuals?"));
  EXPECT_THAT(page, HasSubstr("try --set law=asymmetric"));
  EXPECT_THAT(page, HasSubstr("Void: parameters of a fit that failed"));
  EXPECT_THAT(page, HasSubstr("A void fit belongs into no simulation"));
  EXPECT_THAT(page, HasSubstr("To identify "));
}

TEST(LogPage, ShowsTheWayIntoMuJoCoWhereTheNumbersPass) {
  const std::string page = PageOf(WarmRecording());
  EXPECT_THAT(page, HasSubstr("warmjoint attach robot.xml --joint JOINT=estimate.json"));
  EXPECT_THAT(page, Not(HasSubstr("Void: ")));
  EXPECT_THAT(page, HasSubstr(">5.000</td>")) << "the viscous friction, with its digits";
}

TEST(LogPage, AsksNothingOfAnyServerAndIsTheSameEachTime) {
  const std::string page = PageOf(WarmRecording());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* asks : {"src=\"http", "href=\"http", "sourceMappingURL", "@import"}) {
    EXPECT_THAT(page, Not(HasSubstr(asks)));
  }
  EXPECT_THAT(page, HasSubstr("MIT")) << "the licence of what is inside";
  EXPECT_TRUE(page == PageOf(WarmRecording()));
}

TEST(LogPage, StaysBelowSixMegabytesHoweverLongTheLog) {
  constexpr Eigen::Index kSamples = 100000;  // beyond some 10 000, all is thinned to what fits
  WarmRecording warm;
  Measurements& m = warm.measurements;
  RandomStream random({3, 0}, Stream::test);
  m.time = Eigen::VectorXd::LinSpaced(kSamples, 0, 1000);
  m.position = m.velocity = m.torque = m.time;
  for (Eigen::VectorXd* column : {&m.position, &m.velocity, &m.torque}) {
    for (double& value : *column) value = random.Normal();
  }
  warm.selection.keep.setConstant(kSamples, true);
  warm.selection.segments = {{0, kSamples, 1.0}};
  const FitView view = MakeFitView(m, warm.selection, warm.estimate);
  EXPECT_LT(MakeLogPage({view, {}, {}}).size(), 6000000u);
}

}  // namespace
}  // namespace warmjoint::report
