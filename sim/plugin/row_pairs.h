// The numbers of friction in a step, two degrees of freedom side by side.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <algorithm>
#include <cstring>
#include <vector>

namespace warmjoint {

/// Two neighbours, which a processor steps at once.
using Two = Eigen::Array2d;

/// Side by side, `negative` where x is below 0, and `other` elsewhere; without a branch.
inline Two WhereNegative(const Two& x, const Two& negative, const Two& other) {
  using Lanes = double __attribute__((vector_size(sizeof(Two))));
  const auto lanes = [](const Two& two) {
    Lanes copy;
    std::memcpy(&copy, two.data(), sizeof copy);
    return copy;
  };
  const Lanes chosen = lanes(x) < 0.0 ? lanes(negative) : lanes(other);
  Two two;
  std::memcpy(two.data(), &chosen, sizeof chosen);
  return two;
}

/// Whether both are at least 0.
inline bool NoneNegative(const Two& x) { return x[0] >= 0 && x[1] >= 0; }

/// What a step takes and finds of a row: a degree of freedom of a kinematic tree on which joints with
/// friction are, or a joint by itself. Rows without friction hold zeros.
enum Column : int {
  // numbers of the joint's friction (JointFriction)
  kUpperAtRest,  // the law's own levels, N.m or N
  kLowerAtRest,
  kPole,  // of the heat's first stage (Heat)
  kGain,
  kInertia,  // of the bristle at the reference pose, kg.m^2 or kg, and 1 over it
  kPerInertia,
  kAbsent,  // 0 where a joint has coupled bristles, 1 elsewhere

  // with which a step begins
  kSpeed,  // rad/s or m/s
  kLoad,   // of the bristle, N.m or N; then the next one
  kFirst,  // E1 and E2, N.m or N
  kSecond,

  // what it finds
  kUpper,  // L+ and L-, not negative, N.m or N; where a row asks for them, roughly at first
  kLower,
  kOwnSlope,  // of the plugin's force over speed: what is left of the whole one, which is not negative, without
              // the joint's damping; found with the numbers where heat leaves it
  kStretch,    // A/h^2 (z + h v), rad/s^2 or m/s^2
  kFriction,   // f, N.m or N
  kSliding,    // 1 where the bristle has yielded in the direction of motion, or 0
  kForce,      // F without what the joint's damping adds, N.m or N
  kLoss,       // W, W
  kNextFirst,  // E1'

  kDamping,  // of the joint, which is friction's

  // what few joints have: kv and b, where heat changes the slope, an ambient, and a second stage
  kViscous,
  kPerEnergy,
  kRise,        // of the ambient, K
  kNextSecond,  // E2'
  kColumns,
};

/// The numbers of one row, of which its neighbour's lie between.
struct Row {
  double* numbers;
  double& operator[](Column column) const { return numbers[2 * column]; }
};

/// Two rows.
struct RowPair {
  double* numbers;
  Eigen::Map<Two, Eigen::Aligned16> operator[](Column column) const {
    return Eigen::Map<Two, Eigen::Aligned16>(numbers + 2 * column);
  }
};

/// Where a row lies in the numbers of all.
inline size_t PlaceOf(size_t row) { return row / 2 * 2 * kColumns + row % 2; }

/// The numbers of so many rows, a whole number of pairs.
inline size_t NumbersOf(size_t rows) { return (rows + 1) / 2 * 2 * kColumns; }

/// Rows from one on, which is the first of a pair.
struct Rows {
  double* numbers;
  Row row(int i) const { return {numbers + PlaceOf(static_cast<size_t>(i))}; }
  RowPair pair(size_t k) const { return {numbers + k * 2 * kColumns}; }
};

/// Storage of rows.
using RowNumbers = std::vector<double, Eigen::aligned_allocator<double>>;

/// Tells the levels of rows that ask for theirs.
class LevelSource {
 public:
  virtual ~LevelSource() = default;
  /// L+ for side 1 and L- for side -1, N.m or N; a level below 0 counts as 0.
  virtual double LevelAt(size_t row, int side) const = 0;
};

/// The levels kUpper and kLower of the rows of one tree: of most known at the beginning of a step, of
/// those that ask only from the moment on when somebody needs that side.
class AskedLevels {
 public:
  AskedLevels() = default;
  /// size: of the tree; asking: its rows that ask.
  AskedLevels(size_t size, std::vector<int> asking) : asking_(std::move(asking)) {
    known_.assign(size, kBoth);
  }

  const std::vector<int>& asking() const { return asking_; }

  /// Begins a step: nothing is known of those that ask, and a side that nothing asks for is 0. first:
  /// the tree's first row, of those of the source.
  void Begin(const LevelSource& source, size_t first, Rows rows) {
    source_ = &source;
    first_ = first;
    rows_ = rows;
    for (const int i : asking_) {
      known_[static_cast<size_t>(i)] = 0;
      const Row row = rows_.row(i);
      row[kUpper] = row[kLower] = 0;
    }
  }

  /// The level of a side; finds it out where it was not yet asked for.
  double Of(int i, int side) {
    double& level = rows_.row(i)[side > 0 ? kUpper : kLower];
    unsigned char& known = known_[static_cast<size_t>(i)];
    const unsigned char bit = side > 0 ? 2 : 1;
    if (known & bit) [[likely]]
      return level;
    known |= bit;
    return level = std::max(0.0, source_->LevelAt(first_ + static_cast<size_t>(i), side));
  }

 private:
  static constexpr unsigned char kBoth = 3;

  std::vector<int> asking_;
  std::vector<unsigned char> known_;  // sides whose level is known: 1 below, 2 above
  const LevelSource* source_ = nullptr;
  size_t first_ = 0;
  Rows rows_{nullptr};
};

}  // namespace warmjoint
