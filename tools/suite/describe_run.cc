#include "tools/suite/describe_run.h"

#include <ceres/version.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Core>

namespace warmjoint {

RunDescription Describe(const Suite& suite) {
  RunDescription description;
  description.suite_yaml = SuiteToYaml(suite);
  // all that the numbers may depend on
  description.versions = {
      {"ceres", CERES_VERSION_STRING},
      {"eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"mujoco", mj_versionString()},
      {"warmjoint", Version()},
  };
  return description;
}

}  // namespace warmjoint
