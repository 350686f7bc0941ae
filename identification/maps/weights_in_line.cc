#include "identification/maps/weights_in_line.h"

#include <algorithm>
#include <cmath>

#include "identification/maps/kernel_lines.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// Of the weights of one line. [n x n]
Eigen::MatrixXd CorrelationOf(const KernelLines& lines, double length) {
  const auto n = static_cast<Index>(lines.length);
  Eigen::MatrixXd smear(n, n);
  // smeared with the distance in kernels, around the circle where there is one
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Index apart = std::abs(i - j);
      const auto away = static_cast<double>(lines.circular ? std::min(apart, n - apart) : apart);
      smear(i, j) = std::exp(-away * away / (length * length));
    }
  }
  // rows of norm 1 give a correlation of 1 with itself
  smear.rowwise().normalize();
  return smear * smear.transpose();
}

}  // namespace

Eigen::MatrixXd CorrelationInLines(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, double length) {
  const auto q = static_cast<Index>(unseen.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(q, q);
  Index first = 0;
  for (const FrictionMap& map : maps) {
    const KernelLines lines(map);
    const auto stride = static_cast<Index>(lines.stride), size = static_cast<Index>(map.size());
    const Eigen::MatrixXd line = CorrelationOf(lines, length);
    // kernels of one line lie a stride apart
    for (Index k = 0; k < stride; ++k) {
      const auto of_line = Eigen::seq(first + k, first + size - stride + k, stride);
      all(of_line, of_line) = line;
    }
    first += size;
  }
  // weights with data alone
  std::vector<Index> seen;
  for (Index k = 0; k < q; ++k) {
    if (!unseen[static_cast<size_t>(k)]) seen.push_back(k);
  }
  return all(seen, seen);
}

}  // namespace warmjoint
