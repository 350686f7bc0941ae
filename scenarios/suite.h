// A suite: one scenario, many realizations, several identifiers, one question.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scenario.h"

namespace warmjoint {

/// What another source claims for a row of the leaderboard, printed beside ours.
struct Claim {
  std::string source;                    // for example "paper, Fig. 6"
  std::optional<double> npe_continuous;  // 0.05 is 5 %
  std::optional<double> rmse;            // N.m or N
};

/// An identifier as a suite runs it.
struct SuiteIdentifier {
  std::string name;                            // in the list of identifiers
  std::string label;                           // row of the leaderboard; the name where not given
  std::map<std::string, std::string> options;  // as --set of `identify`
  std::optional<Claim> claim;
};

struct Suite {
  std::string name;
  std::string question;
  int realizations = 1;
  Scenario scenario;  // its seed is the suite's
  std::vector<SuiteIdentifier> identifiers;
};

/// Reads a suite file; the scenario stands under `scenario:`. Throws BadInput as ReadScenario does.
Suite ReadSuite(const std::string& path);

/// The whole suite, defaults written out; ReadSuite of it gives the same suite.
std::string SuiteToYaml(const Suite& suite);

}  // namespace warmjoint
