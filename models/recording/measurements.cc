#include "models/recording/measurements.h"

#include <algorithm>

namespace warmjoint::inline models {

Measurements FirstSamples(Measurements log, Eigen::Index n) {
  ForEachColumn(
      log, [n](Eigen::VectorXd& column) { column.conservativeResize(std::min(n, column.size())); });
  std::erase_if(log.starts, [n](Eigen::Index start) { return start >= n; });
  if (log.gaps) std::erase_if(*log.gaps, [n](const LogGap& gap) { return gap.behind >= n; });
  return log;
}

}  // namespace warmjoint::inline models
