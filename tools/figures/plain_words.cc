#include "tools/figures/plain_words.h"

#include "identification/lack_of_fit/table.h"

namespace warmjoint::figures {

std::string QuestionOf(const std::string& test) {
  const LackOfFitTest* row = FindLackOfFitTest(test);
  return row ? std::string(row->question) : test;
}

std::string RemedyOf(const std::string& test) {
  const LackOfFitTest* row = FindLackOfFitTest(test);
  if (row) return std::string(row->advice);
  return "The residual shows " + test + ": look at its pictures.";
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
       "1 − norm of the residual over norm of the torque's variation, in per cent; root of the "
       "mean "
       "square error; mean absolute error."},
      {"void", "A number of a fit that failed a test. It may look precise and be wrong."},
  };
  return terms;
}

}  // namespace warmjoint::figures
