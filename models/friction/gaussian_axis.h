// Gaussian kernels over one quantity, Eqs. (10)-(13) and (16).
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "models/friction/sign.h"

namespace warmjoint::inline models {

/// Whether kernels are divided by their sum, Eq. (16). Normalised ones keep the value of the
/// nearest centre outside of the centres, where plain ones fall to 0.
enum class KernelKind { plain, normalised };

/// Whether kernels reach across 0. Friction jumps there, so kernels over velocity stay apart.
enum class Sides { together, apart };

/// Evenly or freely spaced Gaussian kernels kappa_i(x) = exp(-(x - c_i)^2 / (2 s^2)).
struct GaussianAxis {
  std::vector<double> centres;   // c, ascending; none is 0 where the sides are apart
  double width = 1;              // s
  std::optional<double> period;  // of a circle: distances are wrapped to half of it
  Sides sides = Sides::together;

  size_t size() const { return centres.size(); }
};

/// Even centres from `first` to `last`, with a width of one spacing.
GaussianAxis EvenAxis(double first, double last, int count);

/// Even centres on a circle, the first at 0, with a width of one spacing. period: rad, say.
GaussianAxis CircleAxis(double period, int count);

/// Even centres over both directions of motion, -highest ... -lowest, lowest ... highest, with a
/// width of one spacing, kept apart. count: centres for each direction.
GaussianAxis SpeedAxis(double lowest, double highest, int count);

/// Below it exp(x) is 0 in double precision, and need not be computed.
inline constexpr double kUnderflow = -746;

/// All kernels of an axis at x, into phi [axis.size()]. Normalised ones by log-sum-exp, so that
/// they do not become 0/0 far from every centre. With the sides apart, kernels on the other side
/// are 0, and all of them are at x = 0.
template <typename T>
void AxisKernels(const GaussianAxis& axis, KernelKind kind, const T& x, T* phi) {
  using std::exp;
  using std::floor;
  const size_t n = axis.size();
  const auto present = [&](size_t i) {
    return axis.sides == Sides::together || Sign(x) * Sign(axis.centres[i]) > 0;
  };

  // logarithms of the kernels, and the largest of them
  bool any = false;
  T largest(0);
  for (size_t i = 0; i < n; ++i) {
    if (!present(i)) continue;
    T distance = x - T(axis.centres[i]);
    if (axis.period) distance -= *axis.period * floor(distance / *axis.period + 0.5);
    phi[i] = -distance * distance / T(2 * axis.width * axis.width);
    if (!any || phi[i] > largest) largest = phi[i];
    any = true;
  }

  const bool normalised = kind == KernelKind::normalised;
  T sum(0);
  for (size_t i = 0; i < n; ++i) {
    if (!present(i)) {
      phi[i] = T(0);
      continue;
    }
    const T exponent = normalised ? T(phi[i] - largest) : phi[i];
    phi[i] = exponent > T(kUnderflow) ? exp(exponent) : T(0);
    sum += phi[i];
  }
  if (!normalised || !any) return;
  for (size_t i = 0; i < n; ++i) phi[i] /= sum;
}

}  // namespace warmjoint::inline models
