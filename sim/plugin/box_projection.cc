#include "sim/plugin/box_projection.h"

#include <algorithm>

#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

/// How far a force may be beyond its bound by rounding.
constexpr double kRounding = 1e-13;

/// Projections end long before; one that does not, for numbers without bound, is left.
constexpr int kMostTurns = 200;

/// Turns in which no fewer are wrong, before one at a time is turned.
constexpr int kTurnsWithoutGain = 6;

}  // namespace

BoxProjection::BoxProjection(int size) {
  const auto n = static_cast<size_t>(size);
  status.assign(n, within);
  slips_.assign(n, 0);
  for (std::vector<double>* numbers : {&lower, &upper, &aim, &force, &slip}) numbers->assign(n, 0);
}

void BoxProjection::Start(InertiaBlock& inertia, const mjData* d) {
  for (size_t i = 0; i < status.size(); ++i) slips_[i] = status[i] != within;
  inertia.Factorise(d, slips_);
}

void BoxProjection::Find(InertiaBlock& inertia, const mjData* d) {
  const size_t size = status.size();
  int best = kMostTurns, left = kTurnsWithoutGain;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    // forces of those that hold follow from the slips of those at their bounds
    for (size_t i = 0; i < size; ++i) slip[i] = status[i] == within ? 0 : aim[i] - Bound(i);
    inertia.SolveBlock(slip.data());
    force = aim;
    inertia.Subtract(d, slip.data(), force.data());

    // until nothing is wrong; one at a time where all at once does not get nearer
    const int wrong = Count();
    if (wrong == 0) break;
    if (wrong < best) left = kTurnsWithoutGain + 1;
    best = std::min(best, wrong);
    Turn(left-- > 0);
    Start(inertia, d);
  }
  // to the last digit
  for (size_t i = 0; i < size; ++i) {
    force[i] = status[i] == within ? std::clamp(force[i], -lower[i], upper[i]) : Bound(i);
  }
}

double BoxProjection::Bound(size_t i) const {
  if (status[i] == at_upper) return upper[i];
  return status[i] == at_lower ? -lower[i] : 0;
}

/// The status that a degree of freedom should have, after this slip and force.
BoxProjection::Status BoxProjection::Better(size_t i) const {
  if (status[i] == free) return free;
  if (status[i] != within) return int{status[i]} * slip[i] < 0 ? within : status[i];
  if (force[i] > (1 + kRounding) * upper[i]) return at_upper;
  return -force[i] > (1 + kRounding) * lower[i] ? at_lower : within;
}

int BoxProjection::Count() const {
  int wrong = 0;
  for (size_t i = 0; i < status.size(); ++i) wrong += Better(i) != status[i];
  return wrong;
}

void BoxProjection::Turn(bool all) {
  for (size_t i = status.size(); i-- > 0;) {
    const Status better = Better(i);
    if (better == status[i]) continue;
    status[i] = better;
    if (!all) return;
  }
}

using Status = BoxProjection::Status;

/// Takes over levels and forces, and what each row did at the last step.
void SearchTree::Take(Rows rows, const Two* force) {
  for (size_t i = 0; i < last_.size(); ++i) {
    const Row row = rows.row(static_cast<int>(i));
    const double upper = box_.upper[i] = row[kUpper], lower = box_.lower[i] = row[kLower];
    box_.aim[i] = force[i][0];
    const bool free = upper == 0 && lower == 0;
    box_.status[i] = free ? Status::free : last_[i] == Status::free ? Status::within : last_[i];
  }
}

void SearchTree::Find(InertiaBlock& inertia, const mjData* d, Rows rows, AskedLevels& levels,
                      const std::vector<int>& joints, const Two* force, double damping) {
  for (const int i : levels.asking()) {
    levels.Of(i, 1);
    levels.Of(i, -1);
  }
  Take(rows, force);
  box_.Start(inertia, d);
  box_.Find(inertia, d);
  last_ = box_.status;
  for (const int i : joints) {
    const Row row = rows.row(i);
    row[kLoad] = (row[kStretch] - box_.slip[i]) * row[kInertia];
    const int side = box_.status[i] == Status::free ? 0 : int{box_.status[i]};
    row[kSliding] = side * row[kSpeed] > 0;
  }

  // then the damper, from where the bristles are now, with more room for those that hold
  for (int i = 0; i < inertia.size(); ++i) {
    const double times = box_.status[i] == Status::within ? kDamperLevels : 1;
    box_.upper[i] *= times;
    box_.lower[i] *= times;
    box_.aim[i] = box_.force[i] + damping * force[i][1];
  }
  box_.Find(inertia, d);
  for (const int i : joints) rows.row(i)[kFriction] = box_.force[i];
}

}  // namespace warmjoint
