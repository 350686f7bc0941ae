// Models that the plugin refuses: who, which key, which value, which bound; and what it takes.
// Of 1500 that someone mistyped each is refused with a sentence or stepped.
#include "sim/plugin/attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/random_stream.h"
#include "models/foundation/xml_tags.h"
#include "models/friction/friction_json.h"
#include "tests/sim/plugin/two_forms.h"
#include "tests/support/folders.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using namespace test;

const Config kGood{{"law", "viscous_coulomb"}, {"viscous", "5"}, {"coulomb", "15"}};

Config With(const Config& more) {
  Config config = more;
  config.insert(kGood.begin(), kGood.end());
  return config;
}

std::string ErrorOf(const Config& config, const ActuatorExtras& extras = {},
                    const std::string& joint = "") {
  Config escaped;
  for (const auto& [key, value] : config) escaped[key] = EscapeXml(value);
  return Compile(LinkXml(FrictionSection(escaped, extras), kNoGravity, joint)).error;
}

/// An actuator that is refused, and what the refusal names.
struct Refused {
  Config config;
  std::vector<std::string> names;
  ActuatorExtras extras{};
};

void ExpectRefused(const std::vector<Refused>& all) {
  for (const Refused& refused : all) {
    const std::string error = ErrorOf(refused.config, refused.extras);
    ExpectNamed(error, refused.names);
    // by its actuator, and once
    const std::string start = "warmjoint.friction: actuator 'f': ";
    const size_t first = error.find(start);
    ASSERT_NE(first, std::string::npos) << error;
    EXPECT_EQ(error.find(start, first + 1), std::string::npos) << error;
  }
}

TEST(PluginAttributes, RefuseNumbersByKeyValueAndBound) {
  ExpectRefused({
      {With({{"viscous", "5x"}}), {"viscous is '5x'", "at least 0"}},
      {With({{"coulomb", "nan"}}), {"coulomb is 'nan'", "number"}},
      {With({{"coulomb", "-3"}}), {"coulomb is '-3'", "at least 0"}},
      {With({{"gear", "0"}}), {"gear is 0"}},
      {With({{"load_gain", "1e9"}}), {"load_gain is '1e9'", "at most 100"}},
      {With({{"thermal_gain", "-1e300"}, {"thermal_time_constant", "10"}}),
       {"thermal_gain is '-1e300'", "at least -1000000"}},
      {With({{"thermal_gain", "-3"}, {"thermal_time_constant", "0"}}),
       {"thermal_time_constant is '0'", "above 0"}},
      {With({{"second_thermal_gain", "-3"}}),
       {"second_thermal_gain", "second_thermal_time_constant", "both or neither"}},
  });
}

TEST(PluginAttributes, RefuseWhatTheLawLacksOrNeeds) {
  EXPECT_NE(ErrorOf(With({{"viscos", "5"}})).find("viscos"), std::string::npos);
  ExpectRefused({
      {{{"law", "viscous_coulom"}}, {"'viscous_coulom'", "did you mean 'viscous_coulomb'"}},
      {With({{"coulomb_positive", "5"}}), {"law viscous_coulomb", "'coulomb_positive'"}},
      {{{"law", "viscous_coulomb"}, {"viscous", "5"}}, {"lacks its parameter coulomb"}},
      {{{"viscous", "5"}}, {"law is missing"}},
      {{{"coulomb", "3"}, {"law", "coulomb"}, {"maps", "{}"}}, {"maps is a map", "list"}},
      {{{"coulomb", "3"}, {"law", "coulomb"}, {"maps", R"([{"axes": []}])"}},
       {"'maps.0.weights' is missing"}},
  });
}

TEST(PluginAttributes, ReadAFrictionFileInstead) {
  const std::string path = testing::TempDir() + "/friction_of_attributes_test.json";
  WriteWholeFile(path, R"({"law": "coulomb", "parameters": {"coulomb": 6}})");
  EXPECT_EQ(ErrorOf({{"file", path}}), "");
  ExpectRefused({{{{"file", path}, {"law", "coulomb"}}, {"law is 'coulomb'", "file '/"}},
                 {{{"file", path + "x"}}, {path + "x", "cannot be read"}},
                 {{{"file", "lost.json"}}, {"lost.json", "give folder"}}});
}

TEST(PluginAttributes, HoldTheFrictionOfSeveralJoints) {
  const std::string six = R"({"law": "coulomb", "parameters": {"coulomb": 6}})";
  const auto joints = [](const std::string& text) { return Config{{"joints", text}}; };
  EXPECT_EQ(ErrorOf(joints(R"({"hinge": )" + six + "}")), "");
  ExpectRefused({
      {joints("[]"), {"joints", "JSON object"}},
      {joints("x"), {"joints is 'x'", "JSON"}},
      {joints(R"({"hinge": {"law": "coulomb", "parameters": {"coulomb": -6}}})"),
       {"joints: hinge", "coulomb is -6"}},
      {joints(R"({"hing": )" + six + "}"), {"'hinge'", "did you mean 'hing'"}},
      {joints(R"({"hinge": )" + six + R"(, "elbow": )" + six + "}"), {"joints names 'elbow'"}},
      {joints(R"({"hinge": )" + six + R"(, "hinge": )" + six + "}"),
       {"joints names 'hinge' twice"}},
      {{{"joints", "{}"}, {"law", "coulomb"}}, {"law is 'coulomb'", "joints '{}'"}},
  });
}

