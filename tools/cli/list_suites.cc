#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenarios/suite.h"
#include "tools/cli/families.h"
#include "tools/cli/suite_names.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {

using nlohmann::ordered_json;
namespace fs = std::filesystem;
namespace {

/// A file by the shorter of its names: from the working directory, or from the root.
std::string SeenFromHere(const fs::path& file) {
  const std::string here = fs::proximate(file);
  return here.size() < file.native().size() ? here : file.native();
}

}  // namespace

ordered_json SuitesJson() {
  ordered_json suites = ordered_json::array();
  for (const std::string& name : SuiteNames()) {
    // read in full: its variants and labels come of reading it
    const std::string file = SuiteFile(name);
    const Suite suite = ReadSuite(file);
    ordered_json identifiers = ordered_json::array();
    for (const SuiteIdentifier& one : suite.identifiers) identifiers.push_back(one.label);
    suites.push_back({{"name", suite.name},
                      {"question", suite.question},
                      {"realizations", suite.realizations},
                      {"variants", suite.variants()},
                      {"identifiers", identifiers},
                      {"file", file}});
  }
  return suites;
}

std::string SuiteLine(const ordered_json& suite, int width) {
  return Wrap(fmt::format("{}\n    {}\n", suite["name"].get<std::string>(),
                          suite["question"].get<std::string>()),
              width, 0);
}

std::string SuiteText(const ordered_json& suite, int width) {
  return SuiteLine(suite, width) +
         Wrap(fmt::format("    {} realizations of {}\n    identifiers: {}\n",
                          suite["realizations"].get<int>(),
                          suite["variants"] == 1
                              ? std::string("one scenario")
                              : fmt::format("each of {} scenarios", suite["variants"].get<int>()),
                          fmt::join(suite["identifiers"].get<std::vector<std::string>>(), ", ")),
              width, 2) +
         fmt::format("    {}\n", SeenFromHere(suite["file"].get<std::string>()));
}

}  // namespace warmjoint::inline tools
