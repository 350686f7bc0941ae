#include "tools/figures/robot/robot_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/excerpt.h"
#include "tools/figures/axes.h"

namespace warmjoint::figures {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The kept samples of a column.
VectorXd KeptIn(const JointSeries& series, const VectorXd& values) {
  VectorXd kept(series.kept.count());
  Index at = 0;
  for (Index i = 0; i < values.size(); ++i) {
    if (series.kept[i]) kept[at++] = values[i];
  }
  return kept;
}

/// The others interrupt a line.
VectorXd WithGaps(const JointSeries& series, const VectorXd& values) {
  return series.kept.select(values.array(), std::nan("")).matrix();
}

}  // namespace

std::optional<Figure> MakeJointFigure(const RobotJointEstimate& joint) {
  if (!joint.series) return std::nullopt;
  const JointSeries& s = *joint.series;
  const std::string& unit = joint.summary.torque_unit;
  const bool turns = unit != "N";
  const std::string speed = fmt::format("velocity ({})", turns ? "rad/s" : "m/s");
  const std::string torque = fmt::format("friction ({})", unit);

  // over velocity
  const VectorXd v = KeptIn(s, s.velocity), measured = KeptIn(s, s.measured),
                 fitted = KeptIn(s, s.fitted);
  Plot curve;
  curve.x = LinearAxis(speed, {v});
  curve.y = BulkAxis(torque, {measured, fitted});
  curve.series = {{"torque less all that is no friction", Hue::grey, Scatter{v, measured, 1.1}},
                  {"fitted", Hue::blue, Scatter{v, fitted, .9}}};

  // along the log, what is left, and the heat
  const bool minutes = s.time.tail(1)[0] > 300;
  const VectorXd time = s.time / (minutes ? 60 : 1);
  const std::string when = minutes ? "time (min)" : "time (s)";
  Plot along;
  along.x = LinearAxis(when, {time});
  along.y = curve.y;
  along.series = {{"", Hue::grey, Line{time, WithGaps(s, s.measured), 1}},
                  {"", Hue::blue, Line{time, WithGaps(s, s.fitted), 1}}};
  Plot rest;
  const VectorXd left = s.measured - s.fitted;
  rest.x = along.x;
  rest.y = BulkAxis(fmt::format("residual ({})", unit), {KeptIn(s, left)});
  rest.series = {{"", Hue::grey, Line{time, WithGaps(s, left), 1}}};
  if (s.energy.size() > 0) {
    rest.series.push_back({"heat E", Hue::vermilion, Line{time, s.energy, 1.5}});
    rest.y = BulkAxis(fmt::format("residual and heat ({})", unit), {KeptIn(s, left), s.energy});
  }

  Figure figure;
  figure.name = joint.summary.joint;
  figure.title = fmt::format("Friction of {}", Printable(joint.summary.joint));
  figure.subtitle = std::string(NameOf(joint.estimate.status));
  if (joint.summary.rms_held_out) {
    figure.subtitle +=
        fmt::format(", held-out residual {:.3g} {}", *joint.summary.rms_held_out, unit);
  }
  figure.finding = joint.estimate.message;
  figure = WithoutPanels(std::move(figure));
  AddPanel(figure, "over velocity", curve, 300);
  AddPanel(figure, "along the log", along, 220);
  AddPanel(figure, "what is left", rest, 180);
  return figure;
}

}  // namespace warmjoint::figures
