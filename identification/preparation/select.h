// Which samples obey Eq. (6): constant speed, so that torque = gravity + friction.
#pragma once

#include <warmjoint/recording.h>

namespace warmjoint {

/// Leaves out the samples that the options ask to leave out.
void TakeOptions(const PrepareSettings& holds, const Eigen::VectorXd& time, Selection& selection);

/// The samples of constant speed, and the rests.
struct ConstantSpeed {
  Selection selection;
  std::vector<Segment> rests;
};

/// Keeps the samples of constant speed; rests and accelerations are left out.
/// Works on runs of the velocity, so that a jump between two speeds costs no sample.
ConstantSpeed FindConstantSpeed(const Measurements& measurements);

/// The same without the rests.
Selection SelectConstantSpeed(const Measurements& measurements);

/// Keeps every sample with v != 0, for data that is known to satisfy Eq. (6) throughout.
Selection SelectMoving(const Measurements& measurements);

}  // namespace warmjoint
