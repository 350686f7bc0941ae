// How joints stick: ours in both forms beside frictionloss, with noslip iterations too, and the LuGre of
// dcmotor, as two tables.
//
// A link of 0.25 kg.m^2 with 1 kg 0.5 m from a horizontal axis asks 4.9 N.m of a joint whose
// friction is 6 N.m. Creep and the fastest speed are measured over a minute after two seconds of
// settling; break-away, without gravity, by a load that rises from 3 N.m by 0.1 N.m/s, as the load
// at which the joint exceeds 0.05 rad/s; drift by 3 N.m and 2.5 N.m of 20 Hz about it, over half a
// minute; chatter by 12 N.m at 1 Hz, as the changes of direction beyond 1 mrad/s at each reversal.
// Stick-slip: the link driven for ten seconds, with and without a weight that hangs from it.
// Robots: every joint with a level of 1.5 times its gravity load plus 2 N.m, the worst joint over
// ten seconds after ten of settling, over three steps and three integrators.
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/register.h"
#include "tests/sim/plugin/friction_robots.h"

namespace warmjoint {
namespace {

constexpr double kSteps[] = {0.0005, 0.001, 0.002};  // s
constexpr mjtIntegrator kIntegrators[] = {mjINT_EULER, mjINT_IMPLICITFAST, mjINT_DISCRETE};

const char* NameOf(mjtIntegrator integrator) {
  if (integrator == mjINT_EULER) return "Euler";
  return integrator == mjINT_DISCRETE ? "discrete" : "implicitfast";
}

/// A joint that gets friction.
struct Holding {
  std::string joint;
  double level;    // N.m
  double inertia;  // effective, kg.m^2
};

/// A friction and how the joints of a model get it.
struct Kind {
  const char* name;
  void (*add)(mjSpec& spec, const std::vector<Holding>& joints);
  int noslip = 0;  // iterations
};

template <FrictionForm form>
void AddOurs(mjSpec& spec, const std::vector<Holding>& joints) {
  std::vector<FrictionForJoint> frictions;
  for (const Holding& joint : joints) {
    Friction friction;
    friction.law = "coulomb";
    friction.parameters = {{"coulomb", joint.level}};
    frictions.push_back({joint.joint, friction});
  }
  AddFriction(spec, frictions, {"sticking_table"}, {.form = form});
}

void AddFrictionLoss(mjSpec& spec, const std::vector<Holding>& joints) {
  for (const Holding& joint : joints) {
    FindJoint(spec, joint.joint, {"sticking_table"})->frictionloss = joint.level;
  }
}

/// Bristles that give way by 0.6 mrad at the level, with a damping ratio of 0.6.
void AddLugre(mjSpec& spec, const std::vector<Holding>& joints) {
  for (const auto& [joint, level, inertia] : joints) {
    mjsActuator* motor = mjs_addActuator(&spec, nullptr);
    mjs_setString(motor->target, joint.c_str());
    motor->trntype = mjTRN_JOINT;
    const double stiffness = level / 0.0006, damping = 1.2 * std::sqrt(stiffness * inertia);
    double constants[2] = {0, 0}, lugre[5] = {stiffness, damping, level, level, 0.01};
    const std::string refusal = mjs_setToDCMotor(motor, constants, 1, nullptr, nullptr, nullptr,
                                                 nullptr, nullptr, nullptr, lugre, mjINPUT_NONE);
    if (!refusal.empty()) Refuse({"sticking_table"}, "{}", refusal);
  }
}

constexpr Kind kKinds[] = {{"ours, actuator", AddOurs<FrictionForm::actuator>},
                           {"ours, passive", AddOurs<FrictionForm::passive>},
                           {"frictionloss", AddFrictionLoss},
                           {"frictionloss, noslip 3", AddFrictionLoss, 3},
                           {"frictionloss, noslip 20", AddFrictionLoss, 20},
                           {"dcmotor LuGre", AddLugre}};

class Link {
 public:
  Link(const Kind& kind, double step, mjtIntegrator integrator, double gravity) {
    constexpr char xml[] = R"(
<mujoco>
  <option><flag contact="disable"/></option>
  <worldbody>
    <body>
      <joint name="hinge" axis="0 1 0"/>
      <inertial pos="0.5 0 0" mass="1" diaginertia="1e-9 1e-9 1e-9"/>
    </body>
  </worldbody>
</mujoco>)";
    char error[1000] = "";
    const SpecPtr spec(mj_parseXMLString(xml, nullptr, error, sizeof(error)));
    if (!spec) Refuse({kind.name}, "{}", error);
    spec->option.timestep = step;
    spec->option.integrator = integrator;
    spec->option.gravity[2] = -gravity;
    spec->option.noslip_iterations = kind.noslip;
    kind.add(*spec, {{"hinge", 6, 0.25}});
    model_ = CompileModel(*spec, {kind.name});
    data_.reset(mj_makeData(model_.get()));
  }

