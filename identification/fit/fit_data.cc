#include "identification/fit/fit_data.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "identification/preparation/moving_view.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kLargest = 1e75;  // why: its fourth power, a squared power, is a double

/// A sentence about the first number in `values` that is not finite, if there is one.
std::optional<std::string> NotFinite(const char* name, const Eigen::VectorXd& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    return fmt::format("{} is {} at sample {}; remove or repair that sample", name, values[i], i);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> Unusable(const IdentifierInput& input, int parameters) {
  // what every fit uses must be finite
  const LogSamples& m = input.measurements;
  if (auto why = NotFinite("time", m.time)) return why;
  if (auto why = NotFinite("velocity", m.velocity)) return why;
  if (auto why = NotFinite("torque", m.torque)) return why;

  // numbers whose squares and products stay within those that doubles hold
  for (const auto& [name, column] : {std::pair("velocity", &m.velocity), {"torque", &m.torque}}) {
    const double largest = column->size() > 0 ? column->cwiseAbs().maxCoeff() : 0;
    if (largest == 0 || (largest < kLargest && largest > 1 / kLargest)) continue;
    return fmt::format("{} is {:.3g} at most, too {} to square; check its unit", name, largest,
                       largest < 1 ? "small" : "large");
  }

  // more samples than parameters, of those that take part
  const auto count = input.selection.count();
  if (count <= parameters) {
    const auto moving = (m.velocity.array().abs() > ClearSpeed(m)).count();
    if (m.acceleration && moving > parameters) {
      return fmt::format(
          "motion of any kind can use {} of {} samples that move, too few for {} parameters: at "
          "{:.3g} Hz the others lie beside a change of speed; log faster, or use --motion constant "
          "where speeds are held",
          count, moving, parameters, 1 / MedianStep(m.time));
    }
    if (m.acceleration) {
      return fmt::format("{} of {} samples move clearly, too few for {} parameters; record longer",
                         moving, m.size(), parameters);
    }
    return fmt::format(
        "{} of {} samples move at a constant speed, too few for {} parameters; record longer, or "
        "hold each speed longer",
        count, m.size(), parameters);
  }

  // a torque that never changes shows nothing
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  if (torque.maxCoeff() == torque.minCoeff()) {
    return fmt::format("torque is constant at {} {}; is it the right column?", torque[0],
                       m.torque_unit);
  }
  return std::nullopt;
}

std::string Indistinct(const std::vector<std::string>& mixed, const LogSamples& measurements,
                       const Selection& selection) {
  // which speeds there are, and whether in both directions
  const Eigen::VectorXd velocity = Kept(measurements.velocity, selection);
  const std::string names = fmt::format("{}", fmt::join(mixed, ", "));
  const bool one_direction = velocity.minCoeff() > 0 || velocity.maxCoeff() < 0;
  const Eigen::ArrayXd speed = velocity.cwiseAbs();
  const std::string_view unit = kVelocityUnit.For(measurements.joint);
  return fmt::format(
      "the motion does not distinguish: {}; speeds from {:.4g} to {:.4g} {}{}; move at two or more "
      "speeds that differ clearly, for example a tenth of the highest and the highest{}",
      names, speed.minCoeff(), speed.maxCoeff(), unit,
      one_direction ? " in one direction alone" : "", one_direction ? ", in both directions" : "");
}

}  // namespace warmjoint
