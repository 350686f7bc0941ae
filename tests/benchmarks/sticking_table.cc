// How joints stick: ours beside frictionloss and the LuGre of dcmotor, as a table.
//
// A link of 0.25 kg.m^2 with 1 kg 0.5 m from a horizontal axis asks 4.9 N.m of a joint whose
// friction is 6 N.m. Creep is measured over a minute after two seconds of settling; break-away by a
// load that rises by 2 N.m/s without gravity, as the load at which the joint has moved by 0.02 rad;
// drift by 3 N.m and 2.5 N.m of 20 Hz about it, over half a minute.
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "models/foundation/bad_input.h"
#include "sim/mujoco_handles.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

struct Kind {
  const char* name;
  const char* joint;     // attributes of the joint
  const char* actuator;  // the <actuator> section
};

constexpr Kind kKinds[] = {
    {"ours", "",
     R"(<plugin joint="hinge" plugin="warmjoint.friction" actdim="2">
          <config key="law" value="coulomb"/><config key="coulomb" value="6"/></plugin>)"},
    {"frictionloss", R"(frictionloss="6")", ""},
    {"dcmotor LuGre", "",
     R"(<dcmotor joint="hinge" input="none" motorconst="0 0" resistance="1"
                 lugre="10000 60 6 6 0.01"/>)"},
};

class Link {
 public:
  Link(const Kind& kind, double step, const char* integrator, double gravity) {
    const std::string xml = fmt::format(R"(
<mujoco>
  <extension><plugin plugin="warmjoint.friction"/></extension>
  <option timestep="{}" integrator="{}" gravity="0 0 {}"><flag contact="disable"/></option>
  <worldbody>
    <body>
      <joint name="hinge" axis="0 1 0" {}/>
      <inertial pos="0.5 0 0" mass="1" diaginertia="1e-9 1e-9 1e-9"/>
    </body>
  </worldbody>
  <actuator>{}</actuator>
</mujoco>)",
                                        step, integrator, -gravity, kind.joint, kind.actuator);
    char error[1000] = "";
    const SpecPtr spec(mj_parseXMLString(xml.c_str(), nullptr, error, sizeof(error)));
    if (!spec) Refuse({kind.name}, "{}", error);
    model_.reset(mj_compile(spec.get(), nullptr));
    if (!model_) Refuse({kind.name}, "{}", mjs_getError(spec.get()));
    data_.reset(mj_makeData(model_.get()));
  }

  mjData& data() { return *data_; }
  void Step() { mj_step(model_.get(), data_.get()); }

 private:
  ModelPtr model_;
  DataPtr data_;
};

/// Creep in rad/min and the fastest speed in rad/s, under gravity.
std::pair<double, double> Creep(const Kind& kind, double step, const char* integrator) {
  Link link(kind, step, integrator, 9.81);
  while (link.data().time < 2) link.Step();
  const double settled = link.data().qpos[0];
  double fastest = 0;
  while (link.data().time < 62) {
    link.Step();
    fastest = std::max(fastest, std::abs(link.data().qvel[0]));
  }
  return {std::abs(link.data().qpos[0] - settled), fastest};
}

/// Load at break-away, N.m.
double BreakAway(const Kind& kind, double step, const char* integrator) {
  Link link(kind, step, integrator, 0);
  mjData& d = link.data();
  while (std::abs(d.qpos[0]) < 0.02 && d.time < 10) {
    d.qfrc_applied[0] = 2 * d.time;
    link.Step();
  }
  return d.qfrc_applied[0];
}

/// Drift under a swinging load, rad/min.
double Drift(const Kind& kind, double step, const char* integrator) {
  Link link(kind, step, integrator, 0);
  mjData& d = link.data();
  const auto shake = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / step); ++i) {
      d.qfrc_applied[0] = 3 + 2.5 * std::sin(2 * std::numbers::pi * 20 * d.time);
      link.Step();
    }
  };
  shake(1);
  const double settled = d.qpos[0];
  shake(30);
  return 2 * std::abs(d.qpos[0] - settled);
}

void Print() {
  RegisterFrictionPlugin();
  fmt::print("{:<14} {:>5} {:<13} {:>13} {:>12} {:>11} {:>13}\n", "friction", "step", "integrator",
             "creep rad/min", "speed rad/s", "break-away", "drift rad/min");
  for (const Kind& kind : kKinds) {
    for (const double step : {0.0005, 0.001, 0.002}) {
      for (const char* integrator : {"Euler", "implicitfast", "discrete"}) {
        const auto [creep, fastest] = Creep(kind, step, integrator);
        fmt::print("{:<14} {:5.1f} {:<13} {:13.2e} {:12.2e} {:11.3f} {:13.2e}\n", kind.name,
                   1e3 * step, integrator, creep, fastest, BreakAway(kind, step, integrator),
                   Drift(kind, step, integrator));
      }
    }
  }
}

}  // namespace
}  // namespace warmjoint

int main() {
  warmjoint::Print();
  return 0;
}
