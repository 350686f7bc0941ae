// A torque that is late relative to the motion, for motion of any kind: one more unknown of a fit of law, heat, gravity and inertia.
#pragma once

#include <functional>
#include <optional>

#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/options.h"

namespace warmjoint {

/// The option of an identifier that can estimate the torque's delay.
struct DelayOption {
  PartFit torque_delay = PartFit::estimated;

  template <class A>
  void Serialize(A* a) {
    a->Field(
        "torque_delay", &torque_delay,
        {.meaning = "by how much the torque is late against motion of any kind: estimated where "
                    "the log tells it, or none"});
  }
};

/// Whether a fit to these samples has the delay among its unknowns.
bool MayBeLate(const IdentifierInput& given);

/// A fit to samples whose torque follows their motion at once.
using FitInTime = std::function<Fit(const IdentifierInput& given)>;

/// tau(t) = F + G + M a at t - d: the fit of the model to the motion at t - d (Delayed), d from a search for the least squares of
/// law, gravity and inertia, then by Gauss-Newton steps over all unknowns and d, whose column is the model's derivative by the
/// shift of time. d joins the table, the Jacobian and the errors as one more unknown, torque_delay; a sentence names it where
/// IsLate. Where the log determines d to no better than half a sample, and IsLate does not hold, the fit is the one without
/// a delay, which assumes that there is none. given: samples of PreparedLog::moving
Fit FitBehindDelay(const IdentifierInput& given, const FitInTime& fit_in_time);

/// Whether a fit has a delay that exceeds four of its standard errors.
bool IsLate(const Fit& fit);

/// Copies into `fit` the delay of another fit of the same log, with the sentence that names it, but not its error.
void TakeDelay(double delay, const LogSamples& measurements, Fit& fit);

}  // namespace warmjoint
