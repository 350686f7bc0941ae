// Completion scripts in the shells that read them, with the real program behind them.
#include "tools/parser/completion.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"
#include "tools/terminal/wrap.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::UnorderedElementsAre;

bool IsThere(const std::string& program) {
  return RunCommandLine({"sh", "-c", "command -v " + program}).status == 0;
}

class Completion : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(RunWarmjoint({"completion", "bash", "-o", script_}).status, 0);
    WriteWholeFile(scratch_.path() / "log.csv", "");
    std::filesystem::create_directory(scratch_.path() / "runs");
  }

  /// What bash offers for the last word of a command line: its words as bash parts them.
  std::vector<std::string> Offers(std::vector<std::string> words) const {
    words.insert(words.begin(), (test::BuildFolder() / "warmjoint").string());
    std::string line = "source " + script_ + "; COMP_WORDS=(";
    for (const std::string& word : words) line += "'" + word + "' ";
    line += "); COMP_CWORD=" + std::to_string(words.size() - 1);
    line += "; _warmjoint; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const ProgramAnswer answer =
        RunCommandLine({"bash", "--norc", "-c", line}, {scratch_.path(), {}});
    EXPECT_EQ(answer.err, "");
    std::vector<std::string> offers;
    for (const std::string& offer : Lines(answer.out)) {
      if (!offer.empty()) offers.push_back(offer);
    }
    return offers;
  }

  ScratchDirectory scratch_;
  std::string script_ = scratch_.path() / "completion";
};

TEST_F(Completion, OffersCommandsAndTheirOptions) {
  EXPECT_THAT(Offers({""}), IsSupersetOf({"list", "check", "identify", "run", "new", "man"}));
  EXPECT_THAT(Offers({"id"}), UnorderedElementsAre("identify"));
  EXPECT_THAT(Offers({"help", "com"}), UnorderedElementsAre("compare", "completion"));
  EXPECT_THAT(Offers({"run", "--re"}), UnorderedElementsAre("--realizations"));
  EXPECT_THAT(Offers({"check", "log.csv", "--"}),
              AllOf(Contains("--segments"), Not(Contains("--realizations"))));
}

TEST_F(Completion, OffersChoicesOfOptionsInBothForms) {
  EXPECT_THAT(Offers({"check", "log.csv", "--joint", ""}),
              UnorderedElementsAre("rotary", "linear"));
  EXPECT_THAT(Offers({"check", "log.csv", "--joint", "=", "l"}), UnorderedElementsAre("linear"));
  EXPECT_THAT(Offers({"check", "log.csv", "--joint", "="}),
              UnorderedElementsAre("rotary", "linear"));
  EXPECT_THAT(Offers({"list", ""}),
              UnorderedElementsAre("laws", "identifiers", "robots", "suites"));
}

TEST_F(Completion, OffersNoPlaceholders) {
  EXPECT_THAT(Offers({"predict", "e.json", "log.csv", "--initial", ""}),
              UnorderedElementsAre("cold", "end"));
  EXPECT_THAT(Offers({"plot", "runs", "--figure", ""}), IsEmpty());
}

TEST_F(Completion, OffersMembersOfFamiliesByName) {
  EXPECT_THAT(Offers({"run", "tab"}),
              UnorderedElementsAre("table1", "table1-mujoco", "table1-rests"));
  EXPECT_THAT(Offers({"attach", "pend"}), UnorderedElementsAre("pendulum"));
  EXPECT_THAT(Offers({"identify", "log.csv", "--identifier", "energy-"}),
              IsSupersetOf({"energy-ml", "energy-als"}));
  EXPECT_THAT(Offers({"identify", "log.csv", "--set", "law", "=", "visc"}),
              UnorderedElementsAre("viscous_coulomb"));
  EXPECT_THAT(Offers({"list", "laws", "visc"}), UnorderedElementsAre("viscous_coulomb"));
}

TEST_F(Completion, OffersFilesAndFolders) {
  EXPECT_THAT(Offers({"check", "lo"}), UnorderedElementsAre("log.csv"));
  EXPECT_THAT(Offers({"check", "--joint", "linear", "lo"}), UnorderedElementsAre("log.csv"));
  EXPECT_THAT(Offers({"predict", "lo"}), UnorderedElementsAre("log.csv"));
  EXPECT_THAT(Offers({"compare", ""}), UnorderedElementsAre("runs"));
  EXPECT_THAT(Offers({"attach", "pendulum", "--joint", "hinge", "=", "lo"}),
              UnorderedElementsAre("log.csv"));
  EXPECT_THAT(Offers({"simulate", "x.yaml", "-o", "r"}), UnorderedElementsAre("runs"));
}

TEST(ZshCompletion, IsReadByZsh) {
  if (!IsThere("zsh")) GTEST_SKIP() << "zsh is absent";
  const ScratchDirectory scratch;
  const std::string script = scratch.path() / "_warmjoint";
  ASSERT_EQ(RunWarmjoint({"completion", "zsh", "-o", script}).status, 0);
  const ProgramAnswer syntax = RunCommandLine({"zsh", "-f", "-n", script});
  EXPECT_EQ(syntax.status, 0) << syntax.err;

  // its completion system takes the function for the program
  const ProgramAnswer loaded =
      RunCommandLine({"zsh", "-f", "-c",
                      "fpath=(" + scratch.path().string() +
                          " $fpath); autoload -Uz compinit; compinit -u -D; "
                          "print $_comps[warmjoint]"});
  EXPECT_EQ(loaded.out, "_warmjoint\n") << loaded.err;

  // names come from the program
  const ProgramAnswer names =
      RunCommandLine({"zsh", "-f", "-c",
                      "compdef() {}; compadd() { print -l -- ${(P)2} }; program=" +
                          (test::BuildFolder() / "warmjoint").string() + "; source " + script +
                          "; _warmjoint_names laws"});
  EXPECT_THAT(Lines(names.out), IsSupersetOf({"coulomb", "asymmetric"})) << names.err;
}

}  // namespace
}  // namespace warmjoint
