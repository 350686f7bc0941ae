#include "identification/maps/map_options.h"

#include <fmt/format.h>

#include <numbers>

#include "identification/linear/linear_task.h"

namespace warmjoint::inline identification {
namespace {

Eigen::VectorXd Column(MapQuantity quantity, const MapPoints& points) {
  return points.col(static_cast<int>(quantity));
}

}  // namespace

std::vector<OptionInfo> MapOptions() {
  return {
      LawOption(),
      {"kernel", "normalised", "normalised|plain",
       "normalised kernels keep the value of the nearest centre outside of the data, (16)"},
      {"width", "0", "number >= 0",
       "width of the kernels in spacings of their centres; 0: chosen from 0.7, 1 and 1.5"},
      {"strength", "0", "number >= 0", "of the prior on the kernels' weights; 0: chosen"},
      {"selection", "cv", "cv|loo|evidence",
       "what chooses: cross validation over contiguous parts, leave-one-out, or the evidence; the "
       "last two take coloured noise for friction"},
      {"folds", "5", "integer >= 2 <= 100", "contiguous parts of the recording for cv"},
      {"bands", "wide", "wide|none",
       "along the maps: wide enough for what twice the kernels follow; none: left out, with the "
       "harmonics of a motor's map, for twice the speed"},
  };
}

MapSettings ReadMapSettings(const Options& options) {
  MapSettings settings;
  settings.law = options.Text("law");
  if (options.Text("kernel") == "plain") settings.kernels = KernelKind::plain;
  // a width that is given, or those from which one is chosen
  const double width = options.Number("width");
  settings.widths = width > 0 ? std::vector{width} : std::vector{0.7, 1.0, 1.5};
  settings.strength = options.Number("strength");
  // what chooses width, shape and strength
  const std::string& rule = options.Text("selection");
  if (rule == "loo") settings.rule = StrengthRule::leave_one_out;
  if (rule == "evidence") settings.rule = StrengthRule::evidence;
  settings.folds = options.Integer("folds");
  settings.has_bands = options.Text("bands") != "none";
  return settings;
}

MapAxis RangeAxis(MapQuantity quantity, const MapPoints& points, int count, double width) {
  const Eigen::VectorXd x = Column(quantity, points);
  MapAxis axis{quantity, EvenAxis(x.minCoeff(), x.maxCoeff(), count)};
  axis.kernels.width *= width;
  return axis;
}

MapAxis VelocityAxis(const MapPoints& points, int count, double width) {
  const Eigen::VectorXd speed = Column(MapQuantity::velocity, points).cwiseAbs();
  const double lowest = speed.minCoeff(), highest = speed.maxCoeff();
  const bool one = count == 1 || !(highest - lowest > 1e-6 * highest);
  MapAxis axis{MapQuantity::velocity,
               one ? SpeedAxis(highest, highest, 1) : SpeedAxis(lowest, highest, count)};
  // one kernel a side is 1 on its side, plain or not
  axis.kernels.width *= one ? 1e6 : width;
  return axis;
}

MapAxis TurnAxis(MapQuantity angle, int count, double width) {
  MapAxis axis{angle, CircleAxis(2 * std::numbers::pi, count)};
  axis.kernels.width *= width;
  return axis;
}

std::optional<std::string> CannotCarry(MapQuantity quantity, const MapPoints& points) {
  const Eigen::VectorXd x = Column(quantity, points);
  const std::string_view name = NameOf(quantity);
  if (!x.allFinite()) {
    return fmt::format("{} is not a finite number at some sample; repair or remove it", name);
  }
  const double range = x.maxCoeff() - x.minCoeff();
  if (!(range > 1e-9 * x.cwiseAbs().maxCoeff())) {
    return fmt::format(
        "{} is {:.6g} at all samples, so that no map over it can be estimated; vary it", name,
        x[0]);
  }
  return std::nullopt;
}

}  // namespace warmjoint::inline identification