TEST(PluginActuator, RefusesWhatWouldBreakFriction) {
  const Config stiction{{"law", "stiction"}, {"viscous", "1"}, {"coulomb", "5"}, {"static", "6"}};
  ExpectRefused({
      {kGood, {"forcerange"}, {R"(forcerange="-1 1")"}},
      {kGood, {"gear is 2"}, {R"(gear="2")"}},
      {kGood, {"actdim is 3", "2 (bristle load, energy)"}, {.states = 3}},
      {kGood, {"actdim is not given, or below 1", "2 (bristle load, energy)"}, {.states = -1}},
      {stiction, {"actdim is 2", "3 (bristle load, energy, slip)"}},
  });
  ExpectNamed(ErrorOf(kGood, {}, R"(actuatorfrcrange="-9 9")"),
              {"actuator 'f'", "joint 'hinge' has actuatorfrcrange"});
  // by MuJoCo itself
  ExpectNamed(ErrorOf(kGood, {R"(actlimited="true" actrange="-1 1")"}), {"actrange", "'f'"});

  // a second friction on its joint
  std::string two = FrictionSection(kGood);
  const std::string second = two;
  two.replace(two.find("name=\"f\""), 8, "name=\"g\"");
  ExpectNamed(Compile(LinkXml(second + two, kNoGravity)).error,
              {"actuator 'g'", "joint 'hinge' has friction already, by actuator 'f'"});
}

TEST(PluginActuator, RefusesWhatTheStepCannotCarryWithTheRemedy) {
  // inertia 0.25 kg.m^2: 250 N.m.s/rad at 1 ms need 0.5 kg.m^2, 1e6 N.m/rad 1 / 0.9 kg.m^2
  Config dahl{{"law", "dahl"}, {"coulomb", "5"}, {"bristle_stiffness", "1e6"}};
  ExpectRefused({
      {With({{"viscous", "250"}}), {"armature of 0.25", "timestep of at most 0.0005"}},
      {dahl, {"bristle_stiffness is 1000000", "armature of 0.87", "0.000474 s"}},
  });
  EXPECT_EQ(ErrorOf(With({{"viscous", "250"}}), {}, R"(armature="0.253")"), "");
  dahl["bristle_stiffness"] = "1e4";
  EXPECT_EQ(ErrorOf(dahl), "");

  // 32 kN on 3 kg at 1 ms: 32000 N h^2 / (0.64 M) = 17 mm
  ExpectNamed(
      Compile(CarriageXml(
                  FrictionSection({{"law", "coulomb"}, {"coulomb", "32000"}}, {.joint = "slide"}),
                  kNoGravity))
          .error,
      {"actuator 'f'", "0.0167 m", "0.005", "armature of 7.07", "timestep of at most 0.000547"});
}

/// An arm with this text in place of another.
std::string ErrorOfArm(const Friction& friction, const std::string& from, const std::string& to) {
  std::string xml = SensedArmXml(friction, Form::passive);
  const size_t at = xml.find(from);
  return Compile(xml.replace(at, from.size(), to)).error;
}

TEST(PluginPassive, RefusesWhatItCannotServe) {
  const Friction friction = FrictionsOfEveryLaw()[0];
  const std::string end = "</mujoco>", config = R"(<config key="instance" value="arm"/>)";
  const struct {
    std::string from, to;
    std::vector<std::string> names;
  } cases[] = {
      {"&quot;j2&quot;", "&quot;j3&quot;", {"plugin instance 'arm'", "'j3'", "did you mean"}},
      {R"(name="j1" axis="1 0 0")", R"(name="j1" type="ball")", {"joint 'j1'", "hinge nor slide"}},
      // one that has friction from an actuator of its own
      {R"(<motor joint="j0"/>)",
       R"(<plugin name="f" joint="j0" plugin="warmjoint.friction" actdim="2">
          <config key="law" value="coulomb"/><config key="coulomb" value="1"/></plugin>)",
       {"joint 'j0' has friction already, by actuator 'f'"}},
      {R"(instance="arm" /></sensor>)",
       R"(instance="arm" objtype="joint" objname="j1"/></sensor>)",
       {"sensor 's'", "joint_sensors"}},
      {config, config + R"(<config key="joint_sensors" value="true"/>)", {"sensor 's'", "a joint"}},
      {config, config + R"(<config key="joint_sensors" value="1"/>)", {"joint_sensors is '1'"}},
      {end,
       R"(<custom><numeric name="arm/viscous" size="3"/></custom>)" + end,
       {"numeric 'arm/viscous'", "'viscous'"}},
      {end,
       R"(<custom><numeric name="arm/coulomb" size="2"/></custom>)" + end,
       {"numeric 'arm/coulomb'", "2 numbers", "give 3"}},
      {config, config + R"(<config key="initial_energy" value="x"/>)", {"initial_energy is 'x'"}},
      {config,
       config + R"(<config key="initial_energy" value='{"j4": 1}'/>)",
       {"'initial_energy.j4'", "did you mean"}},
  };
  for (const auto& [from, to, names] : cases) {
    const std::string error = ErrorOfArm(friction, from, to);
    ExpectNamed(error, names);
  }

  // an initial energy for the stages that there are
  Friction other = friction;
  const std::string one = config + R"(<config key="initial_energy" value="-1"/>)";
  other.second_thermal = Thermal{-0.01, 0.5};
  ExpectNamed(ErrorOfArm(other, config, one), {"initial_energy is '-1'", "two numbers"});
  other.thermal.reset();
  other.second_thermal.reset();
  ExpectNamed(ErrorOfArm(other, config, one), {"initial_energy", "thermal"});
}

