#include "sim/plugin/bristle_tree.h"

#include <algorithm>
#include <cmath>

#include "sim/plugin/bristle_shape.h"

namespace warmjoint::inline sim {
namespace {

/// A slope of friction over speed that the step can carry takes at most so much of the damping.
constexpr double kMostSlope = 0.5;

/// Both sides' levels are known.
constexpr unsigned char kBoth = 3;

}  // namespace

BristleTree::BristleTree(const mjModel* m, int tree, const std::vector<CoupledJoint>& joints)
    : joints_(joints), inertia_(m, tree) {
  const auto size = static_cast<size_t>(inertia_.size());
  complete_ = joints_.size() == size;
  for (std::vector<double>* numbers : {&level_, &slip_, &left_}) numbers->assign(size, 0);
  side_.assign(size, 0);
  known_.assign(size, kBoth);
  pair_.assign(size + size % 2, Two::Zero());
  force_ = pair_;
  slow_ = FewHeld(size);
  projection_ = BoxProjection(inertia_.size());
  for (const CoupledJoint& joint : joints_) {
    const int i = joint.dof - inertia_.first();
    joint_at_.push_back({i, PlaceOf(static_cast<size_t>(i))});
    if (joint.asks_level) asking_.push_back(joint_at_.back());
  }
}

void BristleTree::Shape(double h, double slope, double damping) {
  // the slope damps already
  slope = std::min(slope, kMostSlope);
  const BristleShape shape = BristlesOf(joints_.front().instances);
  impulse_ = shape.stiffness * (1 - slope) / h;
  damping_ = std::max(0.0, damping * shape.damping - slope) / h;
}

void BristleTree::Step(const mjData* d, const LevelSource& levels, Rows rows, size_t first) {
  levels_ = &levels;
  first_ = first;
  Stretch(d, rows);
  const int slow = slow_.slow_count();
  const bool slide = slow <= FewHeld::kMost && slow < static_cast<int>(joint_at_.size());
  if (slide && Slide(d, rows)) return;
  Multiply(d, rows);
  if (complete_ && Hold(rows)) return;
  Search(d, rows);
}

/// Moves the bristles, and finds the joints that are so slow that theirs could stop them. That guess
/// decides which way is tried first, and nothing else.
void BristleTree::Stretch(const mjData* d, Rows rows) {
  const size_t size = side_.size();
  const double* inverse = d->qLDiagInv + inertia_.first();
  for (size_t k = 0; 2 * k < size; ++k) {
    const RowPair row = rows.pair(k);
    const Two impulse = impulse_ * row[kSpeed];
    row[kStretch] = row[kLoad] * row[kPerInertia] + impulse;
    const Two mobility{inverse[2 * k], 2 * k + 1 < size ? inverse[2 * k + 1] : 0};
    row[kSlack] = mobility * row[kUpper].max(row[kLower]) - impulse.abs();
  }
  slow_.Clear();
  for (const auto& [i, place] : joint_at_) {
    if (rows.at(place)[kSlack] >= 0) slow_.Add(i);
  }
  // a side that nothing asks for plays no part
  for (const auto& [i, place] : asking_) {
    known_[i] = 0;
    rows.at(place)[kUpper] = rows.at(place)[kLower] = 0;
  }
}

/// The level of a side; finds it out where it was not yet asked for.
double BristleTree::Ask(Row row, int i, int side) {
  double& level = row[side > 0 ? kUpper : kLower];
  const unsigned char bit = side > 0 ? 2 : 1;
  if (known_[i] & bit) [[likely]]
    return level;
  known_[i] |= bit;
  return level = std::max(0.0, levels_->LevelAt(first_ + static_cast<size_t>(i), side));
}

/// The forces of bristles that hold everything, without and with their dampers.
void BristleTree::Multiply(const mjData* d, Rows rows) {
  for (size_t k = 0; 2 * k < side_.size(); ++k) {
    const RowPair row = rows.pair(k);
    const Two stretch = row[kStretch], damped = stretch + damping_ * row[kSpeed];
    pair_[2 * k] = {stretch[0], damped[0]};
    pair_[2 * k + 1] = {stretch[1], damped[1]};
  }
  inertia_.Multiply(d, pair_.data(), force_.data());
}

/// Whether everything is held by forces within the levels.
bool BristleTree::Hold(Rows rows) {
  for (const auto& [i, place] : asking_) {
    for (const double force : force_[i]) Ask(rows.at(place), i, force < 0 ? -1 : 1);
  }
  Two beyond{0, 0};
  for (size_t k = 0; 2 * k < side_.size(); ++k) {
    const RowPair row = rows.pair(k);
    const Two one = force_[2 * k], other = force_[2 * k + 1];
    const Two elastic{one[0], other[0]}, friction{one[1], other[1]};
    const Two over = elastic.max(friction) - row[kUpper];
    beyond = beyond.max(over).max(-elastic.min(friction) - row[kLower]);
    row[kFriction] = friction;
    row[kLoad] = row[kStretch] * row[kInertia];
    row[kSliding] = Two::Zero();
  }
  return beyond[0] == 0 && beyond[1] == 0;
}

/// Whether all slide to the side of their stretch, but for the slow ones. Sliding, z' is where
/// the bristles carry their levels, and the damper is on the side of the motion.
bool BristleTree::Slide(const mjData* d, Rows rows) {
  for (const auto& [i, place] : joint_at_) {
    const Row row = rows.at(place);
    const int side = side_[i] = row[kStretch] < 0 ? -1 : 1;
    level_[i] = row[kFriction] = side * Ask(row, i, side);
  }
  slow_.Solve(inertia_, d, level_.data(), slip_.data());
  bool all = true;
  for (const auto& [i, place] : joint_at_) {
    const Row row = rows.at(place);
    const double bearing = slip_[i], slip = row[kStretch] - bearing, v = row[kSpeed];
    all = all & (side_[i] * slip >= 0) & (side_[i] * v >= 0);
    row[kLoad] = bearing * row[kInertia];
    row[kSliding] = v != 0;
    slip_[i] = slip;
  }
  return all || SlideButFew(rows);
}

/// The same where some of the slow ones would slide against their side, and are held.
bool BristleTree::SlideButFew(Rows rows) {
  if (slow_.Choose(side_.data(), slip_.data()) == 0) return false;
  for (int n = 0; n < slow_.count(); ++n) {
    const int k = slow_.held(n);
    Ask(rows.at(PlaceOf(static_cast<size_t>(k))), k, -side_[k]);
  }
  left_ = slip_;
  if (!slow_.Hold(rows, side_.data(), level_.data(), left_.data())) return false;

  // then the damper, from where the bristles are now
  for (const auto& [i, place] : joint_at_) {
    const Row row = rows.at(place);
    row[kLoad] = (row[kStretch] - left_[i]) * row[kInertia];
    row[kSliding] = side_[i] * row[kSpeed] > 0;
    left_[i] = slip_[i] - left_[i] + damping_ * row[kSpeed];
  }
  for (int n = 0; n < slow_.count(); ++n) {
    rows.at(PlaceOf(static_cast<size_t>(slow_.held(n))))[kSliding] = 0;
  }
  return slow_.Hold(rows, side_.data(), level_.data(), left_.data());
}

/// Both projections, from what is fast and what would be beyond its level if all were held.
void BristleTree::Search(const mjData* d, Rows rows) {
  for (const auto& [i, place] : asking_) {
    Ask(rows.at(place), i, 1);
    Ask(rows.at(place), i, -1);
  }
  BoxProjection& box = projection_;
  using Course = BoxProjection::Course;
  const double* inverse = d->qLDiagInv + inertia_.first();
  const size_t size = side_.size();
  for (size_t i = 0; i < size; ++i) {
    const Row row = rows.at(PlaceOf(i));
    const double upper = box.upper[i] = row[kUpper], lower = box.lower[i] = row[kLower];
    const double elastic = box.aim[i] = force_[i][0], impulse = impulse_ * row[kSpeed];
    Course& course = box.course[i] = Course::within;
    if (upper == 0 && lower == 0) {
      course = Course::free;
    } else if (impulse > inverse[i] * upper) {
      course = Course::at_upper;
    } else if (-impulse > inverse[i] * lower) {
      course = Course::at_lower;
    } else if (elastic > upper) {
      course = Course::at_upper;
    } else if (-elastic > lower) {
      course = Course::at_lower;
    }
  }
  box.Start(inertia_, d);
  box.Find(inertia_, d);
  for (const auto& [i, place] : joint_at_) {
    const Row row = rows.at(place);
    row[kLoad] = (row[kStretch] - box.slip[i]) * row[kInertia];
    const int side = box.course[i] == Course::free ? 0 : int{box.course[i]};
    row[kSliding] = side * row[kSpeed] > 0;
  }
  for (size_t i = 0; i < size; ++i) box.aim[i] = box.force[i] + (force_[i][1] - force_[i][0]);
  box.Find(inertia_, d);
  for (const auto& [i, place] : joint_at_) rows.at(place)[kFriction] = box.force[i];
}

}  // namespace warmjoint::inline sim
