#include "identification/lack_of_fit/report_findings.h"

#include <fmt/format.h>

#include "identification/lack_of_fit/table.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint::inline identification {
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
  if (examination.by_start.size() > 0) {
    assumptions.push_back(
        {"cold_start",
         "the joint was cold at the start, not at a tenth of the warmth that it reaches",
         Named(examination.by_start, examination, fit)});
  }
  if (examination.by_open_start.size() > 0) {
    assumptions.push_back(
        {"open_start",
         fmt::format("the joint was cold at the start, though for all that this log "
                     "tells E(0) may be {:.2g} {}",
                     examination.open_start, unit),
         Named(examination.by_open_start, examination, fit)});
  }
  if (examination.by_drift.size() > 0) {
    assumptions.push_back({"no_slow_drift",
                           "nothing outside of the model changed the friction by 1 % over the log",
                           Named(examination.by_drift, examination, fit)});
    assumptions.push_back({"open_drift",
                           "nothing outside of the model changed the friction slowly, though this "
                           "log cannot rule it out",
                           Named(examination.by_open_drift, examination, fit)});
  }
  return assumptions;
}

}  // namespace warmjoint::inline identification
