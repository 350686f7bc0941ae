// Which samples obey Eq. (6): constant speed, so that torque = gravity + friction.
#pragma once

#include "models/foundation/field.h"
#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// What a user asks of the segments that are kept.
struct PrepareSettings {
  double trim = 0;           // s to leave out at each end of a segment
  double shortest_hold = 0;  // s; segments that last less, before they are trimmed, are left out

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo seconds{
        .unit = "s", .bounds = {.at_least = 0}, .at_default = AtDefault::left_out};
    a->Field("trim", &trim, seconds);
    a->Field("shortest_hold", &shortest_hold, seconds);
  }
};

/// Leaves out what the options ask for.
void TakeOptions(const PrepareSettings& holds, const Eigen::VectorXd& time, Selection& selection);

/// What moves at a constant speed, and what stands.
struct ConstantSpeed {
  Selection selection;
  std::vector<Segment> rests;
};

/// Appends what was found in a recording whose first sample is `first` and whose velocities are to
/// be multiplied by `scale`.
void Append(const ConstantSpeed& found, Eigen::Index first, double scale, ConstantSpeed& all);

/// Keeps the samples that move at a constant speed; rests and accelerations are left out.
/// Works on plateaus of the velocity, so that a jump between two plateaus costs no sample; recording
/// by recording (Measurements::starts).
ConstantSpeed FindConstantSpeed(const Measurements& measurements);

/// The same without the rests.
Selection SelectConstantSpeed(const Measurements& measurements);

/// Keeps every sample with v != 0, for data that is known to satisfy Eq. (6) throughout.
Selection SelectMoving(const Measurements& measurements);

}  // namespace warmjoint::inline identification
