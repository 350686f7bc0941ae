#include "sim/plugin/coupled_bristles.h"

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "sim/plugin/stability.h"

namespace warmjoint {

CoupledBristles::CoupledBristles(const mjModel* m, const std::vector<CoupledJoint>& joints) {
  // a tree of the model for each that has joints of the instance
  for (int id = 0; id < m->ntree; ++id) {
    std::vector<CoupledJoint> own;
    for (const CoupledJoint& joint : joints) {
      if (m->dof_treeid[joint.dof] == id) own.push_back(joint);
    }
    if (own.empty()) continue;

    // each begins at an even row, so that pairs do not reach into another
    trees_.push_back({BristleTree(m, id, own), size_});
    const size_t own_size = trees_.back().tree.size();
    size_ += own_size + own_size % 2;
  }
}

size_t CoupledBristles::RowOf(int dof) const {
  for (const auto& [tree, first] : trees_) {
    const int place = dof - tree.first_dof();
    if (place >= 0 && place < static_cast<int>(tree.size())) {
      return first + static_cast<size_t>(place);
    }
  }
  Refuse({"bristles"}, "degree of freedom {} has none", dof);
}

BristleTree::BristleTree(const mjModel* m, int tree, const std::vector<CoupledJoint>& joints)
    : joints_(joints), inertia_(m, tree) {
  complete_ = joints_.size() == size();
  // numbers of two joints stand beside each other, so that one instruction does both
  const size_t pairs = (size() + 1) / 2;
  for (std::vector<Two>* numbers : {&present_, &mobility_, &side_, &start_, &slip_}) {
    numbers->assign(pairs, Two::Zero());
  }
  for (std::vector<Two>* numbers : {&pair_, &force_}) numbers->assign(2 * pairs, Two::Zero());

  // which rows are joints of this instance, and whose level more than heat changes
  std::vector<int> asking;
  for (const CoupledJoint& joint : joints_) {
    const int i = joint.dof - inertia_.first();
    rows_of_joints_.push_back(i);
    present_[i / 2][i % 2] = 1;
    if (joint.asks_level) asking.push_back(i);
  }
  levels_ = AskedLevels(size(), std::move(asking));
  few_ = FewHeld(size());
  search_ = SearchTree(inertia_.size());
}

void BristleTree::Shape(double h, double slope, double damping, double drive) {
  const BristleShape shape = BristlesOf(joints_.front().instances, drive, slope, damping);
  impulse_ = shape.stiffness / h;
  damping_ = shape.damping / h;
}

void BristleTree::Step(const mjData* d, const LevelSource& levels, Rows rows, size_t first) {
  // first what is likely and cheap: all slide but a few, then all hold, then the search
  const double slow = Stretch(d, rows);
  levels_.Begin(levels, first, rows);
  const auto joints = static_cast<double>(joints_.size());
  if (slow <= FewHeld::kMost && slow < joints) {
    TakeSides(rows);
    // where all are fast, any will do
    if (Slide(d, rows, slow > 0 ? LikeliestHeld(rows) : 0)) return;
  }
  Multiply(d, rows);
  if (complete_ && Hold(rows)) return;
  search_.Find(inertia_, d, rows, levels_, rows_of_joints_, force_.data(), damping_);
}

/// Moves the bristles, and counts the joints that are so slow that theirs could stop them. That guess
/// decides which way is tried first, and nothing else.
double BristleTree::Stretch(const mjData* d, Rows rows) {
  const double *inverse = d->qLDiagInv + inertia_.first(), per_speed = impulse_;
  const size_t rows_count = size();
  const Two* const present = present_.data();
  Two *const mobilities = mobility_.data(), slow{0, 0};
  for (size_t k = 0; 2 * k < rows_count; ++k) {
    const RowPair row = rows.pair(k);
    const Two impulse = per_speed * row[kSpeed];
    row[kStretch] = row[kLoad] * row[kPerInertia] + impulse;
    // slow is a joint that its level could stop within the step
    const Two mobility{inverse[2 * k], 2 * k + 1 < rows_count ? inverse[2 * k + 1] : 0};
    const Two slack = mobility * row[kUpper].max(row[kLower]) - impulse.abs();
    slow += WhereNegative(slack, Two::Zero(), present[k]);
    mobilities[k] = mobility;
  }
  return slow[0] + slow[1];
}

/// What the forces of bristles that hold everything follow from: p and the momentum.
void BristleTree::Multiply(const mjData* d, Rows rows) {
  const size_t pairs = present_.size();
  Two* const pair = pair_.data();
  for (size_t k = 0; k < pairs; ++k) {
    const RowPair row = rows.pair(k);
    const Two stretch = row[kStretch], v = row[kSpeed];
    pair[2 * k] = {stretch[0], v[0]};
    pair[2 * k + 1] = {stretch[1], v[1]};
  }
  inertia_.Multiply(d, pair_.data(), force_.data());
}

/// Whether everything is held by forces within the levels.
bool BristleTree::Hold(Rows rows) {
  const double damping = damping_;
  // levels that have to be asked for, on the side of the force first
  for (const int i : levels_.asking()) {
    const double elastic = force_[i][0], friction = elastic + damping * force_[i][1];
    const int side = elastic < 0 ? -1 : 1;
    levels_.Of(i, side);
    if (side * friction < 0) levels_.Of(i, -side);
  }

  // the bristle within both levels, and with the damper within twice them, in pairs
  const size_t pairs = present_.size();
  const Two* const force = force_.data();
  Two within{0, 0};
  for (size_t k = 0; k < pairs; ++k) {
    const RowPair row = rows.pair(k);
    const Two one = force[2 * k], other = force[2 * k + 1];
    const Two elastic{one[0], other[0]}, momentum{one[1], other[1]};
    const Two friction = elastic + damping * momentum, share = friction / kDamperLevels;
    const Two below = row[kUpper] - elastic.max(share);
    within = within.min(below).min(row[kLower] + elastic.min(share));
    row[kFriction] = friction;
    row[kLoad] = row[kStretch] * row[kInertia];
    row[kSliding] = Two::Zero();
  }
  return NoneNegative(within);
}

/// Sets every joint's side and the level there.
void BristleTree::TakeSides(Rows rows) {
  // levels that have to be asked for, on the side of the stretch
  for (const int i : levels_.asking()) levels_.Of(i, rows.row(i)[kStretch] < 0 ? -1 : 1);
  const size_t pairs = present_.size();
  const Two* const presents = present_.data();
  Two* const sides = side_.data();
  for (size_t k = 0; k < pairs; ++k) {
    const RowPair row = rows.pair(k);
    const Two stretch = row[kStretch], present = presents[k];
    sides[k] = WhereNegative(stretch, -present, present);
    row[kFriction] = WhereNegative(stretch, -row[kLower], row[kUpper]);
  }
}

/// The row that is the likeliest to be held: whose speed its level stops most easily.
int BristleTree::LikeliestHeld(Rows rows) const {
  const size_t pairs = present_.size();
  const double impulse = impulse_;
  const Two* const mobility = mobility_.data();
  Two least{0, 0}, likely{0, 1}, place{0, 1};
  for (size_t k = 0; k < pairs; ++k, place += 2) {
    const RowPair row = rows.pair(k);
    const Two left = (impulse * row[kSpeed]).abs() - mobility[k] * row[kFriction].abs();
    likely = WhereNegative(left - least, place, likely);
    least = left.min(least);
  }
  const auto row = static_cast<int>(likely[least[1] < least[0] ? 1 : 0]);
  return std::min(row, inertia_.size() - 1);
}

/// Whether all slide to the side of their stretch, but for a few. Sliding, z' is where the bristles
/// carry their levels, and the damper is on the side of the motion. likely: the row to be held, if any.
bool BristleTree::Slide(const mjData* d, Rows rows, int likely) {
  few_.Start(inertia_, d, rows, likely);
  const size_t pairs = present_.size();
  const Two *const present = present_.data(), *const sides = side_.data();
  Two *const start = start_.data(), least{0, 0};
  // sliding is right where slip and speed go to the side of the stretch
  for (size_t k = 0; k < pairs; ++k) {
    const RowPair row = rows.pair(k);
    const Two bearing = few_.bearing(k), slip = row[kStretch] - bearing, v = row[kSpeed];
    const Two side = sides[k];
    least = least.min(side * slip).min(side * v);
    row[kLoad] = bearing * row[kInertia];
    row[kSliding] = WhereNegative(-v.abs(), present[k], Two::Zero());
    start[k] = slip;
  }
  return NoneNegative(least) || SlideButFew(d, rows);
}

bool BristleTree::SlideButFew(const mjData* d, Rows rows) {
  if (!few_.Find(inertia_, d, levels_, side_.data(), start_.data(), slip_.data())) return false;

  // then the damper, from where the bristles are now
  const size_t pairs = present_.size();
  const double damping = damping_;
  const Two *const present = present_.data(), *const sides = side_.data();
  const Two* const slips = slip_.data();
  Two* const start = start_.data();
  for (size_t k = 0; k < pairs; ++k) {
    const RowPair row = rows.pair(k);
    const Two slip = slips[k], v = row[kSpeed];
    row[kLoad] = (row[kStretch] - slip) * row[kInertia];
    row[kSliding] = WhereNegative(-sides[k] * v, present[k], Two::Zero());
    start[k] += damping * v - slip;
  }
  few_.SetSliding(rows);
  few_.Widen(kDamperLevels);
  if (!few_.Find(inertia_, d, levels_, side_.data(), start_.data(), slip_.data())) return false;
  few_.SetFriction(rows);
  return true;
}

}  // namespace warmjoint
