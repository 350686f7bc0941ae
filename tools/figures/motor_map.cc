// What a joint's torque owes to the angle of its motor, and the fit with kernels over that angle: the map as in the paper's Fig. 10,
// in time as in its Fig. 9.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/robust_noise.h"
#include "models/friction/evaluate_map.h"
#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/speed_groups.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr double kFaint = 0.3;       // opacity of samples behind lines of the same colour
constexpr int kPoints = 241;         // of a map's line over one turn
constexpr int kMedians = 24;         // of the samples over one turn
constexpr double kTurnsInView = 4;   // of the motor, in the close-up
constexpr Eigen::Index kFewest = 8;  // samples of a close-up

/// The maps with an axis over motor angle, or the others.
std::vector<FrictionMap> MapsOverMotor(const Friction& friction, bool over) {
  std::vector<FrictionMap> chosen;
  for (const FrictionMap& map : friction.maps) {
    if ((FindAxis(map, MapQuantity::motor_position) != nullptr) == over) chosen.push_back(map);
  }
  return chosen;
}

/// The friction at every sample with these maps, NaN where the sample is not kept.
Eigen::VectorXd ForceWith(const FitView& view, const std::vector<FrictionMap>& maps) {
  Eigen::VectorXd force = Eigen::VectorXd::Constant(view.time.size(), std::nan(""));
  Friction friction = *view.estimate.friction;
  friction.maps = maps;
  const JointFriction sliding(friction);
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    if (view.selection.keep[i]) force[i] = sliding.SlidingForce(view.velocity[i], PlaceAt(view, i));
  }
  return force;
}

double RootMeanSquare(const FitView& view, const Eigen::VectorXd& force) {
  return std::sqrt(KeptOf(view, view.torque - force).array().square().mean());
}

/// Whether the group has samples within a kernel's spacing of each point of one turn.
std::vector<bool> HasPassed(const FitView& view, const SpeedGroup& group, const FrictionMap& map) {
  const auto kernels =
      static_cast<double>(FindAxis(map, MapQuantity::motor_position)->kernels.size());
  // a sample speaks for the angles around it as far as the kernels are apart
  const int cells = kPoints - 1, reach = static_cast<int>(std::ceil(cells / kernels));
  std::vector<bool> passed(kPoints);
  for (const Eigen::Index sample : group.samples) {
    const double turns = view.motor_angle[sample] / (2 * M_PI);
    const int cell = static_cast<int>(std::lround((turns - std::floor(turns)) * cells));
    // the angle begins anew after each turn
    for (int i = cell - reach; i <= cell + reach; ++i) {
      passed[static_cast<size_t>(((i % cells) + cells) % cells)] = true;
    }
  }
  passed.back() = passed.front();
  return passed;
}

/// The maps over one turn at a speed, E and position that the group had; NaN where it has no samples near.
Line MapLine(const FitView& view, const SpeedGroup& group, const std::vector<FrictionMap>& maps) {
  Line line{Eigen::VectorXd(kPoints), Eigen::VectorXd::Zero(kPoints), 2.2};
  // one sample stands for position, speed and warmth of its group
  const Eigen::Index typical = group.samples[group.samples.size() / 2];
  const std::vector<bool> passed = HasPassed(view, group, maps.front());
  for (int i = 0; i < kPoints; ++i) {
    line.x[i] = 2 * M_PI * i / (kPoints - 1);
    // no line at angles that the motor never passed
    if (!passed[static_cast<size_t>(i)]) line.y[i] = std::nan("");
    const MapPoint<double> point{view.position[typical], line.x[i], view.velocity[typical],
                                 view.energy[typical], 0};
    for (const FrictionMap& map : maps) line.y[i] += EvaluateMap(map, point);
  }
  return line;
}

/// One direction's torque over the motor's angle.
struct AnglePanel {
  Plot plot;
  Eigen::Index beyond = 0;   // samples that the axis leaves out
  double largest_swing = 0;  // of the medians, torque unit
};

/// Draws lines over all dots, and axes that hold most of what is shown.
void Finish(const std::vector<Series>& lines, const std::string& label,
            const std::vector<Eigen::VectorXd>& shown, AnglePanel& panel) {
  Plot& plot = panel.plot;
  plot.series.insert(plot.series.end(), lines.begin(), lines.end());
  plot.x = AngleAxis("motor angle (rad)");
  plot.y = BulkAxis(label, shown);
  // torques that the axis leaves out are counted
  panel.beyond = CountBeyond(plot.y, shown);
}

