#include "tools/suite/external_identifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "identification/preparation/prepare.h"
#include "identification/preparation/select.h"
#include "models/foundation/bad_input.h"
#include "tests/tools/scratch_directory.h"
#include "tools/suite/wall.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Twelve samples at two speeds, about 2 sign v.
Measurements Log() {
  Measurements log;
  log.time = Eigen::VectorXd::LinSpaced(12, 0, 11);
  log.velocity = Eigen::VectorXd::Constant(12, 0.5);
  log.velocity.tail(6).setConstant(-1);
  log.position = Eigen::VectorXd::Zero(12);
  log.torque = 2 * log.velocity.array().sign() + Eigen::ArrayXd::LinSpaced(12, -0.01, 0.01);
  return log;
}

Estimate Ask(const std::string& command, const std::string& limit = "20") {
  SuiteIdentifier identifier =
      ReadExternal("theirs=" + command + " # {recording} {estimate}", CommandForm::shell);
  identifier.options["time_limit"] = limit;
  const Measurements log = Log();
  return PrepareExternal(identifier, {})(Prepare(log), {});
}

/// How the command fails, and why: "status: message".
std::string Failure(const std::string& command, const std::string& limit = "20") {
  try {
    Ask(command, limit);
  } catch (const NoAnswer& failure) {
    return failure.status + ": " + failure.what();
  }
  return "";
}

TEST(ExternalIdentifier, IsNamedWithItsCommand) {
  EXPECT_TRUE(IsExternal("me=python me.py {recording} {estimate}"));
  EXPECT_FALSE(IsExternal("energy-ml"));
  EXPECT_EQ(ReadExternal("me=run {recording} {estimate}", CommandForm::words).label, "me");
  EXPECT_THAT([] { ReadExternal("me=run {recording}", CommandForm::words); },
              ThrowsMessage<BadInput>(HasSubstr("lacks {estimate}")));
}

TEST(ExternalIdentifier, AnswersWithAnEstimate) {
  const Estimate estimate = Ask(
      R"(echo '{"status": "ok", "parameters": {"coulomb": {"value": 2, "unit": "N.m", "std": null,)"
      R"( "interval95": null}}, "friction": {"law": "coulomb", "parameters": {"coulomb": 2}}}')"
      " > estimate.json");
  EXPECT_EQ(estimate.status, Status::ok);
  EXPECT_EQ(estimate.Find("coulomb")->value, 2);
  ASSERT_TRUE(estimate.metrics) << "a friction is enough for the figures";
  EXPECT_EQ(estimate.metrics->n, 12);
}

TEST(ExternalIdentifier, CompletesTheDiscretePair) {
  const std::string value = R"("unit": "", "std": null, "interval95": null})";
  const Estimate estimate =
      Ask(R"(echo '{"status": "ok", "parameters": {"thermal_gain": {"value": -3, )" + value +
          R"(, "thermal_time_constant": {"value": 600, )" + value + "}}' > estimate.json");
  // 1 s between the samples; k (1 - exp(-h/tau)) with k -3 and tau 600 s
  EXPECT_NEAR(estimate.Find("thermal_gain_discrete")->value, -0.0049958, 5e-8);
  EXPECT_NEAR(estimate.Find("thermal_pole")->value, std::exp(-1 / 600.0), 1e-15);
}

TEST(ExternalIdentifier, FindsTheMeasurementsAloneInItsDirectory) {
  // 13 lines: the header and twelve samples
  EXPECT_THAT(Failure("ls | tr '\\n' ' '; wc -l < recording.csv; exit 1"),
              HasSubstr("crashed: exit status 1: recording.csv 13"));
}

