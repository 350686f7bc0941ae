#include "tools/suite/external_identifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/recording.h>

#include <fstream>

#include "models/foundation/bad_input.h"
#include "tests/tools/scratch_directory.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// A sandbox wherever the kernel has one.
const Confinement kConfinement = LandlockVersion() > 0 ? Confinement::sandbox : Confinement::none;

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

/// An identifier that is a line of shell; file: its $1.
SuiteIdentifier Shell(const std::string& command, const std::string& limit = "20",
                      const std::string& file = "") {
  const std::string line =
      JoinCommand({"/bin/sh", "-c", command + " # {recording} {estimate}", "sh", file});
  return {kExternal, "theirs", {{"command", line}, {"time_limit", limit}}, {}};
}

/// What it answers about the log.
Estimate Ask(const SuiteIdentifier& identifier) {
  return PrepareExternal(identifier, {}, {}, kConfinement)(Prepare(Log()), {});
}

/// How it fails, and why: "status: message".
std::string FailureOf(const SuiteIdentifier& identifier) {
  try {
    Ask(identifier);
  } catch (const NoAnswer& failure) {
    return failure.status + ": " + failure.what();
  }
  return "";
}

std::string Failure(const std::string& command, const std::string& limit = "20",
                    const std::string& file = "") {
  return FailureOf(Shell(command, limit, file));
}

/// A command of a suite in a folder with some files.
class CommandOfASuite : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "ids");
    for (const char* name : {"mine.py", "ids/theirs.py", "suite.yaml", "sh", "run it"}) {
      std::ofstream(folder_ / name) << "";
    }
  }
  SuiteIdentifier Resolved(const std::string& command) const {
    return WithFilesOfSuite({kExternal, "mine", {{"command", command}}, {}},
                            folder_ / "suite.yaml");
  }
  std::string CommandOf(const std::string& command) const {
    return Resolved(command).options.at("command");
  }
  std::string at(const char* name) const { return (folder_ / name).string(); }

  const ScratchDirectory scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(CommandOfASuite, FindsFilesBesideTheSuite) {
  EXPECT_EQ(CommandOf("python3 mine.py ids/theirs.py none.py {recording} --config=mine.py"),
            "python3 " + at("mine.py") + " " + at("ids/theirs.py") +
                " none.py {recording} --config=mine.py");
  EXPECT_EQ(CommandOf("'run it'"), "'" + at("run it") + "'") << "which PATH does not have";
  EXPECT_EQ(CommandOf("sh sh"), "sh " + at("sh")) << "a program of PATH stays one";
  const std::string once = CommandOf("python3 mine.py");
  EXPECT_EQ(CommandOf(once), once);
}

TEST_F(CommandOfASuite, ReadsItsOwnFilesAndNotTheSuite) {
  EXPECT_THAT(ReadableBy(Resolved("python3 mine.py")), Contains(folder_ / "mine.py"));
  EXPECT_THAT(ReadableBy(Resolved("python3 mine.py")), Not(Contains(folder_)));
  EXPECT_THAT(ReadableBy(Resolved("python3 ./mine.py")), Not(Contains(folder_ / ".")));
  EXPECT_THAT(ReadableBy(Resolved("python3 ids/theirs.py")), Contains(folder_ / "ids"))
      << "modules in a folder of their own";
}

TEST(ExternalIdentifier, IsNamedWithItsCommand) {
  EXPECT_EQ(ReadExternal("me=run {recording.h5} {estimate}").label, "me");
  for (const auto& [argument, lacking] : {std::pair{"me=run {recording}", "lacks {estimate}"},
                                          std::pair{"me=run {estimate}", "lacks {recording}"},
                                          std::pair{"=run {recording} {estimate}", "lacks its"}}) {
    EXPECT_THAT([&] { ReadExternal(argument); }, ThrowsMessage<BadInput>(HasSubstr(lacking)));
  }
}

TEST(ExternalIdentifier, AnswersWithAnEstimate) {
  const Estimate estimate = Ask(Shell(
      R"(echo '{"status": "ok", "recording": "of mine", "follows": 1, "project": [],)"
      R"( "parameters": {"coulomb": {"value": 2, "unit": "N.m", "std": null,)"
      R"( "interval95": null}}, "friction": {"law": "coulomb", "parameters": {"coulomb": 2}}}')"
      " > estimate.json"));
  EXPECT_EQ(estimate.status, Status::ok);
  EXPECT_EQ(estimate.Find("coulomb")->value, 2);
  EXPECT_FALSE(estimate.recording || estimate.follows) << "these are ours to say";
  ASSERT_TRUE(estimate.metrics) << "a friction is enough for the figures";
  EXPECT_EQ(estimate.metrics->n, 12);
}

TEST(ExternalIdentifier, CompletesTheDiscretePair) {
  const std::string value = R"("unit": "", "std": null, "interval95": null})";
  const Estimate estimate =
      Ask(Shell(R"(echo '{"status": "ok", "parameters": {"thermal_gain": {"value": -3, )" + value +
                R"(, "thermal_time_constant": {"value": 600, )" + value + "}}' > estimate.json"));
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
  EXPECT_THAT(Failure("ls $PWD/none; exit 3"), Not(HasSubstr("warmjoint_")));
}

TEST(ExternalIdentifier, ReadsFilesThatItNamesAndNoOthers) {
  const ScratchDirectory scratch, hidden;
  std::ofstream(hidden.path() / "secret") << "truth";
  std::ofstream(scratch.path() / "shown") << "shown";
  const std::string folder = scratch.path();
  EXPECT_THAT(Failure("cat $1; exit 1", "20", folder + "/shown"),
              HasSubstr("exit status 1: shown"));
  if (LandlockVersion() == 0) GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_THAT(Failure("cat $(echo " + hidden.path().string() + "/)secret; exit 1"),
              HasSubstr("Permission denied"));
}

TEST(ExternalIdentifier, AProgramOutOfReachIsToldWithItsRemedy) {
  if (LandlockVersion() == 0) GTEST_SKIP() << "this kernel has no Landlock";
  // an interpreter outside of the system's folders, and a script that starts it, as pyenv's
  const ScratchDirectory elsewhere, shims;
  const std::string interpreter = elsewhere.path() / "python3";
  std::filesystem::copy_file("/bin/sh", interpreter);
  std::ofstream(shims.path() / "python3") << "#!/bin/sh\nexec " + interpreter + " \"$@\"\n";
  std::filesystem::permissions(shims.path() / "python3", std::filesystem::perms(0755));
  const auto failure = [](const std::string& program) {
    return FailureOf(ReadExternal("a=" + program + " -c 'exit 7' {recording} {estimate}"));
  };
  EXPECT_THAT(failure(shims.path() / "python3"),
              HasSubstr("name the interpreter by its full path"));
  EXPECT_THAT(failure(interpreter), HasSubstr("exit status 7"));
}

TEST(ExternalIdentifier, FoldersNamesAreNoCommands) {
  const ScratchDirectory scratch;
  const auto evil = scratch.path() / "q`echo x`;touch P $(touch P)";
  std::filesystem::create_directory(evil);
  std::ofstream(evil / "id.sh") << "#!/bin/sh\nprintf '%s|' \"$@\"\n";
  std::filesystem::permissions(evil / "id.sh", std::filesystem::perms(0700));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(evil);
  EXPECT_EQ(FailureOf(ReadExternal("a=./id.sh 'a  b' {recording} {estimate}")),
            "bad_answer: wrote no estimate")
      << "it ran, and to its end";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(evil), {}), 1) << "P was made";
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace warmjoint
