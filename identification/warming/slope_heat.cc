#include "identification/warming/slope_heat.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "identification/fit_data.h"
#include "identification/forward/thermal_filter.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint {
namespace {

constexpr double kWidest = 4;   // factor on tau to both sides
constexpr double kSame = 1e-6;  // columns that count as the same
constexpr int kSteps = 24;      // each leaves 0.618 of the bracket: 3e-5 of log(tau) in the end

/// Where a function has its minimum between a and b: golden section.
template <typename F>
double Lowest(const F& f, double a, double b) {
  constexpr double ratio = std::numbers::phi - 1;
  double left = b - ratio * (b - a), right = a + ratio * (b - a);
  double at_left = f(left), at_right = f(right);
  // golden section: the end beside the larger value is cut off
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

}  // namespace

Thermal FitSlopeHeat(const IdentifierInput& input, const Law& law, const Thermal& start) {
  const Measurements& m = input.measurements;
  // torque and law over samples that a fit uses, losses over all
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::VectorXd velocity = Kept(m.velocity, input.selection);
  const Eigen::MatrixXd columns = Kept(LawColumns(law, m.velocity), input.selection);
  const Eigen::VectorXd loss = m.torque.cwiseProduct(m.velocity).cwiseAbs();
  const ThermalFilter filter(m.time, m.starts);

  // law, k and c at a given tau: k and the squares that are left
  const auto fit = [&](double time_constant) {
    const Eigen::VectorXd x = Kept(filter.Energy({1, time_constant}, loss), input.selection);
    // heat adds to the level and to the slope over speed
    Eigen::MatrixXd heat(x.size(), 2);
    heat << velocity.array().sign() * x.array(), velocity.array() * x.array();
    const Eigen::MatrixXd all = Beside(columns, heat);
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

}  // namespace warmjoint
