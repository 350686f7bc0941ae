#include "tools/actions/attach_settings.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/read_json.h"
#include "models/friction/friction_json.h"
#include "tools/actions/carried_heat.h"

namespace warmjoint::inline tools {
namespace {

const std::map<std::string, mjtIntegrator> kIntegrators{{"Euler", mjINT_EULER},
                                                        {"RK4", mjINT_RK4},
                                                        {"implicit", mjINT_IMPLICIT},
                                                        {"implicitfast", mjINT_IMPLICITFAST},
                                                        {"discrete", mjINT_DISCRETE}};

/// What an estimate's verdict says against its friction; empty where there is nothing.
std::string WarningOf(const std::string& path) {
  const nlohmann::json object = ReadJsonFile(path);
  if (!object.is_object() || !object.contains("status") || object["status"] == "ok") return "";
  const std::string status =
      object["status"].is_string() ? Excerpt(object["status"].get<std::string>()) : "of no status";
  // an estimate without numbers cannot become a model
  if (object.contains("friction") && object["friction"].is_null()) {
    Refuse({path}, "is {} and holds no friction; identify again with --force to use it anyway",
           status);
  }
  return fmt::format("{} is {}: its friction is void, and so is that of the model", path, status);
}

}  // namespace

std::vector<std::string> IntegratorNames() {
  std::vector<std::string> names;
  for (const auto& [name, unused] : kIntegrators) names.push_back(name);
  return names;
}

AttachOptions CheckedOptions(const AttachSettings& settings) {
  AttachOptions options;
  // how friction enters the model
  if (settings.form != "actuator" && settings.form != "passive") {
    Refuse({"--as"}, "is '{}'{}", Excerpt(settings.form),
           Suggestion(settings.form, {"actuator", "passive"}));
  }
  if (settings.form == "passive") options.form = FrictionForm::passive;
  // inertia of motors, by joint
  for (const auto& [joints, value] : settings.armatures) {
    if (!std::isfinite(value) || value < 0) {
      Refuse({"--armature"}, "of '{}' is {}; it must be a number of 0 or more, kg.m^2 or kg",
             Excerpt(joints), value);
    }
    options.armatures.push_back({joints, value});
  }

  // the engine
  if (!settings.integrator.empty()) {
    const auto found = kIntegrators.find(settings.integrator);
    if (found == kIntegrators.end()) {
      Refuse({"--integrator"}, "is '{}'{}", Excerpt(settings.integrator),
             Suggestion(settings.integrator, IntegratorNames()));
    }
    options.integrator = found->second;
  }
  options.timestep = settings.timestep;
  if (options.timestep && !(std::isfinite(*options.timestep) && *options.timestep > 0)) {
    Refuse({"--timestep"}, "is {}; it must be above 0, s", *options.timestep);
  }

  // where meshes lie
  for (const auto& [name, folder] : settings.packages) {
    if (!std::filesystem::is_directory(folder)) {
      Refuse({"--package"}, "of '{}' is '{}', which is not a folder", Excerpt(name),
             Excerpt(folder));
    }
    options.packages[name] = folder;
  }
  return options;
}

FrictionForJoint ReadFrictionForJoint(const std::string& joint, const std::string& file,
                                      const std::string& initial,
                                      std::vector<std::string>& warnings) {
  std::string warning = WarningOf(file);
  if (!warning.empty()) warnings.push_back(std::move(warning));
  FrictionForJoint friction{joint, ReadFrictionFile(file)};
  friction.initial_energy = InitialEnergy(initial, friction.friction, file);
  return friction;
}

}  // namespace warmjoint::inline tools
