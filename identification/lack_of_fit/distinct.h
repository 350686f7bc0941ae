// Which of a few different numbers each of many is.
#pragma once

#include <Eigen/Core>
#include <unordered_map>
#include <vector>

namespace warmjoint::inline identification {

/// The different ones among some numbers, so that what depends on them alone is computed once for each.
struct Distinct {
  std::vector<double> numbers;      // [n] in the order in which they come first
  std::vector<Eigen::Index> place;  // [m] of each, in `numbers`

  explicit Distinct(const Eigen::VectorXd& all) {
    place.reserve(static_cast<size_t>(all.size()));
    std::unordered_map<double, Eigen::Index> places;
    for (const double number : all) {
      // numbers that repeat mostly do so in the same order
      const auto next = static_cast<size_t>(place.empty() ? 0 : place.back() + 1);
      if (next < numbers.size() && numbers[next] == number) {
        place.push_back(static_cast<Eigen::Index>(next));
        continue;
      }
      const auto count = static_cast<Eigen::Index>(numbers.size());
      const auto [at, is_new] = places.try_emplace(number, count);
      if (is_new) numbers.push_back(number);
      place.push_back(at->second);
    }
  }

  /// [n]
  Eigen::Map<const Eigen::ArrayXd> values() const {
    return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
  }
};

}  // namespace warmjoint::inline identification
