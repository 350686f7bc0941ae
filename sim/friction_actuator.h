// Friction written as MJCF.
#pragma once

#include <string>

#include "models/friction/friction_description.h"

namespace warmjoint {

/// The <actuator> section that puts friction on a joint through the plugin, attributes inline.
/// name: of the actuator. The model must declare the plugin: FrictionExtension().
std::string FrictionActuator(const std::string& name, const std::string& joint,
                             const FrictionDescription& friction);

/// The <extension> section that declares the plugin.
std::string FrictionExtension();

/// The model text with sections added before its end. MJCF allows a section more than once.
/// Throws BadInput, naming `path`, where the text does not end in </mujoco>.
std::string WithSections(const std::string& model, const std::string& sections,
                         const std::string& path);

}  // namespace warmjoint
