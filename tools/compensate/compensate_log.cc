#include "tools/compensate/compensate_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/estimate.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/node.h"
#include "tools/shown/friction_doubt.h"

namespace warmjoint {
namespace {

/// Weight and inertia of the model at each sample, N.m or N; NaN where the weight is not known. [N]
Eigen::VectorXd RigidTorque(const TorqueModel& model, const LogSamples& m) {
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(m.size());
  if (model.gravity) {
    torque = model.gravity->Torque(m.position);
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      if (!model.gravity->Covers(m.position[i])) {
        torque[i] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  if (model.inertia && m.acceleration) torque += *model.inertia * *m.acceleration;
  return torque;
}

/// Refuses a log that the model cannot be held against.
void CheckUnits(const TorqueModel& model, const LogSamples& m) {
  const std::string& amperes = model.friction.torque_unit;
  const std::string_view unit = amperes.empty() ? kTorqueUnit.For(m.joint) : amperes;
  if (m.torque_unit != unit) {
    Refuse({m.source}, "has a torque in {} and friction is in {}; give {}", m.torque_unit, unit,
           amperes.empty() ? "--torque-constant" : "--unit torque=A");
  }
  const bool needs = model.gravity || std::ranges::any_of(model.friction.maps, [](const auto& map) {
                       return FindAxis(map, MapQuantity::position) != nullptr;
                     });
  if (m.position_integrated && needs) {
    Refuse({m.source}, "has no positions, and the estimate's gravity or map needs them; log them");
  }
}

/// Heat or correction beyond so many cold levels are another joint's. why: grease is ten times as stiff some 40 K colder, which is
/// what surroundings change by.
constexpr double kMostLevels = 10;

/// Refuses a state that this friction cannot have.
void CheckState(const wj_friction& friction, const KeptState& kept, const std::string& file) {
  const double level =
      std::max(friction.coulomb_positive, friction.coulomb_negative) + friction.static_rise;
  // friction by maps alone has no level
  if (!(level > 0)) return;
  const double heat = kept.energy + kept.second_energy;
  if (heat < -level || std::max(heat, std::abs(kept.correction)) > kMostLevels * level) {
    Refuse({file},
           "holds a heat of {:.4g} and a correction of {:.4g} of a level of {:.4g}, so it is of "
           "another joint; give that joint's friction, or another --state FILE",
           heat, kept.correction, level);
  }
}

}  // namespace

JointToCompensate ToCompensate(const Estimate& estimate, const std::string& file) {
  JointToCompensate joint{StoredModelOf(estimate, file), shown::DoubtOf(estimate)};
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    const double speed = std::abs(one.speed);
    if (speed > 0 && (joint.slowest == 0 || speed < joint.slowest)) joint.slowest = speed;
  }
  return joint;
}

JointToCompensate ReadToCompensate(const std::string& file) {
  const Node document = ReadJsonNode(file);
  if (document.IsMap() && document.Find("joints")) {
    Refuse({file}, "holds the joints of a robot; give --robot, its description");
  }
  if (document.Find("identifier")) return ToCompensate(EstimateFrom(document), file);
  return {ReadStoredModel(file), {}};
}

double DeadBandOf(const JointToCompensate& joint) { return joint.slowest / 10; }

double GoOn(Compensator& compensator, const KeptState& kept, double begin,
            std::optional<double> pause, const std::string& file) {
  const double seconds = pause.value_or(begin - kept.time);
  if (!(seconds >= 0)) {
    Refuse({"--state"},
           "{} ends at {:.6g} s and the log begins at {:.6g} s, so their stamps share no clock; "
           "give --pause SECONDS, from the last sample of the one to the first of the other",
           file, kept.time, begin);
  }
  CheckState(compensator.joint().friction, kept, file);
  const wj_state state{kept.energy, kept.second_energy, kept.correction, kept.variance};
  wj_restore(&compensator.joint(), &state, seconds);
  return seconds;
}

KeptState StateOf(const Compensator& compensator, double time) {
  const wj_state& state = compensator.joint().state;
  return {state.energy, state.second_energy, state.correction, state.variance, time};
}

CompensatedLog CompensateLog(const StoredModel& stored, const PreparedLog& log,
                             Compensator& compensator) {
  // accelerations are there where the model has an inertia
  const LogView& view = SeenByModel(stored.model.inertia, View::raw, log);
  CompensatedLog found{view.measurements, {}, {}};
  const LogSamples& m = found.measurements;
  CheckUnits(stored.model, m);
  found.torque = m.torque - RigidTorque(stored.model, m);

  JointTrajectory motion = TrajectoryOf(m);
  motion.torque = found.torque;
  if (stored.model.friction.load_gain != 0 && stored.model.gravity && motion.load.size() == 0) {
    motion.load = stored.model.gravity->Torque(m.position);
  }
  found.found = CompensateAlong(compensator, motion);
  return found;
}

FileContent ColumnsOf(const CompensatedLog& log) {
  const LogSamples& m = log.measurements;
  const Compensated& found = log.found;
  const bool is_rotary = m.joint == JointKind::rotary;
  const std::string position = is_rotary ? "rad" : "m", velocity = is_rotary ? "rad/s" : "m/s";
  const std::string& torque = m.torque_unit;
  const std::vector<Eigen::Index> logged = m.Logged();
  FileContent content;
  content.joint = std::string(NameOf(m.joint));
  content.gear = m.gear;
  const auto add = [&](const char* name, const std::string& unit, const Eigen::VectorXd& values) {
    content.columns.push_back({.name = name, .unit = unit, .values = values(logged)});
  };
  add("time", "s", m.time);
  add("position", position, m.position);
  add("velocity", velocity, m.velocity);
  add("torque", torque, m.torque);
  add("friction", torque, found.friction);
  add("residual", torque, found.residual);
  add("energy", torque, found.energy);
  add("loss", "W", found.loss);
  add("std", torque, found.std);
  add("contact", "", found.contact);
  add("compensation", torque, found.compensation);
  return content;
}

}  // namespace warmjoint
