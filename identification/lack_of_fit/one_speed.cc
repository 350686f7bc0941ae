#include "identification/lack_of_fit/one_speed.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace warmjoint {
namespace {

constexpr double kMoving = 0.05;  // of the largest speed: slower samples rest or turn
constexpr double kAlike = 0.02;

}  // namespace

std::optional<double> OneSpeed(const Measurements& m) {
  const double largest = m.velocity.cwiseAbs().maxCoeff();
  std::vector<double> speeds;
  for (const double v : m.velocity) {
    if (std::abs(v) > kMoving * largest) speeds.push_back(std::abs(v));
  }
  if (speeds.empty()) return std::nullopt;
  std::ranges::sort(speeds);
  const auto at = [&](double share) {
    return speeds[static_cast<std::size_t>(share * static_cast<double>(speeds.size() - 1))];
  };

  // all but the slowest and the fastest tenth must be alike
  const double middle = at(0.5);
  if (at(0.9) - at(0.1) > kAlike * middle) return std::nullopt;
  return middle;
}

}  // namespace warmjoint
