#include "tools/export/native_text.h"

#include <fmt/format.h>

#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/xml_tags.h"
#include "models/friction/joint_spring.h"
#include "tools/export/engine_text.h"

namespace warmjoint {
namespace {

/// The coupling of a joint of which only the inertia is known. Why: over the poses of arms with six and seven axes (sim/plugin/stability.h).
constexpr double kCouplingOfArms = 3.3;

std::string Element(const EngineFriction& one, double timestep) {
  const Place place{one.joint.empty() ? "--native" : one.joint};
  if (!one.inertia) {
    Refuse(place,
           "the friction's file knows no inertia of the joint, from which a spring's stiffness "
           "follows; take it "
           "from the robot: warmjoint attach ROBOT --joint NAME=FILE --as native -o OUT.xml");
  }
  const double least = LeastViscous(one.level, one.kind);
  if (one.viscous < least) {
    Refuse(place,
           "its viscous is {:.4g} {}, and a held spring comes to rest beside a level of {:.4g} "
           "with {:.4g} or more; "
           "warmjoint attach ROBOT --joint NAME=FILE --as native --approximate raises it",
           one.viscous, kViscousUnit.For(one.kind), one.level, least);
  }
  const double stiffness = SpringStiffness(*one.inertia, kCouplingOfArms, timestep);
  const double give = one.level / stiffness, most = LargestGive(one.kind);
  if (give > most) {
    Refuse(place,
           "a spring would give way by {:.3g} {} at a timestep of {} s, at most {} are allowed; "
           "take --timestep {:.2g}",
           give, kPositionUnit.For(one.kind), timestep, most,
           0.99 * timestep * std::sqrt(most / give));
  }
  const std::string name =
      one.joint.empty() ? "" : fmt::format(" name=\"{}\"", EscapeXml(one.joint));
  return fmt::format("<joint{} stiffness=\"{:.6g}\" springyield=\"{:.6g}\" damping=\"{:.6g}\"/>\n",
                     name, stiffness, give, one.viscous);
}

}  // namespace

std::string NativeText(const std::vector<EngineFriction>& frictions, double timestep) {
  std::string text = fmt::format(
      "<!-- MuJoCo 4.0, angle=\"radian\", <option timestep=\"{}\" integrator=\"implicitfast\"/>; "
      "begin with plastic = qpos of these joints -->\n",
      timestep);
  for (const EngineFriction& one : frictions) text += EngineHead(one, EngineFormat::mjcf);
  for (const EngineFriction& one : frictions) text += Element(one, timestep);
  return text;
}

}  // namespace warmjoint
