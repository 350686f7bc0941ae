#include "sim/plugin/box_projection.h"

#include <algorithm>

namespace warmjoint::inline sim {
namespace {

/// How far a force may be beyond its bound by rounding.
constexpr double kRounding = 1e-13;

/// Projections end long before; one that does not, for numbers without bound, is left.
constexpr int kMostTurns = 200;

/// Turns in which no fewer are wrong, before one at a time is turned.
constexpr int kPatience = 6;

}  // namespace

BoxProjection::BoxProjection(int size) {
  const auto n = static_cast<size_t>(size);
  course.assign(n, within);
  slips_.assign(n, 0);
  for (std::vector<double>* numbers : {&lower, &upper, &aim, &force, &slip}) numbers->assign(n, 0);
}

void BoxProjection::Start(InertiaBlock& inertia, const mjData* d) {
  for (size_t i = 0; i < course.size(); ++i) slips_[i] = course[i] != within;
  inertia.Factorise(d, slips_);
}

void BoxProjection::Find(InertiaBlock& inertia, const mjData* d) {
  const size_t size = course.size();
  int best = kMostTurns, patience = kPatience;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    // forces of those that hold follow from the slips of those at their bounds
    for (size_t i = 0; i < size; ++i) slip[i] = course[i] == within ? 0 : aim[i] - Bound(i);
    inertia.SolveBlock(slip.data());
    force = aim;
    inertia.Subtract(d, slip.data(), force.data());

    // until nothing is wrong; one at a time where all at once does not get nearer
    const int wrong = Count();
    if (wrong == 0) break;
    if (wrong < best) patience = kPatience + 1;
    best = std::min(best, wrong);
    Turn(patience-- > 0);
    Start(inertia, d);
  }
  // to the last digit
  for (size_t i = 0; i < size; ++i) {
    force[i] = course[i] == within ? std::clamp(force[i], -lower[i], upper[i]) : Bound(i);
  }
}

double BoxProjection::Bound(size_t i) const {
  if (course[i] == at_upper) return upper[i];
  return course[i] == at_lower ? -lower[i] : 0;
}

/// The course that a degree of freedom should have, after this slip and force.
BoxProjection::Course BoxProjection::Better(size_t i) const {
  if (course[i] == free) return free;
  if (course[i] != within) return int{course[i]} * slip[i] < 0 ? within : course[i];
  if (force[i] > (1 + kRounding) * upper[i]) return at_upper;
  return -force[i] > (1 + kRounding) * lower[i] ? at_lower : within;
}

int BoxProjection::Count() const {
  int wrong = 0;
  for (size_t i = 0; i < course.size(); ++i) wrong += Better(i) != course[i];
  return wrong;
}

void BoxProjection::Turn(bool all) {
  for (size_t i = course.size(); i-- > 0;) {
    const Course better = Better(i);
    if (better == course[i]) continue;
    course[i] = better;
    if (!all) return;
  }
}

}  // namespace warmjoint::inline sim
