#include "tools/report/page/plain_words.h"

#include <algorithm>
#include <iterator>

namespace warmjoint::report {
namespace {

struct TestWords {
  const char* test;
  const char* question;
  const char* remedy;
};

constexpr TestWords kTests[] = {
    {"direction", "Do forward and backward motion leave different residuals?",
     "Friction differs by direction: try --set law=asymmetric, with stribeck or lugre --set "
     "law=asymmetric_stribeck or asymmetric_lugre. If gravity or a load acts, try "
     "--gravity sincos or "
     "--gravity paired."},
    {"speed_memory", "Does friction follow the speed late?",
     "Friction still depends on the speed of a while ago: hold each speed for longer, so that it "
     "settles."},
    {"speed", "Does the residual depend on the speed?",
     "The law over speed is too simple: try --identifier stribeck, and record five speeds or more, "
     "the slowest below "
     "a twentieth of the fastest."},
    {"energy", "Does it depend on how warm the joint is?",
     "Warming is not followed: try --identifier energy-ml, on a log that begins cold and lasts "
     "until the torque "
     "settles."},
    {"initial_energy", "Was the joint warm when the log began?",
     "The joint seems warm at the start: try --start estimated, or let it cool down for an hour "
     "before you record."},
    {"load", "Does it depend on the load?",
     "Friction depends on the load: record one load at a time."},
    {"temperature", "Does it depend on the measured temperature?",
     "The surroundings warm the joint: record at a steady temperature."},
    {"time", "Does it drift over time?",
     "Friction drifts: try a model that warms (--identifier energy-ml), or record for longer."},
    {"speed_by_energy", "Does the slope over speed change with warmth?",
     "The slope changes as the joint warms: try --identifier lpv-energy."},
    {"step", "Does it jump at some moment?",
     "Something changed in the middle of the log (load, controller, grease): record again, or cut "
     "the log there."},
    {"lag", "Does the torque lag behind changes of speed?",
     "The torque column is filtered or delayed: raise --trim, so that samples after each change of "
     "speed are left out."},
    {"position_by_energy", "Does the pattern over position change with warmth?",
     "The pattern over position fades or grows as the joint warms: let the map depend on energy."},
    {"position", "Does it repeat over position?",
     "Friction varies over position: try --identifier position-ridge, with motion over the whole "
     "travel."},
    {"motor_angle", "Does it repeat over the motor's angle?",
     "The motor or the gear ripples: give --gear or a column motor_position and try --identifier "
     "motor-ridge."},
    {"hold_parity", "Is every other hold of constant speed different?",
     "Holds alternate: look whether the two directions have the same load."},
    {"hold_phase", "Does it change within each hold of constant speed?",
     "Torque settles within each hold: raise --trim, or hold each speed for longer."},
    {"periodic", "Does it repeat in time?",
     "Something repeats in time: look for a controller that swings, or another joint that moves."},
};

const TestWords* Find(const std::string& test) {
  const auto found = std::find_if(std::begin(kTests), std::end(kTests),
                                  [&](const TestWords& words) { return words.test == test; });
  return found == std::end(kTests) ? nullptr : found;
}

}  // namespace

std::string QuestionOf(const std::string& test) {
  const TestWords* words = Find(test);
  return words ? words->question : test;
}

std::string RemedyOf(const std::string& test) {
  const TestWords* words = Find(test);
  return words ? words->remedy : "The residual shows " + test + ": look at its pictures.";
}

std::string AssumptionOf(const std::string& name) {
  if (name == "cold_start") return "The joint was as cold as its surroundings when the log began";
  if (name == "no_slow_drift")
    return "Nothing else drifted slowly, such as the temperature of the room";
  if (name == "open_start")
    return "The joint was cold when the log began; what the log itself says";
  if (name == "open_drift") return "Nothing else drifted slowly; what the log itself says";
  if (name == "open_curve") return "Friction bends over the speed no more than the log itself says";
  if (name == "open_memory")
    return "Friction follows the speed at once, as far as the log itself says";
  if (name == "no_dead_band") return "The torque's sensor has no dead band";
  if (name == "angles_in_radians") return "Positions and speeds are in radians, not in degrees";
  if (name == "true_clock") return "The clock of the log is right to 1 %";
  return name;
}

const std::vector<std::pair<std::string, std::string>>& Terms() {
  static const std::vector<std::pair<std::string, std::string>> terms{
      {"friction",
       "The torque that motion costs, against its direction. It falls as grease warms."},
      {"viscous, coulomb",
       "Friction that grows with speed (N·m for each rad/s), and that which does not (N·m)."},
      {"thermal_gain, thermal_time_constant",
       "By how much each watt of the joint's own heat changes friction, and how long that takes. E "
       "is the change that "
       "is reached; no thermometer is needed."},
      {"kept samples",
       "Samples at a constant speed: there the torque is friction, and gravity where it acts."},
      {"residual", "Measured torque less fitted torque."},
      {"95 % interval",
       "A range that holds the true value in 95 of 100 such logs, if the model is right."},
      {"Fit, RMSE, MAE",
       "Share of the torque's variation that is explained; root of the mean square error; mean "
       "error."},
      {"void", "A number of a fit that failed a test. It may look precise and be wrong."},
  };
  return terms;
}

}  // namespace warmjoint::report
