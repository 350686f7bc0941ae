// Friction as MJCF text: the sections that a model needs.
#pragma once

#include <warmjoint/attach.h>
#include <warmjoint/friction.h>

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// The sections <extension> and <actuator> that put friction onto a joint through the plugin,
/// attributes inline, as MJCF text. The actuator is named "JOINT_friction".
std::string FrictionSections(const FrictionForJoint& friction);

/// The section <extension> with one instance of that name which holds the friction of all the
/// joints, and its own name, from which the plugin finds what an attachment put before the names.
/// Of the options, sensors count.
std::string InstanceSection(const std::string& instance,
                            const std::vector<FrictionForJoint>& frictions,
                            const AttachOptions& options);

/// Name of the actuator that carries the friction of a joint.
std::string FrictionActuatorOf(const std::string& joint);

/// A small model that runs, with the friction on its only joint, "joint": what an identified
/// friction looks like in MuJoCo, to try out or to copy from.
std::string MinimalModel(const Friction& friction, JointKind kind);

/// The text with &, <, > and " written as entities.
std::string EscapeXml(std::string_view text);

}  // namespace warmjoint