  mjData& data() { return *data_; }
  void Step() { mj_step(model_.get(), data_.get()); }

 private:
  ModelPtr model_;
  DataPtr data_;
};

struct Creeping {
  double creep = 0;    // rad/min
  double fastest = 0;  // rad/s
};

Creeping Creep(Link link) {
  while (link.data().time < 2) link.Step();
  const double settled = link.data().qpos[0];
  Creeping result;
  while (link.data().time < 62) {
    link.Step();
    result.fastest = std::max(result.fastest, std::abs(link.data().qvel[0]));
  }
  result.creep = std::abs(link.data().qpos[0] - settled);
  return result;
}

/// Load at break-away, N.m.
double BreakAway(Link link) {
  mjData& d = link.data();
  while (std::abs(d.qvel[0]) < 0.05 && d.time < 60) {
    d.qfrc_applied[0] = 3 + 0.1 * d.time;
    link.Step();
  }
  return d.qfrc_applied[0];
}

/// Drift under a swinging load, rad/min.
double Drift(Link link, double step) {
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

/// Changes of direction for each reversal of the drive: 1 without chatter.
double Chatter(Link link) {
  mjData& d = link.data();
  int changes = 0, direction = 1;
  while (d.time < 10.5) {
    d.qfrc_applied[0] = 12 * std::sin(2 * std::numbers::pi * d.time);
    link.Step();
    if (std::abs(d.qvel[0]) < 1e-3 || (d.qvel[0] > 0) == (direction > 0)) continue;
    direction = -direction;
    ++changes;
  }
  return changes / 20.0;
}

void PrintLink() {
  fmt::print("{:<23} {:>5} {:<13} {:>13} {:>12} {:>11} {:>13} {:>8}\n", "friction", "step",
             "integrator", "creep rad/min", "speed rad/s", "break-away", "drift rad/min",
             "chatter");
  for (const Kind& kind : kKinds) {
    for (const double step : kSteps) {
      for (const mjtIntegrator integrator : kIntegrators) {
        const auto link = [&](double gravity) { return Link(kind, step, integrator, gravity); };
        const Creeping rest = Creep(link(9.81));
        fmt::print("{:<23} {:5.1f} {:<13} {:13.2e} {:12.2e} {:11.3f} {:13.2e} {:8.2f}\n", kind.name,
                   1e3 * step, NameOf(integrator), rest.creep, rest.fastest, BreakAway(link(0)),
                   Drift(link(0), step), Chatter(link(0)));
      }
    }
  }
}

/// The robot at its pose with one kind of friction on every joint.
ModelPtr WithFriction(const test::Robot& robot, const Kind& kind, double step,
                      mjtIntegrator integrator) {
  const ModelPtr bare = CompileModel(*robot.spec, {robot.path});
  const SpecPtr spec(mj_copySpec(robot.spec.get()));
  spec->option.timestep = step;
  spec->option.integrator = integrator;
  spec->option.noslip_iterations = kind.noslip;
  std::vector<Holding> joints;
  for (int i = 0; i < bare->njnt; ++i) {
    joints.push_back({mj_id2name(bare.get(), mjOBJ_JOINT, i), robot.level[static_cast<size_t>(i)],
                      1 / bare->dof_invweight0[bare->jnt_dofadr[i]]});
  }
  kind.add(*spec, joints);
  return CompileModel(*spec, {robot.path});
}

/// The worst joint; nothing where the robot went unstable, which resets its time.
std::optional<Creeping> Creep(const mjModel* m, const std::vector<double>& pose) {
  const DataPtr d(mj_makeData(m));
  std::copy(pose.begin(), pose.end(), d->qpos);
  const long steps = std::lround(10 / m->opt.timestep);
  for (long i = 0; i < steps; ++i) mj_step(m, d.get());
  const std::vector<double> settled(d->qpos, d->qpos + m->nq);
  Creeping worst;
  for (long i = 0; i < steps; ++i) {
    mj_step(m, d.get());
    for (int k = 0; k < m->nv; ++k) worst.fastest = std::max(worst.fastest, std::abs(d->qvel[k]));
  }
  for (const mjtWarning warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (d->warning[warning].number > 0) return std::nullopt;
  }
  if (d->time < 19) return std::nullopt;
  for (int i = 0; i < m->nq; ++i) {
    worst.creep = std::max(worst.creep, 6 * std::abs(d->qpos[i] - settled[static_cast<size_t>(i)]));
  }
  return worst;
}

void PrintRobots() {
  fmt::print("\n{:<24} {:<23} {:>13} {:>12} {:>9}\n", "robot", "friction", "creep rad/min",
             "speed rad/s", "unstable");
  mju_user_warning = [](const char*) {};
  for (const test::RobotCase& known : test::kRobots) {
    const test::Robot robot = test::LoadRobot(known.file, known.armature);
    for (const Kind& kind : kKinds) {
      Creeping worst;
      int unstable = 0;
      for (const double step : kSteps) {
        for (const mjtIntegrator integrator : kIntegrators) {
          const ModelPtr m = WithFriction(robot, kind, step, integrator);
          const std::optional<Creeping> creeping = Creep(m.get(), robot.pose);
          if (!creeping) ++unstable;
          worst.creep = std::max(worst.creep, creeping.value_or(Creeping{}).creep);
          worst.fastest = std::max(worst.fastest, creeping.value_or(Creeping{}).fastest);
        }
      }
      fmt::print("{:<24} {:<23} {:13.2e} {:12.2e} {:>4} of 9\n", known.name(), kind.name,
                 worst.creep, worst.fastest, unstable);
    }
  }
}

/// A drive of the link, N.m and Hz, with the weight's torque when it has turned by a quarter, N.m.
struct Drive {
  double torque, frequency, weight;
  double At(double time) const {
    return torque * std::sin(2 * std::numbers::pi * frequency * time);
  }
};
constexpr double kDriven = 10;  // s

/// Where the link ends, rad, by set-valued friction (Moreau's stepping).
double EndByMoreau(const Drive& drive, double step) {
  double position = 0, speed = 0;
  const long steps = std::lround(kDriven / step);
  for (long i = 0; i < steps; ++i) {
    const double load = drive.At(static_cast<double>(i) * step) - drive.weight * std::sin(position);
    const double free = speed + step * load / 0.25, most = step * 6 / 0.25;
    speed = free - std::clamp(free, -most, most);
    position += step * speed;
  }
  return position;
}

double EndByEngine(const Drive& drive, const Kind& kind, double step) {
  Link link(kind, step, mjINT_IMPLICITFAST, 0);
  mjData& d = link.data();
  const long steps = std::lround(kDriven / step);
  for (long i = 0; i < steps; ++i) {
    const double time = static_cast<double>(i) * step;
    d.qfrc_applied[0] = drive.At(time) - drive.weight * std::sin(d.qpos[0]);
    link.Step();
  }
  return d.qpos[0];
}

/// The error of where the link ends after ten seconds, against Moreau's stepping by 20 us.
void PrintStickSlip() {
  fmt::print("\n{:<32} {:>5} {:>10} {:>10} {:>13}\n", "drive", "step", "Moreau", "ours",
             "frictionloss");
  for (const Drive& drive : {Drive{8, 0.5, 0}, Drive{10, 0.3, 0}, Drive{8, 0.5, 4.905},
                             Drive{10, 0.3, 4.905}, Drive{6, 1, 4.905}}) {
    const double truth = EndByMoreau(drive, 2e-5);
    for (const double step : {0.0005, 0.001, 0.002, 0.005}) {
      fmt::print(
          "{:<32} {:5.1f} {:10.1e} {:10.1e} {:13.1e}\n",
          fmt::format("{} N.m {} Hz, weight {} N.m", drive.torque, drive.frequency, drive.weight),
          1e3 * step, EndByMoreau(drive, step) - truth, EndByEngine(drive, kKinds[1], step) - truth,
          EndByEngine(drive, kKinds[2], step) - truth);
    }
  }
}

void Print() {
  RegisterFrictionPlugin();
  PrintLink();
  PrintStickSlip();
  if (std::filesystem::exists(test::SharedFolder() / "robots")) {
    PrintRobots();
  } else {
    fmt::print("\nno robots: {} is absent; set WARMJOINT_SHARED\n",
               (test::SharedFolder() / "robots").string());
  }
}

}  // namespace
}  // namespace warmjoint

int main() {
  warmjoint::Print();
  return 0;
}
