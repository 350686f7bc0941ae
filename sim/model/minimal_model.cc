#include <fmt/format.h>
#include <warmjoint/attach.h>

#include <algorithm>

#include "models/friction/check_friction.h"
#include "models/friction/law.h"
#include "sim/model/friction_sections.h"

namespace warmjoint::inline sim {

std::string MinimalModel(const Friction& friction, JointKind kind) {
  CheckFriction(friction, {});
  // heavy enough for any slope at this step
  constexpr double kTimestep = 0.001;  // s
  const auto slope = PlaceOf(LawPart::slope, *FindLaw(friction.law));
  const double needed = slope ? 10 * kTimestep * LawValues(friction)[*slope] : 0;
  const double inertia = std::max(1.0, needed);
  const bool slides = kind == JointKind::linear;
  return fmt::format(R"(<mujoco model="friction">
  <!-- load the plugin first: mj_loadPluginLibrary("libwarmjoint_friction.so").
       In another model: the sections <extension> and <actuator>, with that model's joint. -->
  <option timestep="{}" integrator="implicitfast"/>
  <worldbody>
    <body name="link">
      <joint name="joint" type="{}" axis="{}"/>
      <inertial pos="0 0 0" mass="{}" diaginertia="{} {} {}"/>
      <geom type="box" size="0.2 0.05 0.05" mass="0" contype="0" conaffinity="0"/>
    </body>
  </worldbody>
{}</mujoco>
)",
                     kTimestep, slides ? "slide" : "hinge", slides ? "1 0 0" : "0 0 1", inertia,
                     inertia, inertia, inertia, FrictionSections({"joint", friction}));
}

}  // namespace warmjoint::inline sim
