#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "identification/preparation/log_faults.h"
#include "identification/preparation/moving_view.h"
#include "identification/preparation/stretches.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kPlaces = 32;         // why: gravity changes by a few percent from one to the next
constexpr double kSpeedsAnOctave = 2;  // why: viscous friction changes by less than a half within
constexpr std::size_t kFewestSamples =
    5;  // of each direction in a cell; why: a median of fewer is an outlier
constexpr Index kFewestCells = 8;  // why: three quarters of fewer happen by chance
constexpr double kAgainst =
    0.9;  // of the cells; why: nothing but a sign makes friction push in so many
constexpr double kHalf = 0.25;  // of the cells; why: half of them by chance, give or take a quarter
constexpr double kOtherSign = 0.01;  // of the samples; why: abs() leaves none
constexpr double kAlike =
    0.25;  // of the mean; why: the friction of two directions differs by as much
constexpr double kFirstWord = 8;     // bits; why: no shorter words are logged
constexpr double kSamePower = 0.03;  // of the jump; why: friction takes as much of a word's range

/// Median torque at one place and speed, forwards and backwards.
struct Cell {
  double ahead = 0, back = 0;

  double Difference() const { return ahead - back; }
  double Mean() const { return 0.5 * (ahead + back); }
};

/// The cells with samples of both directions, by place and speed.
using Cells = std::map<std::pair<Index, Index>, Cell>;

Cells FindCells(const Measurements& m) {
  // the travel, without garbage at its ends
  VectorXd positions = m.position;
  const double low = QuantileInPlace(positions, 0.02);
  const double width = (QuantileInPlace(positions, 0.98) - low) / kPlaces;
  std::map<std::pair<Index, Index>, std::array<std::vector<double>, 2>> torques;
  for (const Stretch& one : FindStretches(m)) {
    const double speed = std::abs(one.change) / one.duration;
    const auto octave = static_cast<Index>(std::floor(kSpeedsAnOctave * std::log2(speed)));
    for (Index i = one.first; i < one.last; ++i) {
      const double place = (m.position[i] - low) / width;
      if (!(place >= 0 && place < kPlaces)) continue;
      torques[{static_cast<Index>(place), octave}][one.change > 0 ? 0 : 1].push_back(m.torque[i]);
    }
  }

  // medians, where there are enough
  Cells cells;
  for (const auto& [at, both] : torques) {
    if (std::min(both[0].size(), both[1].size()) < kFewestSamples) continue;
    cells[at] = {MedianOf(both[0]), MedianOf(both[1])};
  }
  return cells;
}

/// Whether speed changes the mean of both directions by more than their difference, in three places of four: friction is
/// in the difference, and gravity, which is in the mean, does not depend on speed.
bool MeanGrows(const Cells& cells) {
  double pairs = 0, grow = 0;
  for (auto slow = cells.begin(), fast = slow; slow != cells.end(); slow = fast) {
    if (++fast == cells.end() || fast->first.first != slow->first.first) continue;
    const double growth = std::abs(fast->second.Mean()) - std::abs(slow->second.Mean());
    ++pairs;
    grow += growth > std::abs(fast->second.Difference() - slow->second.Difference());
  }
  return grow > (1 - kHalf) * pairs;
}

/// The power of two, in steps, by which torque jumps with the direction: sizes that differ by a bit for the sign, or that
/// add up to it, as words read as unsigned do. 0 where there is none.
double PowerOfTwo(double step, double difference, double mean) {
  for (const double jump : {std::abs(difference), 2 * std::abs(mean)}) {
    const double bits = std::round(std::log2(jump / step)), power = std::exp2(bits);
    if (bits >= kFirstWord && std::abs(jump / step / power - 1) < kSamePower) return power;
  }
  return 0;
}

}  // namespace

std::optional<std::string> TorqueDirections(const Measurements& m, const Selection& selection) {
  const Cells cells = FindCells(m);
  const auto n = static_cast<Index>(cells.size());
  if (n < kFewestCells) return std::nullopt;
  VectorXd differences(n), means(n);
  for (Index k = 0; const auto& [at, cell] : cells) {
    differences[k] = cell.Difference();
    means[k++] = cell.Mean();
  }
  const auto share = [n](Index of) { return static_cast<double>(of) / static_cast<double>(n); };
  const double with = share((differences.array() > 0).count());
  const double against = share((differences.array() < 0).count());
  const double difference = MedianInPlace(differences), mean = MedianInPlace(means);

  // torque of one sign is a fault where friction would drive the joint, where the mean grows with speed, or where it is about
  // the difference
  const auto rarer = std::min((m.torque.array() > 0).count(), (m.torque.array() < 0).count());
  const bool one_sign = static_cast<double>(rarer) <= kOtherSign * static_cast<double>(m.size());
  const bool grows = one_sign && MeanGrows(cells);
  const double step = Resolution(m.torque), power = PowerOfTwo(step, difference, mean);
  const bool same = std::abs(2 * std::abs(mean) / std::abs(difference) - 1) < kSamePower;
  if (one_sign && power > 0 && (against > 1 - kHalf || grows || same)) {
    return fmt::format(
        "torque has one sign and jumps with the direction by {:.6g} {}, {:.0f} steps of its "
        "column: "
        "its words were read as unsigned, or hold the sign as a bit; give them their sign in the "
        "file",
        power * step, m.torque_unit, power);
  }
  if (against >= kAgainst) {
    return fmt::format(
        "torque is less forwards than backwards in {:.0f} % of {} places and speeds, while "
        "friction resists "
        "motion: the torque column has the opposite sign (--scale torque=-1 turns it)",
        100 * against, n);
  }
  // without holds inertia makes differences of either sign
  const bool by_chance = with < 1 - kHalf && against < 1 - kHalf && HoldsSpeeds(m, selection);
  const bool alike = std::abs(difference) < kAlike * std::abs(mean);
  if (!one_sign || !alike || !(grows || by_chance)) return std::nullopt;
  return fmt::format(
      "torque lost its sign: it has one sign, and both directions agree in size at the same place "
      "and speed ({:.4g} {} in the median of {}, {:.2g} {} apart); log it with its sign",
      std::abs(mean), m.torque_unit, n, std::abs(difference), m.torque_unit);
}

}  // namespace warmjoint
