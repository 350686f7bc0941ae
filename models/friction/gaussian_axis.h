// Gaussian kernels over one quantity, Eqs. (10)-(13) and (16).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "models/foundation/field.h"

namespace warmjoint::inline models {

/// Whether kernels are divided by their sum, Eq. (16). Normalised ones keep the value of the
/// nearest centre outside of the centres, where plain ones fall to 0.
enum class KernelKind { plain, normalised };

inline std::span<const Word<KernelKind>> WordsOf(KernelKind) {
  static constexpr std::array words{Word{"normalised", KernelKind::normalised},
                                    Word{"plain", KernelKind::plain}};
  return words;
}

/// Whether kernels reach across 0. Friction jumps there, so kernels over velocity stay apart.
enum class Sides { together, apart };

inline std::span<const Word<Sides>> WordsOf(Sides) {
  static constexpr std::array words{Word{"together", Sides::together}, Word{"apart", Sides::apart}};
  return words;
}

/// Evenly or freely spaced Gaussian kernels kappa_i(x) = exp(-(x - c_i)^2 / (2 s^2)).
struct GaussianAxis {
  std::vector<double> centres;   // c, ascending; none is 0 where the sides are apart
  double width = 1;              // s
  std::optional<double> period;  // of a circle: distances are wrapped to half of it
  Sides sides = Sides::together;

  size_t size() const { return centres.size(); }

  template <class A>
  void Serialize(A* a) {
    a->Field("centres", &centres, {.meaning = "in the quantity's unit", .needed = "give numbers"});
    a->Field("width", &width, {.needed = "give a number"});
    a->Field("period", &period);
    a->Field("sides", &sides);
  }
};

/// Even centres from `first` to `last`, with a width of one spacing.
GaussianAxis EvenAxis(double first, double last, int count);

/// Even centres on a circle, the first at 0, with a width of one spacing. period: rad, say.
GaussianAxis CircleAxis(double period, int count);

/// Even centres over both directions of motion, -highest ... -lowest, lowest ... highest, with a
/// width of one spacing, kept apart. count: centres for each direction.
GaussianAxis SpeedAxis(double lowest, double highest, int count);

}  // namespace warmjoint::inline models
