#include "identification/warming/report_thermal.h"

#include <cmath>

#include "identification/fit_data.h"
#include "identification/uncertainty/student.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {

void ReportThermal(const Thermal& thermal, const std::optional<Eigen::Matrix2d>& covariance,
                   double freedom, const Measurements& measurements, Estimate& estimate) {
  const double h = MedianStep(measurements.time);
  const auto& [gain, tau] = thermal;
  const DiscreteThermal discrete = Discretise(thermal, h);

  // gradient: of the value by (k, ln tau); dte/dln tau = te h/tau
  const auto append = [&](const char* name, double value, const std::string& unit,
                          const Eigen::Vector2d& gradient) {
    if (!covariance) {
      estimate.parameters.push_back({name, value, unit, {}, {}});
      return;
    }
    const double std = std::sqrt(gradient.dot(*covariance * gradient));
    estimate.parameters.push_back(WithInterval(name, value, unit, std, freedom));
  };
  const std::string gain_unit = UnitFor(Thermal::parameters[0], measurements);
  const double by_pole = discrete.pole * h / tau;
  append("thermal_gain", gain, gain_unit, {1, 0});
  append("thermal_time_constant", tau, "s", {0, tau});
  append("thermal_gain_discrete", discrete.gain, gain_unit,
         {-std::expm1(-h / tau), -gain * by_pole});
  append("thermal_pole", discrete.pole, "1", {0, by_pole});
  if (!covariance) return;

  // tau is positive and its logarithm the nearer to normal: the ends of tau and te follow from it
  const double factor = std::exp(StudentQuantile(freedom) * std::sqrt((*covariance)(1, 1)));
  auto& parameters = estimate.parameters;
  (parameters.end() - 3)->interval95 = {{tau / factor, tau * factor}};
  (parameters.end() - 1)->interval95 = {
      {std::exp(-h * factor / tau), std::exp(-h / (tau * factor))}};
}

}  // namespace warmjoint::inline identification
