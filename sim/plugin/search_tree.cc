#include "sim/plugin/search_tree.h"

namespace warmjoint::inline sim {

using Course = BoxProjection::Course;

/// Begins with what is fast, and what would be beyond its level if all were held.
void SearchTree::Guess(const InertiaBlock& inertia, const mjData* d, Rows rows, const Two* force,
                       double impulse) {
  const double* inverse = d->qLDiagInv + inertia.first();
  for (int i = 0; i < inertia.size(); ++i) {
    const Row row = rows.row(i);
    const double upper = box_.upper[i] = row[kUpper], lower = box_.lower[i] = row[kLower];
    const double elastic = box_.aim[i] = force[i][0], push = impulse * row[kSpeed];
    Course& course = box_.course[i] = Course::within;
    if (upper == 0 && lower == 0) {
      course = Course::free;
    } else if (push > inverse[i] * upper) {
      course = Course::at_upper;
    } else if (-push > inverse[i] * lower) {
      course = Course::at_lower;
    } else if (elastic > upper) {
      course = Course::at_upper;
    } else if (-elastic > lower) {
      course = Course::at_lower;
    }
  }
}

void SearchTree::Find(InertiaBlock& inertia, const mjData* d, Rows rows, AskedLevels& levels,
                      const std::vector<int>& joints, const Two* force, const PerSpeed& per_speed) {
  for (const int i : levels.asking()) {
    levels.Of(i, 1);
    levels.Of(i, -1);
  }
  Guess(inertia, d, rows, force, per_speed.impulse);
  box_.Start(inertia, d);
  box_.Find(inertia, d);
  for (const int i : joints) {
    const Row row = rows.row(i);
    row[kLoad] = (row[kStretch] - box_.slip[i]) * row[kInertia];
    const int side = box_.course[i] == Course::free ? 0 : int{box_.course[i]};
    row[kSliding] = side * row[kSpeed] > 0;
  }

  // then the damper, from where the bristles are now
  for (int i = 0; i < inertia.size(); ++i) {
    box_.aim[i] = box_.force[i] + per_speed.damping * force[i][1];
  }
  box_.Find(inertia, d);
  for (const int i : joints) rows.row(i)[kFriction] = box_.force[i];
}

}  // namespace warmjoint::inline sim
