#include "tools/export/engine_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/estimate.h"
#include "identification/robot/robot_estimate.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "models/foundation/xml_tags.h"
#include "models/friction/friction_json.h"
#include "tools/export/controller_code.h"
#include "tools/export/controller_text.h"
#include "tools/export/fmu_text.h"
#include "tools/export/native_text.h"

namespace warmjoint {
namespace {

/// A name as a string of C++ and Python.
std::string InQuotes(const std::string& name) { return nlohmann::json(name).dump(); }

/// A comment that ends with its line, or in XML before its end.
std::string Comment(const std::string& given, EngineFormat format) {
  const std::string words = Printable(given);
  if (format == EngineFormat::physx) return fmt::format("// {}\n", words);
  if (format == EngineFormat::isaaclab || format == EngineFormat::mjlab)
    return fmt::format("# {}\n", words);
  std::string text = words;
  // two hyphens would end the comment
  for (size_t at; (at = text.find("--")) != std::string::npos;) text.replace(at, 2, "- ");
  return fmt::format("<!-- {} -->\n", text);
}

/// What a joint without a name is called in comments and in JSON.
std::string CalledIn(const EngineFriction& one) { return one.joint.empty() ? "joint" : one.joint; }

/// What a text says of a number: 12 digits, so that 5 is not written as 4.999999999999999, or as many as a half width of its interval
/// supports.
std::string Written(double value, std::optional<double> half_width) {
  // why: a digit behind the second of the half width would move the number by a twentieth of it at most
  if (half_width) {
    const double unit = std::pow(10, std::floor(std::log10(*half_width)) - 1);
    value = std::round(value / unit) * unit;
  }
  return fmt::format("{:.12g}", value);
}

std::string Level(const EngineFriction& one) { return Written(one.level, one.half_width); }

std::string StaticLevel(const EngineFriction& one) {
  return Written(one.static_level, one.half_width);
}

/// At the fastest speed its last digit moves the friction by no more than that of the level.
std::string Viscous(const EngineFriction& one) {
  return Written(one.viscous,
                 one.half_width ? std::optional(*one.half_width / one.fastest) : std::nullopt);
}

/// The attribute by which an element names its joint; of one without a name nothing.
std::string NameAttribute(const EngineFriction& one) {
  return one.joint.empty() ? "" : fmt::format(" name=\"{}\"", EscapeXml(one.joint));
}

}  // namespace

std::string EngineHead(const EngineFriction& one, EngineFormat format) {
  const std::string_view speed = kVelocityUnit.For(one.kind), torque = kTorqueUnit.For(one.kind);
  std::string text = Comment(fmt::format("{}: warm {:.3g} (E = {:.4g} {}; 1 has settled at {:.4g} "
                                         "{}), over {:.3g} to {:.3g} {}",
                                         CalledIn(one), one.warm, one.energy, torque, one.speed,
                                         speed, one.slowest, one.fastest, speed),
                             format);
  for (const Omission& left : one.left_out) {
    const std::string size = left.percent ? fmt::format("{:+.3g} %", *left.percent) : "";
    text += Comment(fmt::format("  left out: {} {}{}{}", left.what, size, size.empty() ? "" : ", ",
                                left.meaning),
                    format);
  }
  return text;
}

namespace {

/// One joint where each has an element or a statement of its own.
std::string Body(const EngineFriction& one, EngineFormat format) {
  if (format == EngineFormat::mjcf) {
    return fmt::format("<joint{} damping=\"{}\" frictionloss=\"{}\"/>\n", NameAttribute(one),
                       Viscous(one), Level(one));
  }
  if (format == EngineFormat::urdf) {
    const std::string dynamics =
        fmt::format("<dynamics damping=\"{}\" friction=\"{}\"/>\n", Viscous(one), Level(one));
    if (one.joint.empty()) return dynamics;
    return fmt::format("<joint{}>\n  {}</joint>\n", NameAttribute(one), dynamics);
  }
  const char* axis = one.kind == JointKind::rotary ? "eTWIST" : "eX";
  return fmt::format(
      "joints.at({})->setFrictionParams(PxArticulationAxis::{}, PxJointFrictionParams({}, {}, "
      "{}));\n",
      InQuotes(one.joint), axis, StaticLevel(one), Level(one), Viscous(one));
}

/// A dict of Python: one number of each joint.
std::string Dict(const char* key, const std::vector<EngineFriction>& frictions,
                 std::string (*number)(const EngineFriction&)) {
  std::string text;
  for (const EngineFriction& one : frictions) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", InQuotes(one.joint), number(one));
  }
  return fmt::format("{}={{{}}},\n", key, text);
}

std::string IsaacLabText(const std::vector<EngineFriction>& frictions) {
  return "# of ImplicitActuatorCfg (Isaac Lab 2.3, Isaac Sim 5)\n" +
         Dict("friction", frictions, StaticLevel) + Dict("dynamic_friction", frictions, Level) +
         Dict("viscous_friction", frictions, Viscous);
}

/// mjlab has numbers of a group of joints, not of each: a configuration for each joint.
std::string MjlabText(const std::vector<EngineFriction>& frictions) {
  std::string text = "# keywords of a joint's ActuatorCfg (mjlab 1.6)\n";
  for (const EngineFriction& one : frictions) {
    text += fmt::format("{}: dict(frictionloss={}, viscous_damping={}),\n", InQuotes(one.joint),
                        Level(one), Viscous(one));
  }
  return text;
}

/// The frictions of a file as they were seen. notices: which joints have none.
std::vector<SeenFriction> SeenIn(const Node& file, const ExportRequest& request,
                                 std::vector<std::string>& notices) {
  const std::string& joint = request.joint;
  const auto member = [&](const char* key) { return file.IsMap() ? file.Find(key) : std::nullopt; };
  // an estimate, all of a robot, or a friction by itself
  if (joint.empty() && NeedsName(request.to) && !IsRobotEstimate(file)) {
    Refuse({"--joint"}, "is missing: {} finds friction by the joint's name; give --joint NAME",
           NameOf(request.to));
  }
  if (member("identifier")) return {SeenOf(joint, EstimateFrom(file), file.file())};
  if (!IsRobotEstimate(file)) {
    SeenFriction seen{joint, FrictionFrom(member("friction").value_or(file))};
    RefuseAmperes(seen.friction, {file.file()});
    return {seen};
  }
  const Node joints = *file.Find("joints");
  std::vector<SeenFriction> all;
  for (const std::string& name : joints.Keys()) {
    const Estimate estimate = EstimateFrom(*joints.Find(name));
    const bool in_amperes = estimate.friction && !estimate.friction->torque_unit.empty();
    if (estimate.friction && !in_amperes) {
      all.push_back(SeenOf(name, estimate, file.file()));
    } else {
      notices.push_back(
          fmt::format("{} is left out: {}", name,
                      in_amperes ? "its friction is known in A alone" : "it has no friction"));
    }
  }
  if (all.empty()) Refuse({file.file()}, "holds no friction in N.m or N of any joint");
  return all;
}

}  // namespace

