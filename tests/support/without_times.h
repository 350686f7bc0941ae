// Recordings of which parts are missing.
#pragma once

#include <algorithm>
#include <vector>

#include "models/recording/measurements.h"

namespace warmjoint::test {

/// A time that is missing.
struct Cut {
  double from = 0, to = 0;  // s
};

/// The recording without the samples that lie inside of a cut.
inline Measurements Without(const Measurements& m, const std::vector<Cut>& cuts) {
  std::vector<Eigen::Index> left;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const auto inside = [t = m.time[i]](const Cut& cut) { return cut.from < t && t < cut.to; };
    if (std::none_of(cuts.begin(), cuts.end(), inside)) left.push_back(i);
  }
  Measurements some = m;
  ForEachColumn(some, [&](Eigen::VectorXd& column) { column = column(left).eval(); });
  return some;
}

}  // namespace warmjoint::test
