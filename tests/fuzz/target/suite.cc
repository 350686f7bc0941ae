// Suites as YAML, and as they are written again.
#include "scenarios/suite.h"

#include "tests/fuzz/fuzz.h"

void warmjoint::fuzz::Read(std::string_view bytes) {
  const Suite suite = ParseSuite(std::string(bytes), "fuzz.yaml");
  fuzz::Require(suite.realizations >= 1 && suite.variants() >= 1 && !suite.identifiers.empty());
  const std::string written = SuiteToYaml(suite);
  fuzz::Require(SuiteToYaml(ParseSuite(written, "fuzz.yaml")) == written);
}
