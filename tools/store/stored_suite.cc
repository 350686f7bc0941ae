#include "tools/store/stored_suite.h"

#include "models/foundation/atomic_file.h"
#include "scenarios/parse_suite.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

template <typename Range, typename Name>
std::vector<std::string> NamesOf(const Range& range, Name name) {
  std::vector<std::string> names;
  for (const auto& one : range) names.push_back(one.*name);
  return names;
}

}  // namespace

Suite StoredSuite(const RunStore& store) {
  const RunDescription description = store.ReadDescription();
  const std::string file = store.results_file();
  const Suite suite = ParseSuite(description.suite_yaml, file);
  // names beside the results have to be those of the suite
  const bool same =
      NamesOf(suite.identifiers, &SuiteIdentifier::label) == description.identifiers &&
      description.variants == (suite.ladder ? NamesOf(suite.ladder->variants, &Variant::name)
                                            : std::vector<std::string>());
  if (!same) {
    Refuse({file},
           "lists other identifiers or variants than its suite; it was changed after the run");
  }
  return suite;
}

void TellOfEditedSuite(const RunStore& store) {
  const std::filesystem::path file = store.suite_file();
  // nobody minds a file that is gone: the database has the suite
  if (!std::filesystem::exists(file)) return;
  if (ReadWholeFile(file) == store.ReadDescription().suite_yaml) return;
  SayNotice("notice: {} was edited; the suite that the run stored is taken\n", file.string());
}

}  // namespace warmjoint::inline tools
