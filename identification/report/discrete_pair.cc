#include "identification/report/discrete_pair.h"

#include <cmath>

#include "identification/uncertainty/tails.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

/// Place of a row of the table among the estimated ones.
Eigen::Index ColumnOf(const Fit& fit, size_t row) {
  Eigen::Index column = 0;
  for (size_t i = 0; i < row; ++i) column += fit.parameters[i].estimated;
  return column;
}

/// Covariance of (k, ln tau).
Eigen::Matrix2d HeatCovariance(const Fit& fit, const Inference& inference, size_t gain,
                               size_t tau) {
  const Eigen::Index k = ColumnOf(fit, gain), l = ColumnOf(fit, tau);
  const Eigen::MatrixXd& all = inference.known.covariance;
  Eigen::Matrix2d covariance;
  covariance << all(k, k), all(k, l), all(l, k), all(l, l);
  return covariance;
}

void Move(double shift, double widened, EstimatedParameter& parameter) {
  parameter.value += shift;
  if (!parameter.interval95) return;
  (*parameter.interval95)[0] += shift - widened;
  (*parameter.interval95)[1] += shift + widened;
}

}  // namespace

std::vector<EstimatedParameter> DiscretePair(const Fit& fit, const Inference& inference, double h) {
  // k and tau as they were fitted, and what they are over one sampling interval
  const size_t gain_row = *fit.RowOf(Role::heat, 0), tau_row = *fit.RowOf(Role::heat, 1);
  const Thermal fitted{fit.parameters[gain_row].value, fit.parameters[tau_row].value};
  const KnownParameter& known_gain = inference.parameters[gain_row];
  const KnownParameter& known_tau = inference.parameters[tau_row];
  const DiscreteThermal discrete = Discretise(fitted, h);
  EstimatedParameter gain{
      std::string(kDiscreteGainName), discrete.gain, fit.parameters[gain_row].unit, {}, {}};
  EstimatedParameter pole{std::string(kPoleName), discrete.pole, "1", {}, {}};

  // to first order; dte/dln tau = te h/tau
  const double by_pole = discrete.pole * h / fitted.time_constant;
  const double cooling = -std::expm1(-h / fitted.time_constant);
  if (known_gain.interval95 && known_tau.interval95) {
    const Eigen::Matrix2d covariance = HeatCovariance(fit, inference, gain_row, tau_row);
    const double quantile = StudentQuantile(inference.known.freedom, kIntervalLevel);
    // ke = k (1 - te) by k and by ln tau
    const Eigen::Vector2d by_gain(cooling, -fitted.gain * by_pole);
    gain.std = std::sqrt(by_gain.dot(covariance * by_gain));
    gain.interval95 = {{gain.value - quantile * *gain.std, gain.value + quantile * *gain.std}};
    pole.std = by_pole * std::sqrt(covariance(1, 1));
    // the ends of ln tau, so that the interval of te stays between 0 and 1
    const double factor = std::exp(quantile * std::sqrt(covariance(1, 1)));
    pole.interval95 = {{std::exp(-h * factor / fitted.time_constant),
                        std::exp(-h / (fitted.time_constant * factor))}};
  }

  // what the verdict moved
  const DiscreteThermal moved = Discretise({known_gain.value, known_tau.value}, h);
  const Thermal now{known_gain.value, known_tau.value};
  // dte/dtau = te h/tau^2 carries what widened tau to te
  const double pole_reach = moved.pole * h / std::pow(now.time_constant, 2) * known_tau.widened;
  Move(moved.pole - discrete.pole, pole_reach, pole);
  Move(moved.gain - discrete.gain,
       (1 - moved.pole) * known_gain.widened + std::abs(now.gain) * pole_reach, gain);
  return {gain, pole};
}

}  // namespace warmjoint
