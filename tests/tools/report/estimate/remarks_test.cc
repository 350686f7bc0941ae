#include "tools/report/estimate/remarks.h"

#include <gmock/gmock.h>

namespace warmjoint {
namespace {

using testing::ElementsAre;

Estimate Saying(Status status, const std::string& message, std::vector<std::string> warnings) {
  Estimate estimate;
  estimate.status = status;
  estimate.message = message;
  estimate.warnings = std::move(warnings);
  return estimate;
}

TEST(Remarks, AreSentencesOfTheMessageAndOneForEachWarning) {
  const Estimate estimate =
      Saying(Status::ok, "fitted to 12 samples; noise of 0.5 N.m (as before; so). Done",
             {"one: a, Eq. (22); two"});
  EXPECT_THAT(Remarks(estimate),
              ElementsAre("Fitted to 12 samples.", "Noise of 0.5 N.m (as before; so).", "Done.",
                          "One: a, Eq. (22); two."));
}

TEST(Remarks, KeepNamesAsTheyAre) {
  const Estimate estimate = Saying(Status::ok, "thermal_gain is small; try law=stribeck", {});
  EXPECT_THAT(Remarks(estimate), ElementsAre("thermal_gain is small.", "Try law=stribeck."));
}

TEST(BriefRemarks, OfAFailureAreWhatWasFoundAndWhatHelps) {
  const Estimate estimate =
      Saying(Status::inadequate_model, "depends on a; and on b; with it c moves; try d", {});
  EXPECT_THAT(BriefRemarks(estimate), ElementsAre("Depends on a.", "Try d."));
}

TEST(BriefRemarks, OfAnAnswerAreItsFirstSentenceAndTwoWarnings) {
  const Estimate estimate =
      Saying(Status::ok, "chose a; law b; noise c", {"first; middle; last", "second", "third"});
  EXPECT_THAT(BriefRemarks(estimate), ElementsAre("Chose a.", "First. Last.", "Second."));
}

}  // namespace
}  // namespace warmjoint
