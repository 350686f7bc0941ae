// Laws whose level falls with speed, in the form that their fits use.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/layout.h"
#include "models/foundation/serialize.h"
#include "models/friction/laws.h"

namespace warmjoint {

/// What the fit of a law with the Stribeck effect knows of it in addition to its table. Its levels, p, are the l
/// parameters before stribeck_velocity, of which the force of steady sliding is linear.
struct FallingLaw {
  const Law& law;
  const Law& without;           // the law that is left without the fall, whose table is a part of x
  std::string_view steady;      // the law of the same friction in steady sliding, exponent 2
  Layout (*layout)(bool heat);  // LayoutOf it
  /// The values of its table at x of such a layout. exponent: of a law that has one
  Eigen::VectorXd (*values)(const Eigen::VectorXd& x, double exponent);
  Eigen::VectorXd fall;                // [l] ks - kc = fall . p, N.m or N
  std::string_view fall_words;         // the same in words
  double (*coulomb)(const double* p);  // the smaller of its Coulomb levels, N.m or N
  double (*at_rest)(const double* p);  // level at rest, of both directions the mean, N.m or N
  /// Keeps the level at rest within so many times the smaller Coulomb level.
  void (*keep)(double* p, double least, double most);

  Eigen::Index levels() const { return fall.size(); }  // l
  /// The name of the last of them, which determines the level at rest.
  std::string_view rest() const { return law.parameters[static_cast<size_t>(levels() - 1)].name; }
};

/// Laws that slide steadily at once, and those with a bristle; the first one is an option's default.
using SteadyFallingLaws = LawList<Stribeck, AsymmetricStribeck>;
using BristleFallingLaws = LawList<LuGre, AsymmetricLuGre>;

/// The places of the unknowns of a fit of L: law and shape as in its table, of which an exponent is given;
/// the heat where it is fitted; the inertia where a bristle needs samples that accelerate.
template <typename L>
constexpr Layout LayoutOf(bool heat = false) {
  constexpr bool bristle = LawWithBristle<L>;
  Eigen::Index levels = 0;
  while (L::parameters[levels].name != kStribeckVelocityRow.name) ++levels;
  return Layout::InOrder({{&Layout::law, levels},
                          {&Layout::shape, bristle ? 3 : 1},
                          {&Layout::heat, heat ? 2 : 0},
                          {&Layout::rigid, bristle ? 1 : 0}});
}

/// The values of L's table at x. exponent: of a law that has one
template <typename L, typename T>
std::array<T, L::parameters.size()> ValuesOf(const T* x, double exponent = 2) {
  using std::exp;
  constexpr Layout at = LayoutOf<L>();
  std::array<T, L::parameters.size()> values;
  std::copy_n(x, at.shape.end(), values.begin());
  // some are in x by their logarithms
  values[at.log_vs()] = exp(x[at.log_vs()]);
  if constexpr (LawWithBristle<L>) {
    values[at.log_stiffness()] = exp(x[at.log_stiffness()]);
  } else {
    values[at.shape.end()] = T(exponent);
  }
  return values;
}

/// name: of one of the laws above.
const FallingLaw& FindFallingLaw(std::string_view name);

/// The best first.
std::vector<FitPoint> BestFirst(std::vector<FitPoint> points);

/// The best of `best` and the fits that `refine` makes of the first three points: one that has converged
/// comes before one that has not.
template <typename Refine, typename F = std::invoke_result_t<Refine, const FitPoint&>>
F BestRefined(const std::vector<FitPoint>& points, const Refine& refine,
              std::optional<F> best = {}) {
  constexpr size_t kRefined = 3;
  for (size_t i = 0; i < std::min(kRefined, points.size()); ++i) {
    F fit = refine(points[i]);
    const bool better =
        !best ||
        (fit.converged && (!best->converged || fit.solution.squares < best->solution.squares));
    if (better) best = std::move(fit);
  }
  return *std::move(best);
}

/// The points of a scan, by those rows of the table that are in x. deviation: of the residuals of which the
/// squares are, N.m or N; exponent: of a law that has one; count: of samples.
std::vector<Iterate> ScanTrace(const FallingLaw& law, double exponent,
                               const std::vector<FitPoint>& points, double deviation,
                               Eigen::Index count);

/// Law and, where it is fitted, heat at x: the model and its table. at: of x; exponent: of a law that has one.
void SetFallingModel(const FallingLaw& law, double exponent, const Layout& at,
                     const Eigen::VectorXd& x, const LogSamples& measurements, Fit& fit);

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
