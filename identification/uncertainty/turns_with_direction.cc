#include "identification/uncertainty/turns_with_direction.h"

#include <cmath>

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kSure = 3;                       // deviations; why 3: by chance once in 740
constexpr double kFewestChanges = kSure * kSure;  // of which all turning is as sure

}  // namespace

std::optional<bool> TurnsWithDirection(const Eigen::VectorXd& residual,
                                       const Eigen::VectorXd& velocity) {
  double changes = -1, turns = 0, before = 0;
  for (Index first = 0, last; first < residual.size(); first = last) {
    const bool forwards = velocity[first] > 0;
    last = first;
    while (last < residual.size() && (velocity[last] > 0) == forwards) ++last;
    // mean residual of a stretch in one direction, and whether it turned
    const double mean = residual.segment(first, last - first).mean();
    turns += before * mean < 0 ? 1 : 0;
    changes += 1;
    before = mean;
  }
  if (changes < kFewestChanges) return std::nullopt;
  // by chance half of the changes turn it, give or take sqrt(changes) / 2
  return turns - changes / 2 > kSure * std::sqrt(changes) / 2;
}

}  // namespace warmjoint
