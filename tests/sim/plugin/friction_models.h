// Small models with warm friction, and what the engine says of them, for the plugin's tests.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <map>
#include <string>

#include "sim/model/spec_elements.h"
#include "sim/plugin/register.h"

namespace warmjoint::test {

using Model = ModelPtr;
using Data = DataPtr;

/// A model as it is written.
inline SpecPtr ParseXml(const std::string& xml) {
  char error[500] = "";
  SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof(error)));
  EXPECT_TRUE(spec) << error;
  return spec;
}

/// A model, or nothing and the engine's message.
struct Compiled {
  Model model;
  std::string error;
};

inline Compiled Compile(const std::string& xml) {
  RegisterFrictionPlugin();
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof(error)));
  if (!spec) return {nullptr, error};
  Model model(mj_compile(spec.get(), nullptr));
  if (!model) return {nullptr, mjs_getError(spec.get())};
  return {std::move(model), ""};
}

inline Model MustCompile(const std::string& xml) {
  auto compiled = Compile(xml);
  EXPECT_EQ(compiled.error, "");
  return std::move(compiled.model);
}

using Config = std::map<std::string, std::string>;

/// What else the actuator of FrictionSection has.
struct ActuatorExtras {
  std::string attributes{};
  int states = 2;
  std::string joint = "hinge";
};

/// Friction "f" on a joint, as an <actuator> section.
inline std::string FrictionSection(const Config& config, const ActuatorExtras& extras = {}) {
  std::string keys;
  for (const auto& [key, value] : config) {
    keys += fmt::format(R"(<config key="{}" value="{}"/>)", key, value);
  }
  return fmt::format(R"(
  <actuator>
    <plugin name="f" joint="{}" plugin="warmjoint.friction" actdim="{}" {}>{}</plugin>
  </actuator>)",
                     extras.joint, extras.states, extras.attributes, keys);
}

/// A model of one body, given as its joint and inertial, without contacts.
inline std::string OneBodyXml(const std::string& body, const std::string& sections,
                              const std::string& option) {
  return fmt::format(R"(
<mujoco>
  <extension><plugin plugin="warmjoint.friction"/></extension>
  <option {}><flag contact="disable" eulerdamp="disable"/></option>
  <worldbody><body>{}</body></worldbody>
  {}
</mujoco>)",
                     option, body, sections);
}

/// One link: inertia 0.25 kg.m^2 and weight 1 kg 0.5 m from the hinge's horizontal axis, or no
/// gravity. `sections`: further MJCF; `joint`: further attributes of the joint.
inline std::string LinkXml(const std::string& sections, const std::string& option,
                           const std::string& joint = "") {
  const std::string body = fmt::format(R"(
    <joint name="hinge" type="hinge" axis="0 1 0" {}/>
    <inertial pos="0.5 0 0" mass="1" diaginertia="1e-9 1e-9 1e-9"/>)",
                                       joint);
  return OneBodyXml(body, sections, option);
}

/// A carriage of 3 kg on the vertical joint "slide". `sections`: further MJCF.
inline std::string CarriageXml(const std::string& sections, const std::string& option) {
  return OneBodyXml(R"(
    <joint name="slide" type="slide" axis="0 0 1"/>
    <inertial pos="0 0 0" mass="3" diaginertia="1e-3 1e-3 1e-3"/>)",
                    sections, option);
}

inline constexpr char kNoGravity[] = R"(timestep="0.001" gravity="0 0 0")";

/// All warnings of the engine, while it lives.
class Warnings {
 public:
  Warnings() {
    text() = "", mju_user_warning = [](const char* message) { text() += message; };
  }
  ~Warnings() { mju_user_warning = nullptr; }
  static std::string& text() {
    static std::string all;
    return all;
  }
};

}  // namespace warmjoint::test