AnglePanel OverAngle(const FitView& view, int direction, const Eigen::VectorXd& without) {
  const std::vector<FrictionMap> maps = MapsOverMotor(*view.estimate.friction, true);
  AnglePanel panel;
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> lines;
  for (const SpeedGroup& group : GroupBySpeed(view, direction)) {
    if (group.samples.empty()) continue;
    // what the law and the other maps leave over is this map's to explain
    const Eigen::VectorXd left = (view.torque - without)(group.samples);
    panel.plot.series.push_back(
        {"", group.hue,
         Scatter{view.motor_angle(group.samples), left, 0.8, Marker::circle, kFaint}});
    const Line line = MapLine(view, group, maps);
    lines.push_back({"map at " + group.label, group.hue, line});
    const Line medians = BinnedMedian(view.motor_angle(group.samples), left, kMedians);
    lines.push_back({"", group.hue, Scatter{medians.x, medians.y, 3, Marker::diamond}});
    shown.insert(shown.end(), {left, line.y});
  }
  Finish(lines, TorqueLabel(view, "torque − law"), shown, panel);
  return panel;
}

/// Mean speed of the motor, rad/s, as far as the samples can follow it.
double MotorSpeed(const FitView& view, const Segment& segment) {
  double turned = 0;
  for (Eigen::Index i = segment.begin; i + 1 < segment.end; ++i) {
    const double change = view.motor_angle[i + 1] - view.motor_angle[i];
    turned += std::abs(std::remainder(change, 2 * M_PI));
  }
  return turned / (view.time[segment.end - 1] - view.time[segment.begin]);
}

/// Segments slow enough for samples to follow the motor's turns: those near the slowest speed.
std::vector<Segment> SlowSegments(const FitView& view) {
  std::vector<SpeedGroup> groups = GroupBySpeed(view, 1);
  std::vector<Segment> slow;
  for (const Segment& segment : view.selection.segments) {
    if (std::abs(segment.velocity) <= groups.front().fastest) slow.push_back(segment);
  }
  return slow;
}

/// A few turns of the motor from the begin of a segment.
Window FewTurns(const FitView& view, const Segment& segment) {
  const double step = MedianStep(view.time);                                 // s
  const double turn = 2 * M_PI / std::max(1e-9, MotorSpeed(view, segment));  // s
  const auto wanted = static_cast<Eigen::Index>(kTurnsInView * turn / step);
  const Eigen::Index count = std::clamp<Eigen::Index>(
      wanted, std::min(kFewest, segment.end - segment.begin), segment.end - segment.begin);
  return {segment.begin, segment.begin + count};
}

Plot InTime(const FitView& view, const Window& window, const Eigen::VectorXd& without,
            const Eigen::VectorXd& with) {
  const auto part = [&](const Eigen::VectorXd& all) { return window.Of(all); };
  // a few turns of the motor: measured, and fitted without and with the map
  const Eigen::VectorXd time = part(view.time);
  Plot plot;
  plot.series.push_back({"measured", Hue::grey, Scatter{time, part(view.torque), 1.6}});
  plot.series.push_back({"fit without the map", Hue::orange, Line{time, part(without), 1.5}});
  plot.series.push_back({"with it", Hue::blue, Line{time, part(with), 2}});
  plot.x = {"time (s)", time[0], time.tail(1)[0]};
  plot.y = LinearAxis(TorqueLabel(view, "torque"), {part(view.torque), part(with), part(without)});
  return plot;
}

bool HasMotorMap(const FitView& view) {
  return view.has_fit && view.motor_angle.size() > 0 && view.selection.count() > 0 &&
         !view.selection.segments.empty() && !MapsOverMotor(*view.estimate.friction, true).empty();
}

/// What both figures say of a map's worth.
std::string Worth(const FitView& view, const Eigen::VectorXd& without,
                  const Eigen::VectorXd& with) {
  return fmt::format("The map over motor angle takes the RMSE from {} to {} {}.",
                     SignificantText(RootMeanSquare(view, without)),
                     SignificantText(RootMeanSquare(view, with)), view.torque_unit);
}

