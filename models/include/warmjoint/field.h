// What is known of a struct's member besides its name and type; serialize.h reads and writes by it.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace warmjoint {

class Node;  // a value of a file (models/foundation/node.h)

/// What a number must satisfy besides being finite.
struct Bounds {
  double at_least = -std::numeric_limits<double>::infinity();
  double above = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();

  bool Hold(double value) const {
    return value >= at_least && value > above && value <= at_most && value < below;
  }
  /// "a number above 0 and below 1", "a finite number".
  std::string Words() const;
};

/// What is written of a member that is absent, empty or at the default of its type: where it is absent nothing and else its
/// value; nothing; null.
enum class AtDefault { written, left_out, null };

/// What is known of a member besides its name and type.
struct FieldInfo {
  std::string_view unit{};  // of a rotary joint
  Bounds bounds{};
  std::string_view meaning{};
  std::string_view needed{};  // where it must be given: the remedy, "give the seconds of a rest"
  AtDefault at_default = AtDefault::written;
};

/// The remedy where a number is missing.
inline constexpr std::string_view kGiveNumber = "give a number";

inline constexpr Bounds kPositive{.above = 0}, kNotNegative{.at_least = 0};

/// A number that must be given.
constexpr FieldInfo Needed(std::string_view unit, std::string_view meaning, Bounds bounds = {},
                           std::string_view remedy = kGiveNumber) {
  return {.unit = unit, .bounds = bounds, .meaning = meaning, .needed = remedy};
}
/// A number that keeps its default where it is not given.
constexpr FieldInfo WithDefault(std::string_view unit, std::string_view meaning,
                                Bounds bounds = {}) {
  return {.unit = unit, .bounds = bounds, .meaning = meaning};
}
/// What is not written at its default.
constexpr FieldInfo LeftOut(std::string_view meaning) {
  return {.meaning = meaning, .at_default = AtDefault::left_out};
}
/// What is null at its default.
constexpr FieldInfo OrNull(std::string_view meaning) {
  return {.meaning = meaning, .at_default = AtDefault::null};
}

/// The word of a file for a choice. An enum E that is read or written has a function
///   std::span<const Word<E>> WordsOf(E);
template <typename E>
struct Word {
  std::string_view name;
  E value;
};

/// A deduced string literal is a name.
template <typename E>
Word(const char*, E) -> Word<E>;

/// The word of a choice.
template <typename E>
std::string_view NameOf(E value) {
  for (const Word<E>& word : WordsOf(value)) {
    if (word.value == value) return word.name;
  }
  return "";
}

}  // namespace warmjoint
