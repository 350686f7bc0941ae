// lpv-energy: a law whose parameters follow the energy.
//
// F = kv(E) v + kc(E) sign(v), Eq. (27), linear parameter-varying in E: kv(E) and kc(E) are the
// law's own values, E in kc, and kernels over E on both. E comes from a fit of the law
// alone, as energy-ml has it.
#include <warmjoint/friction.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "identification/fit/fit_data.h"
#include "identification/fit/identifier.h"
#include "identification/forward/thermal_filter.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/map_model.h"
#include "identification/model/least_squares.h"

namespace warmjoint {
namespace {

constexpr double kWidest = 4;   // factor on tau to both sides
constexpr double kSame = 1e-6;  // columns that count as the same
constexpr int kSteps = 24;      // each leaves 0.618 of the bracket: 3e-5 of log(tau) in the end

/// The place of a function's minimum between a and b, by golden section.
template <typename F>
double Lowest(const F& f, double a, double b) {
  constexpr double ratio = std::numbers::phi - 1;
  double left = b - ratio * (b - a), right = a + ratio * (b - a);
  double at_left = f(left), at_right = f(right);
  // golden section: the end next to the larger value is cut off
  for (int i = 0; i < kSteps; ++i) {
    if (at_left < at_right) {
      b = std::exchange(right, left), at_right = at_left;
      left = b - ratio * (b - a), at_left = f(left);
    } else {
      a = std::exchange(left, right), at_left = at_right;
      right = a + ratio * (b - a), at_right = f(right);
    }
  }
  return (a + b) / 2;
}

/// Gain and time constant of Eq. (27), F = Fn(v) + k sign(v) x + c v x, with x the measured losses
/// |tau v| filtered by 1 / (1 + s tau): linear in all but tau, which is searched for by golden
/// section within a factor of four to both sides of `start`. In a fit without c, the slope's part
/// would bias k and tau.
Thermal FitSlopeHeat(const IdentifierInput& input, const Law& law, const Thermal& start) {
  const LogSamples& m = input.measurements;
  // torque and law over samples that a fit uses, losses over all
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::VectorXd velocity = Kept(m.velocity, input.selection);
  const Eigen::MatrixXd columns = Kept(LawColumns(law, m.velocity), input.selection);
  const Eigen::VectorXd loss = m.torque.cwiseProduct(m.velocity).cwiseAbs();
  const ThermalFilter filter(m.time, m.further_starts);

  // law, k and c at a given tau: k and the squares that are left
  const auto fit = [&](double time_constant) {
    const Eigen::VectorXd x = Kept(filter.Energy({1, time_constant}, loss), input.selection);
    // heat adds to the level and to the slope over speed
    Eigen::MatrixXd heat(x.size(), 2);
    heat << velocity.array().sign() * x.array(), velocity.array() * x.array();
    const Eigen::MatrixXd all = ConcatColumns(columns, heat);
    const LeastSquares solved = SolveLeastSquares(all, torque, kSame);
    if (!solved.mixed.empty()) return std::pair(start.gain, kInfinity);
    return std::pair(solved.solution[columns.cols()],
                     (torque - all * solved.solution).squaredNorm());
  };
  const double around = std::log(start.time_constant), reach = std::log(kWidest);
  const auto squares = [&](double log_tau) { return fit(std::exp(log_tau)).second; };
  // the time constant that leaves least
  const double best = std::exp(Lowest(squares, around - reach, around + reach));
  const auto [gain, left] = fit(best);
  return std::isfinite(left) && std::isfinite(gain) ? Thermal{gain, best} : start;
}

constexpr const char* kName = "lpv-energy";

struct LpvEnergySize {
  int energy_kernels = 4;

  template <class A>
  void Serialize(A* a) {
    a->Field("energy_kernels", &energy_kernels,
             {.bounds = {.at_least = 2, .at_most = 32},
              .meaning = "kernels over energy for each of viscous and Coulomb friction"});
  }
};

/// Kernels over E times v and times sign(v), for every width.
MapShapes Shapes(int energy_kernels, const MapOptions& options, const MapPoints& points) {
  return ForEachWidth(options, [&](double width) -> std::vector<FrictionMap> {
    const MapAxis axis = RangeAxis(MapQuantity::energy, points, energy_kernels, width);
    return {{{axis}, options.kernel, {}, MapFactor::velocity},
            {{axis}, options.kernel, {}, MapFactor::direction}};
  });
}

Fit FitSlopeAndLevel(const IdentifierInput& input) {
  const int kernels = input.options.Get<LpvEnergySize>().energy_kernels;
  const auto& options = input.options.Get<MapOptions>();
  // E of a law of which only the level follows the heat, corrected for the slope, which follows it too; then both over that E
  return FitMapModel(
      kName, input,
      {.heat = MapHeat::of_law,
       .heat_of_all = &FitSlopeHeat,
       .over_energy = [&](const MapPoints& points) { return Shapes(kernels, options, points); }});
}

}  // namespace

Identifier LpvEnergy() {
  return {kName, "a law whose viscous and Coulomb friction follow the energy, Eq. (27)",
          OptionGroups<LawOption, MapOptions, LpvEnergySize>{}, &FitSlopeAndLevel};
}

}  // namespace warmjoint
