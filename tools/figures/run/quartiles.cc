#include "tools/figures/run/quartiles.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "models/foundation/robust_noise.h"

namespace warmjoint::figures {

double RootMeanSquare(const Eigen::VectorXd& values) {
  const auto finite = values.array().isFinite();
  return std::sqrt(finite.select(values.array().square(), 0).sum() /
                   static_cast<double>(finite.count()));
}

QuartileCurve QuartilesOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& values) {
  const Eigen::Index columns = values.cols();
  QuartileCurve curve{x, Eigen::VectorXd(columns), Eigen::VectorXd(columns),
                      Eigen::VectorXd(columns)};
  for (Eigen::Index k = 0; k < columns; ++k) {
    // of each column only what is known
    std::vector<double> known;
    for (const double value : values.col(k)) {
      if (!std::isnan(value)) known.push_back(value);
    }
    std::sort(known.begin(), known.end());
    curve.q25[k] = Quantile(known, 0.25);
    curve.median[k] = Quantile(known, 0.5);
    curve.q75[k] = Quantile(known, 0.75);
  }
  return curve;
}

double MedianOf(const Eigen::VectorXd& values) {
  return QuartilesOf(Eigen::VectorXd::Zero(1), values).median[0];
}

std::vector<double> SortedFinite(const Eigen::VectorXd& values) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double value) { return std::isfinite(value); });
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace warmjoint::figures
