#include "tools/actions/identify_by_command.h"

#include <fmt/format.h>

#include <utility>

#include "identification/warming/estimated_start.h"
#include "tools/suite/external_identifier.h"

namespace warmjoint {
namespace {

/// Figures of a second answer, to the part of the log before the held-out share.
std::optional<Metrics> HoldOut(const CheckedCommand& task, const PreparedLog& log,
                               double fraction) {
  const LogView& view = log.raw();
  const Eigen::VectorXd& time = view.measurements.time;
  // the last part of the log's time is held out
  const double begin = time[0], end = time[time.size() - 1];
  const double split = begin + (1 - fraction) * (end - begin);
  const Eigen::Index n = (time.array() < split).count();
  if (fraction == 0 || n < 2) return std::nullopt;

  // later samples test what the command makes of the earlier ones
  Selection test = view.selection;
  test.keep.head(n) = false;
  try {
    const Estimate before = task.ask(log.Before(split), {});
    return FrictionMetrics(before, view.measurements, test, StartOf(before, view.measurements));
  } catch (const NoAnswer&) {
    // part of a log may be too little for it; what it says of all of it stands
    return std::nullopt;
  }
}

}  // namespace

CheckedCommand CheckCommand(const IdentifySettings& settings, Confinement confinement) {
  // options that mean nothing to a command
  const std::pair<const char*, bool> ours[]{
      {"--gravity", settings.gravity != FittedGravity::none},
      {"--start", settings.start == StartBelief::estimated},
      {"--follows", settings.follows},
      {"--force", settings.void_numbers == VoidNumbers::show}};
  for (const auto& [option, is_given] : ours) {
    if (is_given) Refuse({option}, "is for identifiers of the list; leave it out with a command");
  }
  // what --set gives goes over the command's own options
  SuiteIdentifier command = ReadExternal(settings.identifier);
  for (const auto& [name, value] : settings.options) {
    command.options.insert_or_assign(name, value);
  }
  PreparedIdentifier ask =
      PrepareExternal(command, {"--set"}, LackOfFitSettingsOf(settings), confinement);
  return {std::move(command), std::move(ask)};
}

Estimate IdentifyByCommand(const CheckedCommand& task, const PreparedLog& log,
                           const HoldOutSource& holdout) {
  Estimate estimate = task.ask(log, {});
  // held-out figures need samples to test on and an answer to be tested
  if (!holdout.other && holdout.fraction == 0) return estimate;
  if (estimate.status != Status::ok) {
    estimate.without_holdout = fmt::format("the answer is {}", StatusName(estimate.status));
    return estimate;
  }
  // on another recording, or on the last part of this one
  estimate.holdout = holdout.other ? FrictionMetrics(estimate, holdout.other->raw().measurements,
                                                     holdout.other->raw().selection, {})
                                   : HoldOut(task, log, holdout.fraction);
  if (!estimate.holdout) {
    estimate.without_holdout =
        "the command gave no friction for the part before, or the rest keeps no sample";
  }
  return estimate;
}

}  // namespace warmjoint