constexpr Eigen::Index kMostBins = 72, kFewestBins = 8;
constexpr Eigen::Index kSamplesPerBin = 12;

/// Peak to peak of a line, over its finite points.
double Swing(const Line& line) {
  const auto [lowest, highest] = RangeOf({line.y});
  return highest - lowest;
}

AnglePanel PanelOf(const FitView& view, int direction, const std::string& label) {
  AnglePanel panel;
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> medians;
  for (const SpeedGroup& group : GroupBySpeed(view, direction)) {
    if (group.samples.empty()) continue;
    // without the warming only the angle is left to explain the torque
    Eigen::VectorXd torque = view.torque(group.samples);
    if (view.warms()) torque -= direction * view.energy(group.samples);
    const Eigen::VectorXd angle = view.motor_angle(group.samples);
    // as many bins as the samples bear
    const Eigen::Index bins = std::clamp(angle.size() / kSamplesPerBin, kFewestBins, kMostBins);
    const Line median = BinnedMedian(angle, torque, static_cast<int>(bins));
    panel.plot.series.push_back(
        {"", group.hue, Scatter{angle, torque, 0.8, Marker::circle, kFaint}});
    medians.push_back({group.label, group.hue, median});
    shown.push_back(torque);
    panel.largest_swing = std::max(panel.largest_swing, Swing(median));
  }
  Finish(medians, label, shown, panel);
  return panel;
}

}  // namespace

std::optional<Figure> MakeMotorMap(const FitView& view) {
  if (!HasMotorMap(view)) return std::nullopt;
  // the fit with all of its maps, and without those over the motor's angle
  const Eigen::VectorXd with = ForceWith(view, view.estimate.friction->maps);
  const Eigen::VectorXd without = ForceWith(view, MapsOverMotor(*view.estimate.friction, false));
  const AnglePanel forwards = OverAngle(view, 1, without), backwards = OverAngle(view, -1, without);
  return RowOfPlots(
      {"motor_map", "The map over motor angle",
       OriginOf(view) +
           "; diamonds are medians of the samples; no line where the joint never moved so" +
           BeyondText(forwards.beyond + backwards.beyond),
       Worth(view, without, with)},
      430,
      {{"Forwards: torque less law and warming", forwards.plot}, {"Backwards", backwards.plot}});
}

std::optional<Figure> MakeMotorFit(const FitView& view) {
  if (!HasMotorMap(view)) return std::nullopt;
  // the fit with all of its maps, and without those over the motor's angle
  const Eigen::VectorXd with = ForceWith(view, view.estimate.friction->maps);
  const Eigen::VectorXd without = ForceWith(view, MapsOverMotor(*view.estimate.friction, false));
  const std::vector<Segment> slow = SlowSegments(view);
  // first and last slow segment, where samples follow the motor's turns
  const bool warms = view.warms();
  return RowOfPlots({"motor_fit", "Fit with and without the map over motor angle", OriginOf(view),
                     Worth(view, without, with)},
                    430,
                    {{warms ? "Cold: in the first slow segment" : "In the first slow segment",
                      InTime(view, FewTurns(view, slow.front()), without, with)},
                     {warms ? "Warm: in the last one" : "In the last one",
                      InTime(view, FewTurns(view, slow.back()), without, with)}});
}

std::optional<Figure> MakeMotorAngle(const FitView& view) {
  if (view.motor_angle.size() == 0 || view.selection.segments.empty()) return std::nullopt;
  const std::string label = TorqueLabel(view, view.warms() ? "torque − sign(v) E" : "torque");
  const AnglePanel forwards = PanelOf(view, 1, label), backwards = PanelOf(view, -1, label);

  // how much the angle of the motor matters at one speed
  const std::string finding =
      fmt::format("Over one turn of the motor the median torque at a speed varies by up to {} {}.",
                  SignificantText(std::max(forwards.largest_swing, backwards.largest_swing), 2),
                  view.torque_unit);
  // a direction that the joint never took has no panel
  Figure figure =
      RowOfPlots({"motor_angle", "Torque over motor angle",
                  fmt::format("{}: samples at constant speed, with their medians", view.source) +
                      BeyondText(forwards.beyond + backwards.beyond),
                  finding},
                 430, {{"Forwards", forwards.plot}, {"Backwards", backwards.plot}});
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace warmjoint::figures
