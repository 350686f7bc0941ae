// The last step: a fit and what is inferred from it, with names and units.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <vector>

#include "identification/fit/fit.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// E at the log's last sample, N.m or N: `energy`, and `second_energy` of a second stage; before
/// them the stamp of that sample, `time`, s, where the log is one recording. Along the
/// motion with the friction that is reported; the interval follows from the parameters' covariance
/// by the fit's own slopes, or central differences where it has none, and is widened as the verdict
/// widened those of the parameters. Empty where nothing warms.
std::vector<EstimatedParameter> EndState(const Fit& fit, const Inference& inference,
                                         const Friction& friction, const LogSamples& measurements);

/// The numbers of an answer that causes refused (Inference::refused): they are shown only on request (--force), with a message
/// that says that they are void.
enum class RefusedNumbers { hide, show };

/// The estimate: parameters by name with their intervals; in addition to the warming's gain and time
/// constant the discrete pair of Eq. (22) for the median sampling interval; metrics, trace, friction,
/// gravity, bands and the covariance of the values. measurements: what the fit saw.
Estimate ReportFit(const Fit& fit, const Inference& inference, const PreparedLog& log,
                   const LogSamples& measurements, RefusedNumbers numbers = RefusedNumbers::hide);
/// The same without a prepared log, so that the report of a fit that did not converge does not say what the log lacks.
Estimate ReportFit(const Fit& fit, const Inference& inference, const LogSamples& measurements,
                   RefusedNumbers numbers = RefusedNumbers::hide);

/// What an answer says in addition to its numbers: status, message, warnings, tests and assumptions.
void ReportVerdict(const Inference& inference, Estimate& estimate);

/// The fit's friction with the values that the causes changed.
Friction ReportedFriction(const Fit& fit, const Inference& inference);

}  // namespace warmjoint