TEST(ExternalIdentifier, FailuresSayHow) {
  EXPECT_THAT(Failure("echo no licence >&2; exit 7"), HasSubstr("exit status 7: no licence"));
  EXPECT_THAT(Failure("kill -11 $$"), HasSubstr("crashed: exit status 139"));
  EXPECT_THAT(Failure("sleep 60", "0.2"), HasSubstr("timeout: took longer than 0.2 s"));
  EXPECT_THAT(Failure("true"), HasSubstr("bad_answer: wrote no estimate"));
  EXPECT_THAT(Failure("echo '{' > estimate.json"), HasSubstr("bad_answer: "));
  EXPECT_THAT(Failure("echo '{}' > estimate.json"), HasSubstr("bad_answer: "));
}

TEST(ExternalIdentifier, AnswersThatWereMadeToHurtAreBadAnswers) {
  const auto bad = [](const char* why) { return HasSubstr(std::string("bad_answer: ") + why); };
  EXPECT_THAT(Failure("mkfifo estimate.json"), bad("the estimate is not a regular file"));
  EXPECT_THAT(Failure("ln -s /dev/zero estimate.json"), bad("the estimate is not a regular file"));
  EXPECT_THAT(Failure("ln -s /etc/passwd estimate.json"),
              bad("the estimate is not a regular file"));
  EXPECT_THAT(Failure("mkdir estimate.json"), bad("the estimate is not a regular file"));
  EXPECT_THAT(Failure("head -c 20000000 /dev/zero > estimate.json"), bad("the estimate has more"));
  EXPECT_THAT(Failure("head -c 300000 /dev/zero | tr '\\0' '[' > estimate.json"),
              HasSubstr("deeper than 64 levels"));
  EXPECT_THAT(Failure("echo '{\"status\": 1e999}' > estimate.json"), HasSubstr("1e999"));
  EXPECT_THAT(Failure("printf '\\317' > estimate.json"), HasSubstr("not UTF-8"));
}

TEST(ExternalIdentifier, MessagesAreBoundedAndTellNoDrawnNames) {
  const std::string failure = Failure("head -c 3000000 /dev/zero | tr '\\0' 'x'; exit 3");
  EXPECT_LT(failure.size(), 400u);
  EXPECT_EQ(Failure("ls $PWD/none; exit 3"), Failure("ls $PWD/none; exit 3"));
  EXPECT_THAT(Failure("ls $PWD/none; exit 3"), testing::Not(HasSubstr("warmjoint_")));
}

TEST(ExternalIdentifier, ReadsFilesThatItNamesAndNoOthers) {
  const ScratchDirectory scratch, hidden;
  std::ofstream(hidden.path() / "secret") << "truth";
  std::ofstream(scratch.path() / "shown") << "shown";
  const std::string folder = scratch.path();
  EXPECT_THAT(Failure("cat " + folder + "/shown ; exit 1"), HasSubstr("exit status 1: shown"));
  if (WallVersion() == 0) GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_THAT(Failure("cat $(echo " + hidden.path().string() + "/)secret; exit 1"),
              HasSubstr("Permission denied"));
}

TEST(ExternalIdentifier, FoldersNamesAreNoCommands) {
  const ScratchDirectory scratch;
  const auto evil = scratch.path() / "q`echo x`;touch P $(touch P)";
  std::filesystem::create_directory(evil);
  std::ofstream(evil / "id.sh") << "#!/bin/sh\nprintf '%s|' \"$@\"\n";
  std::filesystem::permissions(evil / "id.sh", std::filesystem::perms(0700));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(evil);
  for (const CommandForm form : {CommandForm::words, CommandForm::shell}) {
    const SuiteIdentifier identifier =
        ReadExternal("a=./id.sh 'a  b' {recording} {estimate}", form);
    const Measurements log = Log();
    try {
      PrepareExternal(identifier, {})(Prepare(log), {});
      ADD_FAILURE() << "answered";
    } catch (const NoAnswer& failure) {
      EXPECT_STREQ(failure.what(), "wrote no estimate") << "it ran, and to its end";
    }
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(evil), {}), 1) << "P was made";
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace warmjoint
