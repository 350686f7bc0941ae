#include "tools/robot/robot_friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "models/foundation/bad_input.h"
#include "models/foundation/description_text.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/xml_tags.h"
#include "models/friction/parameter_rows.h"
#include "sim/model/load_model.h"
#include "sim/robot/urdf_spec.h"
#include "tools/identify/carried_heat.h"

namespace warmjoint {
namespace {

/// A friction in amperes as one in N.m or N. constant: N.m/A or N/A
Friction InTorque(Friction friction, double constant) {
  for (auto& [name, value] : friction.parameters) {
    if (name == kStribeckVelocityRow.name || name == kStribeckExponentRow.name) continue;
    value *= constant;
  }
  friction.torque_unit.clear();
  return friction;
}

/// The heat at the start: of the estimate's own end where that is asked for.
std::vector<double> EnergiesOf(const Estimate& estimate, const Friction& friction,
                               const std::string& initial, const std::filesystem::path& file) {
  if (initial != "end") return InitialEnergies(initial, friction, file);
  for (const EstimatedParameter& one : estimate.state_end) {
    if (one.name == "energy") return {one.value};
  }
  return {};
}

/// The model for `out`: of the description as MuJoCo reads it, else of a URDF as the fit has mended it.
AttachedText ModelWith(const std::vector<FrictionForJoint>& frictions,
                       const std::filesystem::path& robot, const std::filesystem::path& out,
                       const AttachOptions& options) {
  std::string why;
  try {
    return AttachFrictionAsText(robot, frictions, out, options);
  } catch (const BadInput& refused) {
    if (!IsUrdf(ReadDescription(robot).text)) throw;
    why = refused.what();
  }
  std::vector<std::string> mended;  // the fit has said it
  const SpecPtr spec = SpecOfUrdf(robot, mended);
  AttachedText made{AttachFriction(*spec, frictions, options, robot.string()), {}};
  made.xml = ModelToXml(*spec, {robot.string()});
  made.attached.notices.push_back(fmt::format(
      "{} has the description as the fit mended it, without shapes, since MuJoCo refuses it ({})",
      out.string(), why));
  return made;
}

}  // namespace

std::vector<FrictionForJoint> FrictionsOfRobot(const std::filesystem::path& file,
                                               const NumberOfJoints& constants,
                                               const std::string& initial,
                                               std::vector<std::string>& warnings) {
  const RobotEstimate robot = ReadRobotEstimate(file);
  std::vector<FrictionForJoint> frictions;
  for (const auto& [joint, constant] : constants) {
    if (joint.empty() || robot.Find(joint)) continue;
    std::vector<std::string> names;
    for (const RobotJointEstimate& one : robot.joints) names.push_back(one.summary.joint);
    Refuse({"--torque-constant"}, "{} holds no joint '{}'{}", file.string(), Excerpt(joint),
           Suggestion(joint, names));
  }
  for (const RobotJointEstimate& known : robot.joints) {
    const Estimate& estimate = known.estimate;
    const std::string& joint = known.summary.joint;
    if (!estimate.friction) {
      warnings.push_back(fmt::format("{} has no friction ({}): {}", joint, NameOf(estimate.status),
                                     estimate.message));
      continue;
    }
    Friction friction = *estimate.friction;
    if (const double constant = NumberOf(constants, joint, 0); friction.torque_unit == "A") {
      if (constant == 0) {
        Refuse({file.string()},
               "the friction of {} is in A, since the log does not tell its gain; give "
               "--torque-constant {}=N.m/A",
               joint, joint);
      }
      friction = InTorque(std::move(friction), constant);
    }
    FrictionForJoint one{joint, friction, {}};
    one.initial_energy = EnergiesOf(estimate, one.friction, initial, file);
    frictions.push_back(std::move(one));
  }
  if (frictions.empty()) Refuse({file.string()}, "holds no friction of any joint");
  return frictions;
}

AttachedText WarmModel(const std::filesystem::path& robot, const RobotEstimate& estimate,
                       const std::filesystem::path& out) {
  std::vector<FrictionForJoint> frictions;
  AttachOptions options;
  std::vector<std::string> said;
  for (const RobotJointEstimate& one : estimate.joints) {
    const RobotJointSummary& summary = one.summary;
    if (!one.HasFriction()) {
      const bool in_amperes = one.estimate.friction.has_value();
      said.push_back(
          fmt::format("{} is left out of {}: {}", summary.joint, out.string(),
                      in_amperes ? "its friction is known in A alone" : "it has no friction"));
      continue;
    }
    frictions.push_back({summary.joint, *one.estimate.friction, {}});
    const EstimatedParameter* const rotor = one.estimate.Find("rotor_inertia");
    const bool in_amperes = summary.torque_unit == "A";
    const double gain = in_amperes ? std::abs(summary.gain.value_or(1)) : 1;
    if (rotor && rotor->value > 0)
      options.armatures.push_back({summary.joint, rotor->value / gain});
  }
  if (estimate.gravity) {
    options.gravity.emplace();
    std::ranges::copy(estimate.gravity->value, options.gravity->begin());
  }
  if (frictions.empty()) Refuse({"--mjcf"}, "no joint has a friction that MuJoCo can use");
  AttachedText made = ModelWith(frictions, robot, out, options);
  std::vector<std::string>& notices = made.attached.notices;
  notices.insert(notices.begin(), said.begin(), said.end());
  return made;
}

}  // namespace warmjoint
