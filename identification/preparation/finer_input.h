// What identifiers see of a log: with one velocity for each segment where that is needed, and with
// the switches of speed that happen between two samples.
#pragma once

#include <optional>

#include "identification/identifier.h"
#include "identification/preparation/segment_velocity.h"
#include "identification/preparation/split_at_switches.h"

namespace warmjoint::inline identification {

/// An input whose log has one velocity for each segment where its noise would bias a fit
/// (segment_velocity.h) and a sample at each switch of speed (split_at_switches.h), or the log as
/// it is for an identifier of transient motion. Holds the log it refers to; what `given` refers to
/// must outlive it.
class FinerInput {
 public:
  FinerInput(const Identifier& identifier, const IdentifierInput& given)
      : level_(identifier.regime == Regime::transient
                   ? std::nullopt
                   : TakeSegmentVelocity(given.measurements, given.selection)),
        split_(identifier.regime == Regime::transient
                   ? std::nullopt
                   : SplitAtSwitches(Levelled(given), given.selection)),
        input_{split_ ? split_->measurements : Levelled(given),
               split_ ? split_->selection : given.selection, given.options, given.random},
        given_(given) {}
  FinerInput(const FinerInput&) = delete;
  FinerInput& operator=(const FinerInput&) = delete;

  const IdentifierInput& input() const { return input_; }

  /// The log as it was taken.
  const IdentifierInput& given() const { return given_; }

  /// What was done to the velocity, if anything.
  const std::optional<SegmentVelocity>& velocity() const { return level_; }

  /// Share of the path that the log cannot tell from standing still (SplitLog::unseen).
  double unseen() const { return split_ ? split_->unseen : 0; }

 private:
  const Measurements& Levelled(const IdentifierInput& given) const {
    return level_ ? level_->measurements : given.measurements;
  }

  std::optional<SegmentVelocity> level_;
  std::optional<SplitLog> split_;
  IdentifierInput input_;
  IdentifierInput given_;
};

/// Warns in an estimate with warming how far the gain may be off where reversals happen between two
/// samples. Nothing where that is below half a per cent.
void WarnOfUnseenReversals(double unseen, Estimate& estimate);

}  // namespace warmjoint::inline identification
