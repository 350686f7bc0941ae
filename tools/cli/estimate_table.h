// Estimates for people.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>
#include <vector>

#include "tools/identify/identify_recording.h"
#include "tools/terminal/say.h"

namespace warmjoint {

/// How much is said of a verdict.
enum class Detail { brief, full };

/// Status, what is to be said of it, parameters with units, standard deviations and 95 % intervals, and
/// how well they agree with the data and with the part held out. Brief: the first three remarks; full: all of
/// them, with every test for lack of fit and every assumption.
std::string EstimateToText(const Estimate& estimate, const Measurements& measurements,
                           const Page& page, Detail detail);

/// What came of an identifier on a log; without an estimate the status and message of a command that gave no answer.
struct Answered {
  std::string name;
  std::optional<Identified> identified;
  std::string status;
  std::string message;
};

/// A table with a row for each: verdict, RMSE on all data and on the part held out, and a column for each parameter.
/// unit: of the torque.
std::string EstimatesToText(const std::vector<Answered>& answers, const std::string& unit,
                            const Page& page);

/// An estimate beside the truth, with the NPE and a row for each parameter of the truth: estimate, 95 % interval, truth,
/// whether the interval holds it, relative error. format: text, markdown, json or csv.
std::string FormatCompared(const Estimate& estimate, const Friction& truth,
                           const std::string& format);

}  // namespace warmjoint
