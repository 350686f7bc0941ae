#include "identification/preparation/share_acceleration.h"

#include <algorithm>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr size_t kFewestRamps = 5;        // that tell the acceleration of others
constexpr double kOneAcceleration = 0.1;  // median deviation, of the acceleration

/// The median acceleration of the ramps that show; nothing where they are few or differ.
std::optional<double> OneAcceleration(const std::vector<std::optional<SpeedChange>>& changes) {
  std::vector<double> shown;
  for (const auto& change : changes) {
    if (change && change->duration > 0) shown.push_back(change->Leap() / change->duration);
  }
  if (shown.size() < kFewestRamps) return std::nullopt;

  // how far they lie from it
  using Column = Eigen::Map<const Eigen::VectorXd>;
  Eigen::VectorXd all = Column(shown.data(), static_cast<Eigen::Index>(shown.size()));
  const double acceleration = MedianInPlace(all);
  all = (all.array() - acceleration).abs();
  if (MedianInPlace(all) > kOneAcceleration * acceleration) return std::nullopt;
  return acceleration;
}

}  // namespace

void ShareAcceleration(const Eigen::VectorXd& time,
                       std::vector<std::optional<SpeedChange>>& changes) {
  const auto acceleration = OneAcceleration(changes);
  if (!acceleration) return;
  const double *const begin = time.data(), *const end = begin + time.size();
  for (auto& change : changes) {
    if (!change || change->duration > 0) continue;
    // twice the way to the nearest sample at most
    const double* const behind = std::upper_bound(begin, end, change->time);
    if (behind == begin || behind == end) continue;
    const double nearest = std::min(*behind - change->time, change->time - *(behind - 1));
    change->duration = std::min(change->Leap() / *acceleration, 2 * nearest);
  }
}

}  // namespace warmjoint
