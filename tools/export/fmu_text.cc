#include "tools/export/fmu_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/sha256.h"
#include "models/foundation/xml_tags.h"
#include "tools/export/code_lines.h"
#include "tools/export/controller_code.h"
#include "tools/export/fmu_sources.h"

namespace warmjoint {
namespace {

/// Causality of a variable.
enum class Cause { input, output, parameter };

/// A variable of a joint: a member of wj_simulated (fmu/warmjoint_fmu.c).
struct FmuVariable {
  std::string name;
  Cause cause;
  std::string member;
  std::string unit;
  double start = 0;
  std::string description;
};

struct FmuSwitch {
  const char* name;
  Cause cause;
  const char* description;
};

/// In the order of their value references, behind the numbers.
constexpr std::array<FmuSwitch, 3> kSwitches{{
    {"torque_is_measured", Cause::parameter, "whether `torque` is measured; else open loop"},
    {"is_corrected", Cause::parameter, "whether a measured torque corrects the level"},
    {"contact", Cause::output, "the residual is more than friction explains"},
}};

/// In the order of their value references.
std::vector<FmuVariable> NumbersOf(const SeenFriction& seen) {
  const auto in = [&](const JointUnit& unit) { return std::string(unit.For(seen.kind)); };
  const std::string torque = in(kTorqueUnit), speed = in(kVelocityUnit);
  using enum Cause;
  std::vector<FmuVariable> all{
      {"velocity", input, "velocity", speed, 0, "measured"},
      {"torque", input, "torque", torque, 0, "of the motor, less weight and inertia"},
      {"position", input, "position", in(kPositionUnit), 0, "of the joint, for maps"},
      {"load", input, "load", torque, 0, "that the joint transmits"},
      {"ambient_rise", input, "ambient_rise", "K", 0, "of the surroundings"},
      {"compensation", output, "compensation", torque, 0, "what compensates `share` of friction"},
      {"friction", output, "joint.found.friction", torque, 0, "what the joint brakes with"},
      {"residual", output, "residual", torque, 0, "measured torque - friction; 0 at rest"},
      {"energy", output, "joint.found.energy", torque, 0, "E of the heat, both stages"},
      {"std", output, "joint.found.std", torque, 0, "standard deviation of the level"},
      {"share", parameter, "share", "1", 0.9, "of friction that is compensated, 0 to 1"},
      {"dead_band", parameter, "dead_band", speed, 0, "no compensation below, all from twice it"},
      {"initial_energy", parameter, "initial_energy", torque, 0, "E at the start; 0 cold"},
  };
  const CompensatorNumbers held(seen.friction, seen.doubt);
  for (const CodeLine& line : AllCodeLines(seen, held.numbers())) {
    const std::string unit(line.unit.empty() ? "1" : line.unit);
    const std::string said = SaidOf(line, seen);
    const bool has_interval = said != line.unit;
    all.push_back({line.member, parameter, fmt::format("friction.{}", line.member), unit,
                   line.value, has_interval ? "95 %: " + said : "of wj_friction"});
  }
  return all;
}

const char* CauseName(Cause cause) {
  return cause == Cause::input ? "input" : cause == Cause::output ? "output" : "parameter";
}

/// Attributes that follow from the causality; start: as text.
std::string StartAttributes(Cause cause, const std::string& start) {
  if (cause == Cause::output) return " initial=\"calculated\"";
  return fmt::format(" start=\"{}\"", start);
}

/// Variables and structure of a model description, joint after joint.
struct FmuModel {
  std::string variables, structure;
  std::set<std::string> units;

