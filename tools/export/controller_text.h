// Frictions for robots' controllers: parameters of ROS 2 and the scales of UR's own compensation.
#pragma once

#include <string>
#include <vector>

#include "tools/export/engine_friction.h"

namespace warmjoint {

/// Parameters of a controller of ros2_control, the map friction.JOINT.NAME of its `joints` with the numbers of wj_friction; 95 %
/// intervals as comments. Throws BadInput for a friction with maps and for a joint whose name has a point.
std::string RosText(const std::vector<SeenFriction>& frictions);

/// Default shares of viscous and Coulomb friction that a UR compensates in direct_torque, of the joints from base to wrist 3.
/// why: ur_msgs/msg/FrictionModelParameters (https://docs.ros.org/en/rolling/p/ur_msgs/msg/FrictionModelParameters.html), and URScript's direct_torque of PolyScope 5.25.1.
inline constexpr std::array<double, 6> kUrViscousShares{0.9, 0.9, 0.8, 0.9, 0.9, 0.9};
inline constexpr std::array<double, 6> kUrCoulombShares{0.8, 0.8, 0.7, 0.8, 0.8, 0.8};

/// The request of ur_msgs/srv/SetFrictionModelParameters, in YAML: the default shares times friction at that warmth over that of the
/// cold joint, viscous and Coulomb each, in the order of UR's joints. What scales do not say stands in comments. Throws BadInput where it
/// is not all of UR's six joints, and for a joint with more friction warm than cold, by name.
std::string UrText(const std::vector<SeenFriction>& frictions, const Warmth& warmth);

}  // namespace warmjoint
