// Estimates for people.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/recording.h>

#include <string>
#include <vector>

#include "tools/terminal/say.h"

namespace warmjoint {

/// How much is said of a verdict.
enum class Detail { brief, full };

/// Status, what is to be said of it, parameters with units, standard deviations and 95 % intervals, and
/// how well they agree with the data and with the part held out. Brief: the first three remarks; full: all of
/// them, with every test for lack of fit and every assumption.
std::string EstimateToText(const Estimate& estimate, const Measurements& measurements,
                           const Page& page, Detail detail);

/// One of several identifiers on a log. status: of one that gave no estimate.
struct EstimateRow {
  std::string name;
  std::string status;
  const Estimate* estimate = nullptr;
};

/// A table with a row for each: verdict, RMSE on all data and on the part held out, and a column for each parameter.
/// unit: of the torque.
std::string EstimatesToText(const std::vector<EstimateRow>& rows, const std::string& unit);

/// An estimate beside the truth, with the NPE and a row for each parameter of the truth: estimate, 95 % interval, truth,
/// whether the interval holds it, relative error. format: text, markdown, json or csv.
std::string FormatCompared(const Estimate& estimate, const Friction& truth,
                           const std::string& format);

}  // namespace warmjoint
