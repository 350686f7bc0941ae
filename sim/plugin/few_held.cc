#include "sim/plugin/few_held.h"

#include <algorithm>

namespace warmjoint {
namespace {

/// Turns until a block of M is factorised instead; most end after two.
constexpr int kMostTurns = 12;

/// One number of those that lie in pairs.
double& At(Two* pairs, int i) { return pairs->data()[i]; }
double At(const Two* pairs, int i) { return pairs->data()[i]; }

}  // namespace

bool FewHeld::Find(const InertiaBlock& inertia, const mjData* d, AskedLevels& levels,
                   const Two* side, const Two* start, Two* slip) {
  // what slips away from its side, unless the last call has found it
  if (apart_count_ == 0 && !AddWrong(levels, side, start)) return false;
  // until the few, and all others beside them, are right
  for (int turn = 0; turn < kMostTurns; ++turn) {
    if (missing_ && !FindColumns(inertia, d)) return false;
    FindLack(start);
    if (Slip(side, start, slip)) return true;
    const bool right = Change(slip);
    const int before = apart_count_;
    if (!AddWrong(levels, side, slip)) return false;
    if (right && apart_count_ == before) return true;
  }
  return false;
}

/// Takes in what slips away from its side; false where those are too many.
bool FewHeld::AddWrong(AskedLevels& levels, const Two* side, const Two* slip) {
  // what slips against its side is apart from now on, if there is room
  for (size_t k = 0; k < pairs_; ++k) {
    const Two along = side[k] * slip[k];
    for (int lane = 0; lane < 2; ++lane) {
      const int joint = static_cast<int>(2 * k) + lane;
      if (!(along[lane] < 0) || IsApart(joint)) continue;
      if (apart_count_ == kMost) return false;
      Add(joint, side[k][lane], levels);
    }
  }
  return true;
}

bool FewHeld::IsApart(int joint) const {
  for (int n = 0; n < apart_count_; ++n) {
    if (apart_[n].joint == joint) return true;
  }
  return false;
}

void FewHeld::Add(int joint, double side, AskedLevels& levels) {
  // held at first, between the levels of both sides
  const double upper = levels.Of(joint, 1), lower = levels.Of(joint, -1);
  const double level = side > 0 ? upper : -lower, other = side > 0 ? -lower : upper;
  const int column = columns_.Find(joint);
  missing_ = missing_ || column < 0;
  apart_[apart_count_++] = {joint, column, Does::hold, side, level, level, other};
}

void FewHeld::Widen(double times) {
  for (int n = 0; n < apart_count_; ++n) {
    Apart& apart = apart_[n];
    if (!apart.held()) continue;
    apart.most *= times;
    apart.other *= times;
  }
}

/// M^-1's columns of all that are apart; false where those do not fit in.
bool FewHeld::FindColumns(const InertiaBlock& inertia, const mjData* d) {
  missing_ = false;
  std::array<int, kMost> joints;
  size_t count = 0;
  // columns that were found before stay where they are
  int place = columns_.count();
  for (int n = 0; n < apart_count_; ++n) {
    Apart& apart = apart_[n];
    if (apart.column >= 0) continue;
    apart.column = place++;
    joints[count++] = apart.joint;
  }
  return columns_.Add(inertia, d, {joints.data(), count});
}

/// What the forces of those that are apart lack to their levels.
void FewHeld::FindLack(const Two* start) {
  // one alone needs no matrix
  if (apart_count_ == 1 && apart_[0].held()) [[likely]] {
    Apart& apart = apart_[0];
    apart.lack = -At(start, apart.joint) / At(ColumnOf(apart), apart.joint);
    return;
  }
  std::array<Apart*, kMost> held;
  int count = 0;
  for (int n = 0; n < apart_count_; ++n) {
    Apart& apart = apart_[n];
    apart.lack = apart.level - apart.bound();
    if (apart.held()) held[count++] = &apart;
  }
  // the matrix of held rows of held columns is positive definite, so that no pivot is 0
  double matrix[kMost][kMost];
  for (int r = 0; r < count; ++r) {
    const int row = held[r]->joint;
    double lack = -At(start, row);
    for (int c = 0; c < count; ++c) matrix[r][c] = At(ColumnOf(*held[c]), row);
    for (int n = 0; n < apart_count_; ++n) {
      if (!apart_[n].held()) lack -= apart_[n].lack * At(ColumnOf(apart_[n]), row);
    }
    held[r]->lack = lack;
  }
  // elimination forwards, then back
  for (int p = 0; p < count; ++p) {
    for (int r = p + 1; r < count; ++r) {
      const double factor = matrix[r][p] / matrix[p][p];
      for (int c = p + 1; c < count; ++c) matrix[r][c] -= factor * matrix[p][c];
      held[r]->lack -= factor * held[p]->lack;
    }
  }
  for (int p = count - 1; p >= 0; --p) {
    for (int c = p + 1; c < count; ++c) held[p]->lack -= matrix[p][c] * held[c]->lack;
    held[p]->lack /= matrix[p][p];
  }
}

/// Finds how all slip; whether it is seen at a glance that everything is right: all but those that are
/// held slide to their sides, and no held force is out of its bounds.
bool FewHeld::Slip(const Two* side, const Two* start, Two* slip) const {
  bool right = true;
  const size_t pairs = pairs_;
  const int count = apart_count_;
  const Two* from = start;
  // each force that lacks something moves all joints
  for (int n = 0; n < count; ++n, from = slip) {
    const Apart& apart = apart_[n];
    const Two* const column = ColumnOf(apart);
    const double lack = apart.lack;
    for (size_t k = 0; k < pairs; ++k) slip[k] = from[k] + lack * column[k];
    right = right && apart.better() == Does::hold && apart.held();
  }
  if (count == 0) std::copy_n(start, pairs, slip);
  // what is held does not slip, whatever the rounding
  for (int n = 0; n < count; ++n) {
    const int joint = apart_[n].joint;
    if (apart_[n].held()) At(slip, joint) = 0;
  }
  Two least{0, 0};
  for (size_t k = 0; k < pairs; ++k) least = least.min(side[k] * slip[k]);
  return right && NoneNegative(least);
}

/// Changes what is wrong with those that are apart; whether nothing is.
bool FewHeld::Change(const Two* slip) {
  // backwards: the last, which was looked at, takes the place of one that leaves
  bool right = true;
  for (int n = apart_count_ - 1; n >= 0; --n) {
    Apart& apart = apart_[n];
    const double along = apart.side * At(slip, apart.joint);
    const bool holds = apart.does == Does::slide_to_side ? along < 0 : along > 0;
    const Does better = apart.held() ? apart.better() : holds ? Does::hold : apart.does;
    if (better == apart.does) continue;
    right = false;
    apart.does = better;
    const bool plain = better == Does::slide_to_side && apart.most == apart.level;
    if (plain) apart = apart_[--apart_count_];
  }
  return right;
}

void FewHeld::SetSliding(Rows rows) const {
  for (int n = 0; n < apart_count_; ++n) {
    const Apart& apart = apart_[n];
    const Row row = rows.row(apart.joint);
    row[kSliding] = !apart.held() && apart.side * row[kSpeed] < 0;
  }
}

void FewHeld::SetFriction(Rows rows) const {
  for (int n = 0; n < apart_count_; ++n) {
    const Apart& apart = apart_[n];
    rows.row(apart.joint)[kFriction] = apart.held() ? apart.force() : apart.bound();
  }
}

InverseColumns::InverseColumns(size_t size) : pairs_((size + 1) / 2) {
  solved_.assign(2 * pairs_, Two::Zero());
  columns_.assign(kMost * pairs_, Two::Zero());
}

void InverseColumns::Start(const InertiaBlock& inertia, const mjData* d, Rows rows, int likely) {
  const size_t pairs = pairs_;
  // M^-1 of the levels and of the likely joint, in one go
  Two* const solved = solved_.data();
  for (size_t k = 0; k < pairs; ++k) {
    const Two force = rows.pair(k)[kFriction];
    solved[2 * k] = {force[0], 0};
    solved[2 * k + 1] = {force[1], 0};
  }
  solved[likely][1] = 1;
  inertia.Solve(d, solved);
  count_ = 0;
  likely_ = likely;
}

bool InverseColumns::Add(const InertiaBlock& inertia, const mjData* d,
                         std::span<const int> joints) {
  const auto count = static_cast<int>(joints.size());
  if (count_ + count > kMost) return false;
  // two columns at a time
  for (int n = 0; n < count; n += 2) {
    std::fill(solved_.begin(), solved_.end(), Two::Zero());
    const int lanes = std::min(2, count - n);
    for (int lane = 0; lane < lanes; ++lane) solved_[joints[n + lane]][lane] = 1;
    inertia.Solve(d, solved_.data());
    for (int lane = 0; lane < lanes; ++lane) Keep(joints[n + lane], lane);
  }
  return true;
}

void InverseColumns::Keep(int joint, int lane) {
  const size_t pairs = pairs_;
  const Two* const solved = solved_.data();
  Two* const column = columns_.data() + count_ * pairs;
  for (size_t k = 0; k < pairs; ++k) {
    column[k] = {solved[2 * k][lane], solved[2 * k + 1][lane]};
  }
  joints_[count_++] = joint;
}

}  // namespace warmjoint
