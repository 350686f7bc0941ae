// Identifies a friction from a log of its own making and loads the plugin into MuJoCo: 0 where both
// work.
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"

namespace {

using namespace warmjoint;

/// 5 v + 15 sign v at four speeds in both directions.
Measurements Log() {
  const Eigen::Index n = 400;
  Measurements log;
  log.time = Eigen::VectorXd::LinSpaced(n, 0, 0.1 * (n - 1));
  log.velocity.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    log.velocity[i] = (i / 50 % 2 ? -1 : 1) * 0.2 * static_cast<double>(1 + i / 100);
  }
  log.position = Eigen::VectorXd::Zero(n);
  log.torque = 5 * log.velocity.array() + 15 * log.velocity.array().sign();
  return log;
}

bool Identifies() {
  const Measurements log = Log();
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const Options options(identifier.options, {}, {});
  const Estimate estimate = IdentifyUnjudged(identifier, {Prepare(log), options, {}});
  std::printf("%s: viscous %.6g, coulomb %.6g\n", estimate.identifier.c_str(),
              estimate.Find("viscous")->value, estimate.Find("coulomb")->value);
  // a fit without noise, up to rounding
  return std::abs(estimate.Find("viscous")->value - 5) < 1e-9 &&
         std::abs(estimate.Find("coulomb")->value - 15) < 1e-9;
}

bool LoadsThePlugin() {
  mj_loadPluginLibrary(PLUGIN);
  const std::string model = R"(<mujoco>
    <extension><plugin plugin="warmjoint.friction"/></extension>
    <worldbody><body><joint name="hinge" axis="0 0 1"/><geom size="0.1" mass="10"/></body></worldbody>
    <actuator><plugin joint="hinge" plugin="warmjoint.friction" actdim="2">
      <config key="law" value="coulomb"/><config key="coulomb" value="0.1"/>
    </plugin></actuator>
  </mujoco>)";
  char error[1000] = "";
  mjSpec* spec = mj_parseXMLString(model.c_str(), nullptr, error, sizeof error);
  mjModel* compiled = spec ? mj_compile(spec, nullptr) : nullptr;
  if (compiled)
    std::printf("plugin loaded: %d actuator\n", static_cast<int>(compiled->nactuator));
  else
    std::fprintf(stderr, "%s%s\n", error, spec ? mjs_getError(spec) : "");
  const bool loads = compiled != nullptr;
  mj_deleteModel(compiled);
  mj_deleteSpec(spec);
  return loads;
}

}  // namespace

int main() { return Identifies() && LoadsThePlugin() ? 0 : 1; }
