#include "tools/suite/describe_run.h"

#include <ceres/version.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "tools/suite/arithmetic.h"

namespace warmjoint::inline tools {

RunDescription Describe(const Suite& suite) {
  RunDescription description;
  description.suite_yaml = SuiteToYaml(suite);
  for (const SuiteIdentifier& identifier : suite.identifiers) {
    description.identifiers.push_back(identifier.label);
  }
  if (suite.ladder) {
    for (const Variant& variant : suite.ladder->variants) {
      description.variants.push_back(variant.name);
    }
  }
  // all that the numbers may depend on
  description.versions = {
      {"arithmetic", ArithmeticDigest()},
      {"ceres", CERES_VERSION_STRING},
      {"eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"mujoco", mj_versionString()},
      {"warmjoint", WARMJOINT_VERSION},
  };
  return description;
}

}  // namespace warmjoint::inline tools
