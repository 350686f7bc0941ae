#include "tools/report/run/quartiles.h"

#include <fmt/core.h>

#include <vector>

#include "tools/board/statistics.h"

namespace warmjoint::report {

std::string MediansSubtitle(const std::string& suite, int realizations) {
  return fmt::format(
      "{}: {} realization{}; lines are medians, bands reach from quartile to quartile", suite,
      realizations, realizations == 1 ? "" : "s");
}

QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values) {
  const Eigen::Index columns = values.cols();
  QuartileCurve curve{x, Eigen::VectorXd(columns), Eigen::VectorXd(columns),
                      Eigen::VectorXd(columns)};
  for (Eigen::Index k = 0; k < columns; ++k) {
    const Eigen::VectorXd column = values.col(k);
    const Summary summary = Summarise({column.begin(), column.end()});
    curve.q25[k] = summary.q25;
    curve.median[k] = summary.median;
    curve.q75[k] = summary.q75;
  }
  return curve;
}

}  // namespace warmjoint::report
