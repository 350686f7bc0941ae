// What identifiers see of a log: with the switches of speed that happen between two samples.
#pragma once

#include <optional>

#include "identification/identifier.h"
#include "sim/dataset/split_at_switches.h"

namespace warmjoint {

/// An input whose log has a sample at each switch of speed (split_at_switches.h), or the log as it
/// is for an identifier of transient motion. Holds the log it refers to; what `given` refers to
/// must outlive it.
class FinerInput {
 public:
  FinerInput(const Identifier& identifier, const IdentifierInput& given)
      : split_(identifier.regime == Regime::transient
                   ? std::nullopt
                   : SplitAtSwitches(given.measurements, given.selection)),
        input_{split_ ? split_->measurements : given.measurements,
               split_ ? split_->selection : given.selection, given.options, given.random},
        given_(given) {}
  FinerInput(const FinerInput&) = delete;
  FinerInput& operator=(const FinerInput&) = delete;

  const IdentifierInput& input() const { return input_; }

  /// The log as it was taken.
  const IdentifierInput& given() const { return given_; }

  /// Share of the path that the log cannot tell from standing still (SplitLog::unseen).
  double unseen() const { return split_ ? split_->unseen : 0; }

 private:
  std::optional<SplitLog> split_;
  IdentifierInput input_;
  IdentifierInput given_;
};

/// Warns in an estimate with warming how far the gain may be off where reversals happen between two
/// samples. Nothing where that is below half a per cent.
void WarnOfUnseenReversals(double unseen, Estimate& estimate);

}  // namespace warmjoint
