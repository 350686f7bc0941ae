#include "tests/public_models/robot_trial.h"

#include <unistd.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "models/friction/thermal.h"
#include "sim/model/load_model.h"
#include "sim/plugin/friction_instance.h"

namespace warmjoint::test {
namespace {

namespace fs = std::filesystem;

constexpr Thermal kThermal{-0.3, 20};  // N.m/W, s
constexpr double kSecond = 1;          // s, of heat and of rest

/// How far a held joint may give way, as the plugin's check has it.
constexpr double kGive = 0.05;         // rad
constexpr double kLinearGive = 0.005;  // m

bool CarriesFriction(const mjModel* m, int joint) {
  const int type = m->jnt_type[joint];
  return (type == mjJNT_HINGE || type == mjJNT_SLIDE) && mj_id2name(m, mjOBJ_JOINT, joint);
}

/// 1.5 times the load that gravity puts on each joint at the first keyframe, and a part of the
/// largest, bounded where the joint is light: 250 1/s^2 times its inertia.
std::vector<FrictionForJoint> Frictions(const mjModel* m) {
  const DataPtr data(mj_makeData(m));
  if (m->nkey > 0) mj_resetDataKeyframe(m, data.get(), 0);
  std::fill_n(data->qvel, m->nv, 0.0);
  mj_forward(m, data.get());
  double largest = 0;
  for (int j = 0; j < m->njnt; ++j) {
    if (!CarriesFriction(m, j)) continue;
    largest = std::max(largest, std::abs(data->qfrc_bias[m->jnt_dofadr[j]]));
  }
  std::vector<FrictionForJoint> frictions;
  for (int j = 0; j < m->njnt; ++j) {
    if (!CarriesFriction(m, j)) continue;
    const int dof = m->jnt_dofadr[j];
    const double share = std::min(0.15 * largest + 0.01, 250 / m->dof_invweight0[dof]);
    const double level = 1.5 * std::abs(data->qfrc_bias[dof]) + share;
    Friction friction;
    friction.law = "asymmetric";
    friction.parameters = {
        {"viscous", 0}, {"coulomb_positive", level}, {"coulomb_negative", 1.1 * level}};
    friction.thermal = kThermal;
    frictions.push_back({mj_id2name(m, mjOBJ_JOINT, j), friction});
  }
  return frictions;
}

/// Takes the armatures that a refusal offers; how many.
int Follow(const std::string& refusal, AttachOptions& options) {
  const std::regex offer("--armature (\\S+)=([-+.e0-9]+)");
  for (std::sregex_iterator i(refusal.begin(), refusal.end(), offer), end; i != end; ++i) {
    options.armatures.push_back({(*i)[1], std::stod((*i)[2])});
  }
  return static_cast<int>(options.armatures.size());
}

/// Attaches; a refusal that offers armatures is followed once.
void AttachWithRemedy(const fs::path& model, const std::vector<FrictionForJoint>& frictions,
                      const fs::path& out, AttachOptions& options, std::string& remedy) {
  try {
    AttachFriction(model, frictions, out, options);
  } catch (const BadInput& refusal) {
    const int armatures = Follow(refusal.what(), options);
    if (armatures == 0) throw;
    remedy = fmt::format("armature on {}", armatures);
    AttachFriction(model, frictions, out, options);
  }
}

/// One joint's numbers in the data of the result.
struct Address {
  int dof;
  int energy;                 // in act or in plugin_state
  double positive, negative;  // levels, N.m or N
  double give;                // rad or m
};

std::vector<Address> Addresses(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                               FrictionForm form) {
  std::vector<Address> addresses;
  const auto passive = m->nplugin - 1;  // attach adds it last
  int states = form == FrictionForm::passive ? m->plugin_stateadr[passive] + kFrictionReports : 0;
  for (const FrictionForJoint& friction : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
    int energy = states + 1;
    if (form == FrictionForm::actuator) {
      const int actuator =
          mj_name2id(m, mjOBJ_ACTUATOR, FrictionActuatorOf(friction.joint).c_str());
      energy = m->actuator_actadr[actuator] + 1;
    }
    states += 2;
    const auto& levels = friction.friction.parameters;
    addresses.push_back({m->jnt_dofadr[joint], energy, levels.at("coulomb_positive"),
                         levels.at("coulomb_negative"),
                         m->jnt_type[joint] == mjJNT_SLIDE ? kLinearGive : kGive});
  }
  return addresses;
}

/// The model with nothing but inertia, friction and, where asked, gravity.
void Bare(mjModel* m, bool gravity) {
  m->opt.disableflags = mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_SENSOR | mjDSBL_AUTORESET;
  if (!gravity) m->opt.disableflags |= mjDSBL_GRAVITY;
  std::fill_n(m->jnt_stiffness, m->njnt, 0.0);
  std::fill_n(m->tendon_stiffness, m->ntendon, 0.0);
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] >= 0) continue;
    std::fill_n(m->actuator_gainprm + i * mjNGAIN, mjNGAIN, 0.0);
    std::fill_n(m->actuator_biasprm + i * mjNBIAS, mjNBIAS, 0.0);
  }
}

