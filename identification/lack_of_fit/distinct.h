// Which of a few different numbers each of many is.
#pragma once

#include <Eigen/Core>
#include <unordered_map>
#include <vector>

namespace warmjoint {

/// The different ones among some numbers, so that what depends on them alone is computed once for each.
struct Distinct {
  std::vector<double> numbers;      // [n] in the order in which they come first
  std::vector<Eigen::Index> place;  // [m] of each, in `numbers`

  explicit Distinct(const Eigen::VectorXd& all) {
    place.resize(static_cast<size_t>(all.size()));
    std::unordered_map<double, size_t> places;
    size_t next = 0;
    for (Eigen::Index i = 0; i < all.size(); ++i) {
      // numbers that repeat mostly do so in the same order
      if (next >= numbers.size() || numbers[next] != all[i]) {
        const auto [at, is_new] = places.try_emplace(all[i], numbers.size());
        if (is_new) numbers.push_back(all[i]);
        next = at->second;
      }
      place[static_cast<size_t>(i)] = static_cast<Eigen::Index>(next++);
    }
  }

  /// [n]
  Eigen::Map<const Eigen::ArrayXd> values() const {
    return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
  }
};

}  // namespace warmjoint
