// How well a torque along a log follows the true friction.
#pragma once

#include <warmjoint/prepared_log.h>
#include <warmjoint/simulation.h>

#include <Eigen/Core>
#include <array>
#include <limits>

namespace warmjoint {

/// Of samples that slide at a steady speed; NaN where there is none, or no contact.
struct CompensationScore {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double residual = kNone;       // rms over the log, % of the friction's rms
  double median_minute = kNone;  // the same within a minute
  double worst_minute = kNone;
  double after_starts =
      kNone;            // over ten minutes after the start and each rest of ten minutes or more
  double push = kNone;  // N.m or N: smallest that an alarm which errs once an hour sees
  double contact_bias = kNone;   // N.m or N: mean of measured torque - found - contact
  double contact_width = kNone;  // N.m or N: half of what holds 95 % of its means over a second
  /// [K] the residual within each minute, %; NaN where too little of it slides.
  Eigen::VectorXd by_minute;
};

/// One number of a score, as tables show it.
struct CompensationMeasure {
  const char* name;
  const char* label;
  bool is_share;  // %, else N.m or N
  double CompensationScore::*value;
};

/// All of them, the one that ranks first.
inline constexpr std::array<CompensationMeasure, 7> kCompensationMeasures{{
    {"residual", "residual", true, &CompensationScore::residual},
    {"median_minute", "median minute", true, &CompensationScore::median_minute},
    {"worst_minute", "worst minute", true, &CompensationScore::worst_minute},
    {"after_starts", "10 min after starts", true, &CompensationScore::after_starts},
    {"push", "push", false, &CompensationScore::push},
    {"contact_bias", "bias of a contact", false, &CompensationScore::contact_bias},
    {"contact_width", "its 95 %", false, &CompensationScore::contact_width},
}};

/// found: [N] friction, N.m or N. log: its velocity is 0 at rest. contact: [N] what leans on the joint, N.m or N. Throws BadInput for another length.
CompensationScore ScoreCompensation(const Eigen::VectorXd& found, const LogSamples& log,
                                    const Truth& truth, const Eigen::VectorXd& contact);

}  // namespace warmjoint
