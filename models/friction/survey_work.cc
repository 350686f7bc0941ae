#include "models/friction/survey_work.h"

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

/// The most kernels of an axis that lie within reach of one point.
size_t WithinReach(const GaussianAxis& axis) {
  constexpr double reach = 7.6;  // widths to each side, as in PreparedAxis
  const std::vector<double>& centres = axis.centres;
  size_t most = 0;
  for (size_t first = 0, last = 0; last < centres.size(); ++last) {
    while (centres[last] - centres[first] > 2 * reach * axis.width) ++first;
    most = std::max(most, last - first + 1);
  }
  return most;
}

}  // namespace

std::vector<double> SurveySamples(const FrictionMap& map, MapQuantity quantity) {
  for (const MapAxis& axis : map.axes) {
    if (axis.quantity != quantity) continue;
    const GaussianAxis& kernels = axis.kernels;
    if (quantity != MapQuantity::velocity) return kernels.centres;
    // speeds from 0 to some widths beyond the outermost centre
    const double reach = 3 * kernels.width + std::max(std::abs(kernels.centres.front()),
                                                      std::abs(kernels.centres.back()));
    const int count = static_cast<int>(std::min(500.0, std::ceil(4 * reach / kernels.width)));
    std::vector<double> speeds;
    for (int i = 0; i <= count; ++i) speeds.push_back(reach * i / count);
    return speeds;
  }
  if (quantity == MapQuantity::velocity) return {0, 1};
  return {0};
}

double SurveyWork(const FrictionMap& map) {
  double samples = 2, kernels = 1, longest = 1;
  // samples of all quantities, in both directions
  for (const MapQuantity quantity :
       {MapQuantity::position, MapQuantity::motor_position, MapQuantity::velocity,
        MapQuantity::energy, MapQuantity::load}) {
    samples *= static_cast<double>(SurveySamples(map, quantity).size());
  }

  // kernels that count at one of them
  for (const MapAxis& axis : map.axes) {
    const auto within = static_cast<double>(WithinReach(axis.kernels));
    kernels *= within;
    longest = std::max(longest, within);
  }
  return samples * kernels / longest;
}

}  // namespace warmjoint
