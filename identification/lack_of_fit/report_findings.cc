#include "identification/lack_of_fit/report_findings.h"

#include <fmt/format.h>

#include "identification/lack_of_fit/table.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// by: [p] of the examination's rows; empty for none.
ParameterMoves Named(const Eigen::VectorXd& by, const Examination& examination, const Fit& fit) {
  ParameterMoves moves;
  if (by.size() == 0) return moves;
  for (size_t i = 0; i < examination.rows.size(); ++i) {
    moves.emplace_back(fit.parameters[examination.rows[i]].name, by[static_cast<Eigen::Index>(i)]);
  }
  return moves;
}

}  // namespace

std::vector<Diagnostic> DiagnosticsOf(const Examination& examination, const Fit& fit,
                                      const std::string& unit) {
  std::vector<Diagnostic> diagnostics;
  for (const Finding& finding : examination.findings) {
    Diagnostic& one = diagnostics.emplace_back();
    one.test = finding.test->name;
    one.made = finding.made;
    // a test that was not made tells why, and nothing else
    if (!finding.made) {
      one.reason = finding.reason;
      continue;
    }
    one.statistic = ZOf(finding.p);
    one.p = finding.p;
    one.p_adjusted = finding.p_adjusted;
    one.rejected = finding.rejected;
    one.effect = examination.Rms(finding);
    one.effect_unit = unit;
    one.moves = Named(finding.moves, examination, fit);
  }
  return diagnostics;
}

std::vector<Assumption> AssumptionsOf(const Examination& examination, const Fit& fit,
                                      const std::string& unit) {
  std::vector<Assumption> assumptions;
  const auto add = [&](const char* name, std::string meaning, const Eigen::VectorXd& by) {
    if (by.size() == 0) return;
    assumptions.push_back({name, std::move(meaning), Named(by, examination, fit)});
  };

  // what is taken for granted, with how far each parameter moves where it does not hold
  add("cold_start", "the joint was cold at the start, not at a tenth of the warmth that it reaches",
      examination.by_start);
  add("open_start",
      fmt::format("the joint was cold at the start, though for all that this log tells E(0) may be "
                  "{:.2g} {}",
                  examination.open_start, unit),
      examination.by_open_start);
  add("no_slow_drift", "nothing outside of the model changed the friction by 1 % over the log",
      examination.by_drift);
  add("open_drift",
      "nothing outside of the model changed the friction slowly, though this log cannot rule it "
      "out",
      examination.by_open_drift);
  add("open_curve",
      "friction depends on the speed as the law has it, though this log cannot rule out that it "
      "bends",
      examination.by_open_curve);
  add("open_memory",
      "friction follows the speed at once, though this log cannot rule out that a part of it is "
      "late",
      examination.by_open_memory);
  add("no_dead_band",
      fmt::format("the torque's sensor has no dead band, though one of {:.2g} {} would stay unseen",
                  examination.dead_band, unit),
      examination.by_dead_band);
  add("angles_in_radians", "positions and speeds are in radians, not both in degrees",
      examination.by_degrees);
  add("true_clock", "the clock of the log is right, not off by 1 %", examination.by_clock);
  return assumptions;
}

}  // namespace warmjoint