  void Add(const std::string& name, unsigned reference, Cause cause, const std::string& more,
           const char* type, const char* variability, const std::string& description) {
    variables += fmt::format(
        "    <{} name=\"{}\" valueReference=\"{}\" causality=\"{}\" variability=\"{}\"{} "
        "description=\"{}\"/>\n",
        type, EscapeXml(name), reference, CauseName(cause),
        cause == Cause::parameter ? "fixed" : variability, more, EscapeXml(description));
    if (cause != Cause::output) return;
    structure += fmt::format("    <Output valueReference=\"{}\"/>\n", reference);
  }
};

void Describe(const SeenFriction& seen, const std::string& prefix, unsigned& reference,
              FmuModel& model) {
  for (const FmuVariable& one : NumbersOf(seen)) {
    model.units.insert(one.unit);
    model.Add(prefix + one.name, reference++, one.cause,
              StartAttributes(one.cause, fmt::format("{}", one.start)) +
                  fmt::format(" unit=\"{}\"", one.unit),
              "Float64", "continuous", one.description);
  }
  for (const FmuSwitch& one : kSwitches) {
    model.Add(prefix + one.name, reference++, one.cause, StartAttributes(one.cause, "false"),
              "Boolean", "discrete", one.description);
  }
}

std::string DescriptionOf(const FmuModel& model, const std::string& name,
                          const std::string& token) {
  std::string units, unknowns = model.structure;
  for (const std::string& unit : model.units) {
    units += fmt::format("    <Unit name=\"{}\"/>\n", EscapeXml(unit));
  }
  for (size_t at; (at = unknowns.find("<Output")) != std::string::npos;) {
    unknowns.replace(at, 7, "<InitialUnknown");
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiModelDescription fmiVersion=\"3.0\" modelName=\"{0}\" instantiationToken=\"{1}\" "
      "variableNamingConvention=\"flat\" generationTool=\"warmjoint\" "
      "description=\"Friction of joints that warm up, and its compensation\">\n"
      "  <CoSimulation modelIdentifier=\"{0}\" canHandleVariableCommunicationStepSize=\"true\" "
      "canGetAndSetFMUState=\"true\"/>\n"
      "  <UnitDefinitions>\n{2}  </UnitDefinitions>\n"
      "  <DefaultExperiment startTime=\"0\" stopTime=\"600\" stepSize=\"0.001\"/>\n"
      "  <ModelVariables>\n"
      "    <Float64 name=\"time\" valueReference=\"0\" causality=\"independent\" "
      "variability=\"continuous\"/>\n{3}  </ModelVariables>\n"
      "  <ModelStructure>\n{4}{5}  </ModelStructure>\n</fmiModelDescription>\n",
      name, token, units, model.variables, model.structure, unknowns);
}

/// friction.h: the numbers of each joint, and where warmjoint_fmu.c finds its variables.
std::string FrictionHeader(const std::vector<SeenFriction>& frictions,
                           const std::vector<std::string>& names) {
  std::string text;
  std::vector<std::string> addresses, numbers, switches;
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    text += fmt::format("// {}: law {}{}\n", Printable(frictions[i].joint),
                        frictions[i].friction.law, LeftOutOf(frictions[i].friction));
    text += CFriction(frictions[i], names[i]);
    addresses.push_back("&" + names[i]);
  }
  for (const FmuVariable& one : NumbersOf(frictions.front())) {
    numbers.push_back(fmt::format("&(one)->{}", one.member));
  }
  for (const FmuSwitch& one : kSwitches) switches.push_back(fmt::format("&(one)->{}", one.name));
  return text + fmt::format(
                    "enum {{ WJ_JOINTS = {} }};\n"
                    "static const wj_friction* const wj_frictions[] = {{{}}};\n"
                    "#define WJ_NUMBERS(one) \\\n  {}\n#define WJ_SWITCHES(one) {}\n",
                    frictions.size(), fmt::join(addresses, ", "), fmt::join(numbers, ", \\\n  "),
                    fmt::join(switches, ", "));
}

std::string BuildDescription(const std::string& name) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiBuildDescription fmiVersion=\"3.0\">\n"
      "  <BuildConfiguration modelIdentifier=\"{}\">\n"
      "    <SourceFileSet language=\"C99\">\n"
      "      <SourceFile name=\"warmjoint_fmu.c\"/>\n"
      "      <IncludeDirectory name=\".\"/>\n"
      "    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n",
      name);
}

}  // namespace

FmuFiles FmuFilesOf(const std::vector<SeenFriction>& frictions) {
  std::vector<std::string> names;
  for (const SeenFriction& seen : frictions) {
    const std::string name = CodeName(seen.joint);
    if (std::ranges::find(names, name) != names.end()) {
      Refuse({"joint " + Excerpt(seen.joint)},
             "is {} in C, as another joint is; rename one of them in the file", name);
    }
    names.push_back(name);
  }

  // joint after joint; the token is of all that the library is made of
  const bool is_one = frictions.size() == 1;
  FmuModel model;
  unsigned reference = 1;
  for (const SeenFriction& seen : frictions) {
    Describe(seen, is_one ? "" : Printable(seen.joint) + ".", reference, model);
  }
  const std::string header = FrictionHeader(frictions, names);
  const std::string token = Sha256(header + kFmuSource + kCompensateHeader);
  FmuFiles fmu{is_one ? names.front() : "robot_friction", {}};
  fmu.files = {
      {"modelDescription.xml", DescriptionOf(model, fmu.model, token)},
      {"sources/buildDescription.xml", BuildDescription(fmu.model)},
      {"sources/friction.h", header + fmt::format("#define WJ_TOKEN \"{}\"\n", token)},
      {"sources/warmjoint_fmu.c", std::string(kFmuSource)},
      {"sources/warmjoint/compensate.h", std::string(kCompensateHeader)},
  };
  return fmu;
}

}  // namespace warmjoint
