// Logs and estimates as data for the Python that draws (tools/python/warmjoint/figures).
#pragma once

#include <warmjoint/prepared_log.h>
#include <warmjoint/robot_estimate.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/shown/estimate_view.h"
#include "tools/shown/shown_data.h"

namespace warmjoint::shown {

/// {parameters, shown, tests, assumptions, trace, remarks, columns, curves, ...}: an estimate and, of `view`, its recording. Returns
/// facts whose arrays `data` holds.
Tree ViewFacts(const FitView& view, ShownData& data);

/// {fit, held_out, guess}: an estimate with its recording, or alone; `truth`: of the warming, beside the first guess where it is known.
Tree EstimateFacts(const EstimateView& view, ShownData& data,
                   const std::optional<Thermal>& truth = std::nullopt);

/// The same of a log and its fit alone, or a log without one.
Tree FitFacts(const FitView& view, ShownData& data);

/// {fit, check, commands}: a page on one log. commands: by which a reader repeats it.
Tree PageFacts(const FitView& view, const RecordingCheck& check,
               const std::vector<std::string>& commands, ShownData& data);

/// [{joint, status, message, ...columns}] of the joints that have a fit.
Tree RobotFacts(const RobotEstimate& robot, ShownData& data);

/// The name of a joint's picture, without its end: no folder and not hidden, and none that is taken, also by letters of another case.
std::string FileOf(const std::string& joint, std::set<std::string>& taken);

/// What the first guess of a warming is read off; null where there is none.
Tree GuessFacts(const LogSamples& measurements, const Selection& selection,
                const std::optional<Thermal>& truth, ShownData& data);

}  // namespace warmjoint::shown
