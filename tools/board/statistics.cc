#include "tools/board/statistics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace warmjoint::inline tools {
namespace {

/// Numbers that are sorted in memory, 512 KiB of them.
constexpr std::size_t kHeld = 65536;

/// Bits of a key by which numbers are told apart in one pass.
constexpr int kDigit = 16;

/// A key that orders as the numbers do (IEEE 754): negative ones have all bits flipped.
std::uint64_t KeyOf(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

/// The quantile of `count` numbers of which at(i) is the one at place i in ascending order.
template <typename At>
double QuantileBy(const At& at, std::size_t count, double share) {
  // between two neighbours in proportion; no difference of infinities is taken
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  const double position = share * static_cast<double>(count - 1);
  const auto below = static_cast<std::size_t>(position);
  const double beyond = position - static_cast<double>(below);
  const double lower = at(below);
  if (beyond == 0) return lower;
  const double upper = at(below + 1);
  return lower == upper ? lower : lower + beyond * (upper - lower);  // may be infinite
}

}  // namespace

Ascending::Ascending(const NumberColumn& column) : column_(column) {
  column.ForEach([&](double value) { size_ += !std::isnan(value); });
  if (size_ > kHeld) return;
  column.ForEach([&](double value) {
    if (!std::isnan(value)) sorted_.push_back(value);
  });
  std::sort(sorted_.begin(), sorted_.end());
}

double Ascending::operator[](std::size_t position) const {
  if (size_ <= kHeld) return sorted_[position];

  // radix selection: of the numbers whose key begins with `prefix`, the one at `position` is looked for
  std::uint64_t prefix = 0;
  std::size_t among = size_;
  for (int left = 64; left > 0; left -= kDigit) {
    const auto fits = [&](std::uint64_t key) { return left == 64 || key >> left == prefix; };
    // few enough: they are sorted
    if (among <= kHeld) {
      std::vector<double> few;
      column_.ForEach([&](double value) {
        if (!std::isnan(value) && fits(KeyOf(value))) few.push_back(value);
      });
      const auto place = few.begin() + static_cast<std::ptrdiff_t>(position);
      std::nth_element(few.begin(), place, few.end());
      return *place;
    }
    // the next digit is that at which the count reaches the position
    std::vector<std::size_t> counts(std::size_t{1} << kDigit);
    column_.ForEach([&](double value) {
      const std::uint64_t key = KeyOf(value);
      if (!std::isnan(value) && fits(key)) ++counts[(key >> (left - kDigit)) & (counts.size() - 1)];
    });
    std::size_t digit = 0;
    while (position >= counts[digit]) position -= counts[digit++];
    among = counts[digit];
    prefix = prefix << kDigit | digit;
  }

  // all that are left are equal
  const std::uint64_t bits = prefix >> 63 ? prefix & ~(std::uint64_t{1} << 63) : ~prefix;
  return std::bit_cast<double>(bits);
}

double Ascending::Quantile(double share) const {
  return QuantileBy([&](std::size_t i) { return (*this)[i]; }, size_, share);
}

double Quantile(const std::vector<double>& sorted, double share) {
  return QuantileBy([&](std::size_t i) { return sorted[i]; }, sorted.size(), share);
}

Summary Summarise(const NumberColumn& values) {
  // NaN is what a run does not know: neither place nor square
  const Ascending ascending(values);
  double squares = 0;
  values.ForEach([&](double value) {
    if (!std::isnan(value)) squares += value * value;
  });
  return {ascending.Quantile(0.5), ascending.Quantile(0.25), ascending.Quantile(0.75),
          std::sqrt(squares / static_cast<double>(ascending.size()))};
}

}  // namespace warmjoint::inline tools
