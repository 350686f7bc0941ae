// Laws whose level falls with speed, as their fits see them.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>

#include "models/foundation/serialize.h"
#include "models/friction/laws.h"

namespace warmjoint {

/// What the fit of a law with the Stribeck effect knows of it beside its table. x begins with the l
/// parameters before stribeck_velocity, of which the force of steady sliding is linear; then comes
/// ln vs.
struct FallingLaw {
  const Law& law;
  const Law& without;           // the law that is left where nothing falls, its table a part of x
  std::string_view steady;      // the law of the same friction in steady sliding, exponent 2
  Eigen::VectorXd fall;         // [l] ks - kc = fall . x
  std::string_view fall_words;  // the same in words
  double (*coulomb)(const double* x);  // the smaller of its Coulomb levels, N.m or N
  double (*at_rest)(const double* x);  // level at rest, of both directions the mean, N.m or N
  /// Keeps the level at rest within so many times the smaller Coulomb level.
  void (*keep)(double* x, double least, double most);

  /// l, and where ln vs stands.
  Eigen::Index levels() const { return fall.size(); }
  /// The name of the parameter of x that tells the level at rest.
  std::string_view rest() const { return law.parameters[static_cast<size_t>(levels() - 1)].name; }
  /// ks - kc at x, N.m or N.
  double FallAt(const Eigen::VectorXd& x) const { return fall.dot(x.head(levels())); }
};

/// Laws that slide steadily at once, and those with a bristle; the first one is an option's default.
using SteadyFallingLaws = LawList<Stribeck, AsymmetricStribeck>;
using BristleFallingLaws = LawList<LuGre, AsymmetricLuGre>;

/// How many parameters stand before stribeck_velocity in the table of L.
template <typename L>
constexpr int LevelsOf() {
  int levels = 0;
  while (L::parameters[static_cast<size_t>(levels)].name != kStribeckVelocityRow.name) ++levels;
  return levels;
}

/// name: of one of the laws above.
const FallingLaw& FindFallingLaw(std::string_view name);

/// One law of a list, as an option names it.
template <typename List>
struct FallingLawOf;
template <typename First, typename... Rest>
struct FallingLawOf<LawList<First, Rest...>> {
  const FallingLaw* law = &FindFallingLaw(First::name);

  const FallingLaw& operator*() const { return *law; }
  bool operator==(const FallingLawOf&) const = default;
};
template <typename... All>
std::span<const Word<FallingLawOf<LawList<All...>>>> WordsOf(FallingLawOf<LawList<All...>>) {
  static const std::array words{
      Word<FallingLawOf<LawList<All...>>>{All::name, {&FindFallingLaw(All::name)}}...};
  return words;
}

}  // namespace warmjoint
