// Completion in the shell that reads it, with the real program behind it.
#include <gmock/gmock.h>

#include <sstream>

#include "tests/support/folders.h"
#include "tests/tools/cli/run_program.h"

namespace warmjoint {
namespace {

/// What bash offers for the last word of a command line: its words as bash parts them.
std::vector<std::string> Offers(const std::vector<std::string>& words) {
  const std::string script = test::SourceFolder() / "tools/cli/completion.bash";
  std::string line =
      "source " + script + "; COMP_WORDS=('" + (test::BuildFolder() / "warmjoint").string() + "' ";
  for (const std::string& word : words) line += "'" + word + "' ";
  line += "); COMP_CWORD=" + std::to_string(words.size());
  line += "; _warmjoint; echo \"${COMPREPLY[@]}\"";
  const ProgramAnswer answer = RunCommandLine({"bash", "--norc", "-c", line});
  EXPECT_EQ(answer.err, "");
  std::istringstream offers(answer.out);
  return {std::istream_iterator<std::string>(offers), {}};
}

TEST(Completion, OffersWhatFits) {
  using testing::UnorderedElementsAreArray;
  using Words = std::vector<std::string>;
  const std::pair<Words, Words> cases[]{
      {{"id"}, {"identify"}},
      {{"--ver"}, {"--version"}},
      {{"run", "--re"}, {"--realizations"}},
      {{"check", "log.csv", "--seg"}, {"--segments"}},
      {{"check", "log.csv", "--real"}, {}},
      {{"check", "log.csv", "--joint", ""}, {"rotary", "linear"}},
      {{"check", "log.csv", "--joint", "=", "l"}, {"linear"}},
      {{"check", "log.csv", "--joint", "="}, {"rotary", "linear"}},
      {{"-q", "predict", "e.json", "log.csv", "--initial", ""}, {"cold", "end"}},
      {{"plot", "runs", "--figure", ""}, {}},
      {{"list", ""}, {"laws", "identifiers", "robots", "suites"}},
      {{"list", "laws", "visc"}, {"viscous_coulomb"}},
      {{"run", "tab"}, {"table1", "table1-mujoco", "table1-rests"}},
      {{"attach", "pend"}, {"pendulum"}},
      {{"identify", "log.csv", "--identifier", "energy-al"}, {"energy-als"}},
      {{"identify", "log.csv", "--set", "law", "=", "visc"}, {"viscous_coulomb"}},
      {{"check", "lo"}, {}},  // bash offers files where nothing else is
  };
  for (const auto& [words, offers] : cases) {
    EXPECT_THAT(Offers(words), UnorderedElementsAreArray(offers)) << testing::PrintToString(words);
  }
}

}  // namespace
}  // namespace warmjoint
