#include "models/friction/level_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace warmjoint {
namespace {

/// A speed that is on its side of 0 and changes nothing else.
constexpr double kStill = std::numeric_limits<double>::min();

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
  const bool is_speed = quantity == MapQuantity::velocity;
  const MapAxis* const axis = FindAxis(map, quantity);
  if (!axis) return is_speed ? std::vector<double>{0, 1} : std::vector<double>{0};
  const GaussianAxis& kernels = axis->kernels;
  if (!is_speed) return kernels.centres;
  // speeds from 0 to some widths beyond the outermost centre
  const double reach = 3 * kernels.width + std::max(std::abs(kernels.centres.front()),
                                                    std::abs(kernels.centres.back()));
  const int count = static_cast<int>(std::min(500.0, std::ceil(4 * reach / kernels.width)));
  std::vector<double> speeds;
  for (int i = 0; i <= count; ++i) speeds.push_back(reach * i / count);
  return speeds;
}

double SurveyWork(const FrictionMap& map) {
  double samples = 2, kernels = 1, longest = 1;
  // samples of all quantities, in both directions
  for (const auto& [name, quantity] : WordsOf(MapQuantity{})) {
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

bool NeedsLoad(const Friction& friction) {
  return friction.load_gain != 0 || std::ranges::any_of(friction.maps, [](const FrictionMap& map) {
           return FindAxis(map, MapQuantity::load) != nullptr;
         });
}

LevelTerms::LevelTerms(const Friction& friction) : gear_(friction.gear) {
  for (const FrictionMap& map : friction.maps) maps_.emplace_back(map);
  Survey(friction);
}

double LevelTerms::At(int side, double speed, const JointPlace& place) const {
  constexpr double turn = 2 * std::numbers::pi;
  const double motor = place.motor_position.value_or(gear_ * place.position);
  const MapPoint<double> point{place.position, motor - turn * std::floor(motor * (1 / turn)),
                               side * std::max(speed, kStill), place.energy, place.load};
  double sum = 0;
  for (const PreparedMap& map : maps_) sum += map.Value(point);
  return side * sum;
}

void LevelTerms::Survey(const Friction& friction) {
  for (size_t i = 0; i < maps_.size(); ++i) {
    const FrictionMap& map = friction.maps[i];
    const auto samples = [&](MapQuantity quantity) { return SurveySamples(map, quantity); };
    const std::vector<double> speeds = samples(MapQuantity::velocity);
    // along the speed at one place: the largest value at rest and the steepest rise
    double slope = 0, at_rest = 0;
    const auto along_speed = [&](MapPoint<double> point, int side) {
      double before = 0;
      for (size_t k = 0; k < speeds.size(); ++k) {
        point[static_cast<size_t>(MapQuantity::velocity)] = side * std::max(speeds[k], kStill);
        const double value = side * maps_[i].Value(point);
        if (k == 0) at_rest = std::max(at_rest, value);
        if (k > 0) slope = std::max(slope, (value - before) / (speeds[k] - speeds[k - 1]));
        before = value;
      }
    };

    // at all centres of the other axes, in both directions
    for (const double position : samples(MapQuantity::position)) {
      for (const double motor : samples(MapQuantity::motor_position)) {
        for (const double energy : samples(MapQuantity::energy)) {
          for (const double load : samples(MapQuantity::load)) {
            along_speed({position, motor, 0, energy, load}, 1);
            along_speed({position, motor, 0, energy, load}, -1);
          }
        }
      }
    }
    // maps that act together are bounded by the sum of their bounds
    steepest_slope_ += slope;
    largest_at_rest_ += at_rest;
  }
}

}  // namespace warmjoint
