#include "sim/plugin/search_tree.h"

namespace warmjoint::inline sim {

using Course = BoxProjection::Course;

/// Takes over levels and forces, and what each row did at the last step.
void SearchTree::Take(Rows rows, const Two* force) {
  for (size_t i = 0; i < last_.size(); ++i) {
    const Row row = rows.row(static_cast<int>(i));
    const double upper = box_.upper[i] = row[kUpper], lower = box_.lower[i] = row[kLower];
    box_.aim[i] = force[i][0];
    const bool free = upper == 0 && lower == 0;
    box_.course[i] = free ? Course::free : last_[i] == Course::free ? Course::within : last_[i];
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
  last_ = box_.course;
  for (const int i : joints) {
    const Row row = rows.row(i);
    row[kLoad] = (row[kStretch] - box_.slip[i]) * row[kInertia];
    const int side = box_.course[i] == Course::free ? 0 : int{box_.course[i]};
    row[kSliding] = side * row[kSpeed] > 0;
  }

  // then the damper, from where the bristles are now
  for (int i = 0; i < inertia.size(); ++i) {
    box_.aim[i] = box_.force[i] + damping * force[i][1];
  }
  box_.Find(inertia, d);
  for (const int i : joints) rows.row(i)[kFriction] = box_.force[i];
}

}  // namespace warmjoint::inline sim