Exported ExportFrictions(const Node& file, const ExportRequest& request) {
  if (request.native && request.to != EngineFormat::mjcf) {
    Refuse({"--native"}, "is for --to mjcf, not for {}: springs with a yield are MuJoCo's",
           NameOf(request.to));
  }
  const Warmth& warmth = request.warmth;
  if (HasHeat(request.to) && (warmth.share != 0 || warmth.speed)) {
    Refuse({warmth.speed ? "--speed" : "--warm"},
           "is for engines without heat, and {} has heat as a state of the joint; leave it out",
           NameOf(request.to));
  }
  Exported exported{.request = request, .frictions = {}, .notices = {}, .whole = {}};
  exported.whole = SeenIn(file, request, exported.notices);
  if (HasHeat(request.to)) return exported;
  for (const SeenFriction& seen : exported.whole) {
    exported.frictions.push_back(InEngine(seen, request.warmth, request.to));
    // a spring with a yield holds
    if (!request.native) continue;
    std::erase_if(exported.frictions.back().left_out,
                  [](const Omission& left) { return left.what == "creep"; });
  }
  return exported;
}

std::string EngineText(const std::vector<EngineFriction>& frictions, EngineFormat format) {
  std::string text;
  for (const EngineFriction& one : frictions) text += EngineHead(one, format);
  if (format == EngineFormat::isaaclab) return text + IsaacLabText(frictions);
  if (format == EngineFormat::mjlab) return text + MjlabText(frictions);
  for (const EngineFriction& one : frictions) text += Body(one, format);
  return text;
}

std::string ExportText(const Exported& exported) {
  const ExportRequest& request = exported.request;
  switch (request.to) {
    case EngineFormat::ros2:
      return RosText(exported.whole);
    case EngineFormat::ur:
      return UrText(exported.whole, request.warmth);
    case EngineFormat::fmu:
      return FmuFilesOf(exported.whole).files.at("modelDescription.xml");
    default:
      if (HasHeat(request.to)) return CodeText(exported.whole, request.to);
      return request.native ? NativeText(exported.frictions, request.timestep)
                            : EngineText(exported.frictions, request.to);
  }
}

Tree EngineJson(const Exported& exported) {
  Tree joints = Tree::object();
  for (const EngineFriction& one : exported.frictions) joints[CalledIn(one)] = WriteFields(one);
  Tree tree = {{"to", NameOf(exported.request.to)},
               {"joints", joints},
               {"notices", exported.notices},
               {"text", ExportText(exported)}};
  if (exported.request.to == EngineFormat::fmu) {
    const FmuFiles fmu = FmuFilesOf(exported.whole);
    tree["model"] = fmu.model;
    tree["files"] = fmu.files;
  }
  return tree;
}

}  // namespace warmjoint