/// One to four changes: bytes flipped, cut, doubled, or replaced by what numbers and JSON are of.
std::string Mutate(std::string text, RandomStream& random) {
  const std::string parts[] = {"-",  "1e9", "1e400", "nan",  "0",  "{", "]", ",", "\"",
                               "[]", "{}",  "null",  "true", "-0", ":", ".", "e", " "};
  const auto draw = [&](size_t below) {
    return static_cast<size_t>(random.Uniform(0, static_cast<double>(below)));
  };
  for (size_t changes = 1 + draw(4); changes > 0 && !text.empty(); --changes) {
    const size_t at = draw(text.size()), length = 1 + draw(std::min<size_t>(8, text.size() - at));
    switch (draw(4)) {
      case 0:
        text[at] = static_cast<char>(32 + draw(95));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, draw(2) * length, parts[draw(std::size(parts))]);
    }
  }
  return text;
}

/// One to three digits are others, or become several.
std::string MutateNumbers(std::string text, RandomStream& random) {
  const char* const digits = "0123456789";
  const std::string parts[] = {"0", "7", "99", "-1", "1e3", "1e-9", "1e99", "."};
  for (auto changes = static_cast<int>(random.Uniform(1, 4)); changes > 0; --changes) {
    const auto from = static_cast<size_t>(random.Uniform(0, static_cast<double>(text.size())));
    const size_t at = text.find_first_of(digits, from);
    if (at == std::string::npos) continue;
    text.replace(at, 1, parts[static_cast<size_t>(random.Uniform(0, std::size(parts)))]);
  }
  return text;
}

/// The text of `joints` in ArmXml, mutated.
std::string MutatedArm(const Friction& friction, Form form, RandomStream& random) {
  std::string xml = ArmXml(friction, form, "implicitfast");
  const std::string begin = R"(key="joints" value=")";
  const size_t from = xml.find(begin) + begin.size(), to = xml.find('"', from);
  nlohmann::json joints;
  for (int i = 0; i < kArmJoints; ++i) joints[fmt::format("j{}", i)] = FrictionToTree(friction);
  const bool numbers = random.Uniform(0, 1) < 0.5;
  const std::string text =
      numbers ? MutateNumbers(joints.dump(), random) : Mutate(joints.dump(), random);
  return xml.replace(from, to - from, EscapeXml(text));
}

TEST(PluginMutations, AreRefusedInASentenceOrStepToFiniteStates) {
  const std::vector<Friction> frictions = FrictionsOfEveryLaw();
  int refused = 0, taken = 0;
  for (std::uint64_t run = 0; run < 1500; ++run) {
    RandomStream random({12, run}, Stream::test);
    const Form form = run % 2 == 0 ? Form::actuator : Form::passive;
    const std::string xml = MutatedArm(frictions[run % frictions.size()], form, random);
    SCOPED_TRACE(fmt::format("run {}", run));
    const Compiled compiled = Compile(xml);
    if (!compiled.model) {
      ++refused;
      // who, and more than a word
      const bool named = compiled.error.find("actuator") != std::string::npos ||
                         compiled.error.find("plugin instance 'arm'") != std::string::npos;
      EXPECT_TRUE(named) << compiled.error;
      EXPECT_GT(compiled.error.size(), 60U) << compiled.error;
      continue;
    }
    ++taken;
    const Data d(mj_makeData(compiled.model.get()));
    DriveArm(compiled.model.get(), d.get(), 300);
    for (const mjtNum x : FullState(compiled.model.get(), d.get())) ASSERT_TRUE(std::isfinite(x));
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(taken, 100);
}

TEST(PluginPage, HasAModelThatRuns) {
  const std::string page = ReadWholeFile(SourceFolder() / "sim/plugin/attributes.md");
  const size_t begin = page.find("```xml\n") + 7;
  const auto compiled = Compile(page.substr(begin, page.find("```", begin) - begin));
  ASSERT_EQ(compiled.error, "");

  // the link falls, and its friction gets warm
  const Data d(mj_makeData(compiled.model.get()));
  for (int i = 0; i < 300; ++i) mj_step(compiled.model.get(), d.get());
  EXPECT_GT(d->qpos[0], 0.01);
  EXPECT_LT(d->act[1], 0);
}

}  // namespace
}  // namespace warmjoint