/// Drives every joint at a speed of its own and compares E, from a tenth of a second on, by which
/// the bristles have yielded, with the recursion of Eq. (22) under W = (level + E) |v|.
double HeatError(mjModel* m, const std::vector<Address>& joints, FrictionForm form) {
  Bare(m, false);
  // so heavy that friction does not slow the joints between the stages of RK4; MuJoCo takes the
  // inertia of uncoupled ones from dof_M0
  std::fill_n(m->dof_armature, m->nv, 1e12);
  std::fill_n(m->dof_M0, m->nv, 1e12);
  const DataPtr data(mj_makeData(m));
  const mjtNum* states = form == FrictionForm::passive ? data->plugin_state : data->act;
  const DiscreteThermal heat = Discretise(kThermal, m->opt.timestep);
  std::vector<double> expected(joints.size());
  bool compares = false;
  while (data->time < kSecond) {
    std::fill_n(data->qvel, m->nv, 0.0);
    for (size_t k = 0; k < joints.size(); ++k) {
      const double speed = 0.5 + 0.5 * static_cast<double>(k % 7) / 7;
      data->qvel[joints[k].dof] = k % 2 == 0 ? speed : -speed;
    }
    if (!compares && data->time > 0.1) {
      for (size_t k = 0; k < joints.size(); ++k) expected[k] = states[joints[k].energy];
      compares = true;
    }
    for (size_t k = 0; k < joints.size() && compares; ++k) {
      const double v = data->qvel[joints[k].dof];
      const double level = (v > 0 ? joints[k].positive : joints[k].negative) + expected[k];
      expected[k] = heat.pole * expected[k] + heat.gain * level * std::abs(v);
    }
    mj_step(m, data.get());
  }
  double worst = 0;
  for (size_t k = 0; k < joints.size(); ++k) {
    const double error = std::abs(states[joints[k].energy] - expected[k]) / std::abs(expected[k]);
    worst = std::isfinite(error) ? std::max(worst, error) : kInfinity;
  }
  return worst;
}

/// Lets the robot rest under gravity, its base held, from the first keyframe. Returns how far a joint
/// moved in the last half of a second, over what a held one may give way.
double Motion(mjModel* m, const std::vector<Address>& joints) {
  Bare(m, true);
  const DataPtr data(mj_makeData(m));
  if (m->nkey > 0) mj_resetDataKeyframe(m, data.get(), 0);
  std::fill_n(data->qvel, m->nv, 0.0);
  std::vector<double> travelled(joints.size());
  while (data->time < kSecond) {
    mj_step(m, data.get());
    // what is neither hinge nor slide, a free base or a ball, is held
    for (int j = 0; j < m->njnt; ++j) {
      if (m->jnt_type[j] == mjJNT_FREE) std::fill_n(data->qvel + m->jnt_dofadr[j], 6, 0.0);
      if (m->jnt_type[j] == mjJNT_BALL) std::fill_n(data->qvel + m->jnt_dofadr[j], 3, 0.0);
    }
    if (data->time < kSecond / 2) continue;
    for (size_t k = 0; k < joints.size(); ++k) {
      travelled[k] += data->qvel[joints[k].dof] * m->opt.timestep;
    }
  }
  double worst = 0;
  for (size_t k = 0; k < joints.size(); ++k) {
    const double share = std::abs(travelled[k]) / joints[k].give;
    worst = std::isfinite(share) ? std::max(worst, share) : kInfinity;
  }
  return worst;
}

}  // namespace

std::string WhyNoRobot(const fs::path& model) {
  try {
    const LoadedModel loaded = LoadModel(model);
    for (int j = 0; j < loaded.model->njnt; ++j) {
      if (CarriesFriction(loaded.model.get(), j)) return "";
    }
    return "no hinge or slide with a name";
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
}

Trial TryRobot(const fs::path& model, FrictionForm form) {
  Trial trial;
  const fs::path out =
      fs::temp_directory_path() / fmt::format("warmjoint_public_model_{}.xml", getpid());
  try {
    const LoadedModel before = LoadModel(model);
    const mjModel* m = before.model.get();
    const std::vector<FrictionForJoint> frictions = Frictions(m);
    trial.joints = static_cast<int>(frictions.size());
    for (int j = 0; j < m->njnt; ++j) {
      const bool moves = m->jnt_type[j] == mjJNT_HINGE || m->jnt_type[j] == mjJNT_SLIDE;
      trial.nameless += moves && !mj_id2name(m, mjOBJ_JOINT, j);
    }

    AttachOptions options;
    options.form = form;
    AttachWithRemedy(model, frictions, out, options, trial.remedy);
    const LoadedModel after = LoadModel(out);
    trial.changed = options.armatures.empty() ? CountChanges(m, after.model.get(), form) : 0;
    const auto addresses = Addresses(after.model.get(), frictions, form);
    const ModelPtr copy(mj_copyModel(nullptr, after.model.get()));
    trial.heat_error = HeatError(copy.get(), addresses, form);
    trial.motion = Motion(after.model.get(), addresses);
  } catch (const BadInput& refusal) {
    trial.failure = refusal.what();
  }
  std::error_code ignored;
  fs::remove(out, ignored);
  return trial;
}

}  // namespace warmjoint::test
