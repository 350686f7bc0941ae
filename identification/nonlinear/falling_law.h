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
#include "identification/model/minimise.h"
#include "identification/options.h"
#include "identification/table.h"
#include "models/foundation/serialize.h"
#include "models/friction/laws.h"

namespace warmjoint {

/// The places of the unknowns of a fit of such a law, which the compiler knows: law and shape as in its table, of which an exponent is
/// given; the heat where it is fitted; the inertia where a bristle needs samples that accelerate.
struct FallingPlaces {
  Eigen::Index levels = 0;  // parameters before vs
  Eigen::Index shape = 1;   // log(vs); with a bristle log(sigma0) and sigma1, too
  Eigen::Index heat = 0;    // 2: gain and log(tau)
  Eigen::Index rigid = 0;   // gravity and inertia; with a bristle 1: the inertia

  constexpr Slice law() const { return {0, levels}; }
  constexpr Eigen::Index log_vs() const { return levels; }
  constexpr Eigen::Index log_stiffness() const { return levels + 1; }
  constexpr Eigen::Index damping() const { return levels + 2; }
  constexpr Eigen::Index gain() const { return levels + shape; }
  constexpr Eigen::Index log_time_constant() const { return gain() + 1; }
  constexpr Eigen::Index inertia() const { return gain() + heat; }
  constexpr Eigen::Index size() const { return inertia() + rigid; }
  /// The warming at x, of a fit with heat.
  Thermal ThermalAt(const Eigen::VectorXd& x) const {
    return {x[gain()], std::exp(x[log_time_constant()])};
  }
};

/// What the fit of a law with the Stribeck effect knows of it in addition to its table. Its levels, p, are the l
/// parameters before stribeck_velocity, of which the force of steady sliding is linear.
struct FallingLaw {
  const Law& law;
  const Law& without;       // the law that is left without the fall, whose table is a part of x
  std::string_view steady;  // the law of the same friction in steady sliding, exponent 2
  FallingPlaces places;     // without heat
  /// The values of its table at x. exponent: of a law that has one
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

/// The places of the unknowns of a fit of L, with the heat where it is estimated.
template <typename L, PartFit W = PartFit::none>
constexpr FallingPlaces FallingPlacesOf() {
  FallingPlaces at;
  while (L::parameters[at.levels].name != kStribeckVelocityRow.name) ++at.levels;
  if (W == PartFit::estimated) at.heat = 2;
  if (LawWithBristle<L>) {
    at.shape = 3;
    at.rigid = 1;
  }
  return at;
}

/// The values of L's table at x. exponent: of a law that has one
template <typename L, typename T>
std::array<T, L::parameters.size()> ValuesOf(const T* x, double exponent = 2) {
  using std::exp;
  constexpr FallingPlaces at = FallingPlacesOf<L>();
  std::array<T, L::parameters.size()> values;
  std::copy_n(x, at.gain(), values.begin());
  // some are in x by their logarithms
  values[at.log_vs()] = exp(x[at.log_vs()]);
  if constexpr (LawWithBristle<L>) {
    values[at.log_stiffness()] = exp(x[at.log_stiffness()]);
  } else {
    values[at.gain()] = T(exponent);
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
void SetFallingModel(const FallingLaw& law, double exponent, const FallingPlaces& at,
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
