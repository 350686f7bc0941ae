#include "tools/report/simulation/warm_robot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"
#include "tools/report/draw/draw_series.h"
#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"
#include "tools/report/gl/robot_renderer.h"

namespace warmjoint::report {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kFilled = 0.85;  // share of the picture that the robot reaches over

/// A robot with one joint that moves and warms.
class Model {
 public:
  Model(const Scenario& scenario, const std::string& path)
      : model_(LoadModel(path).model), data_(mj_makeData(model_.get())) {
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, scenario.joint.c_str());
    if (joint < 0) Refuse({path}, "has no joint '{}'", scenario.joint);
    position_ = model_->jnt_qposadr[joint];
    body_ = model_->jnt_bodyid[joint];
    // light from everywhere, so that shades stay near the colours of the scale
    for (int c = 0; c < 3; ++c) {
      model_->vis.headlight.ambient[c] = 0.65f;
      model_->vis.headlight.diffuse[c] = 0.4f;
      model_->vis.headlight.specular[c] = 0;
    }
  }

  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

  /// Puts the joint somewhere (rad or m) and paints its link.
  void Set(double position, Rgb colour) {
    data_->qpos[position_] = position;
    // every shape of the link takes the colour, and no material covers it
    for (int i = 0; i < model_->body_geomnum[body_]; ++i) {
      const int geom = model_->body_geomadr[body_] + i;
      const std::uint8_t parts[3] = {colour.red, colour.green, colour.blue};
      for (int c = 0; c < 3; ++c) {
        model_->geom_rgba[4 * geom + c] = static_cast<float>(parts[c]) / 255.0f;
      }
      model_->geom_matid[geom] = -1;
    }
    mj_forward(model_.get(), data_.get());
  }

 private:
  ModelPtr model_;
  DataPtr data_;
  int position_ = 0;
  int body_ = 0;
};

double LargestEnergy(const SimulationView& view) { return view.fit.energy.cwiseAbs().maxCoeff(); }

Index WarmestSample(const SimulationView& view) {
  Index at = 0;
  view.fit.energy.cwiseAbs().maxCoeff(&at);
  return at;
}

/// Means over the kept samples of each segment, as strokes.
/// values: [N]; times in the view's unit.
Line SegmentMeans(const FitView& fit, const VectorXd& values) {
  std::vector<double> x, y;
  for (const Segment& segment : fit.selection.segments) {
    // segments that kept some samples
    const auto keep = fit.selection.keep.segment(segment.begin, segment.end - segment.begin);
    if (!keep.any()) continue;
    const auto own = values.segment(segment.begin, segment.end - segment.begin).array();
    // their mean as a line from the first sample to the last
    const double mean = keep.select(own, 0).sum() / static_cast<double>(keep.count());
    for (double time : {fit.time[segment.begin], fit.time[segment.end - 1], std::nan("")}) {
      x.push_back(time / TimeUnit(fit));
      y.push_back(std::isnan(time) ? time : mean);
    }
  }
  const auto vector = [](const std::vector<double>& list) {
    return VectorXd(Eigen::Map<const VectorXd>(list.data(), static_cast<Index>(list.size())));
  };
  return {vector(x), vector(y), 2.0};
}

/// sign(v) torque as it was, and sign(v) F as it were without warming.
Plot TorquePanel(const SimulationView& view) {
  const FitView& fit = view.fit;
  const VectorXd direction = fit.velocity.array().sign();
  // the kept torque in the direction of motion
  const auto kept = [&](const VectorXd& all) { return KeptOf(fit, all); };
  const VectorXd time = kept(fit.time) / TimeUnit(fit);
  const VectorXd torque = fit.torque.cwiseProduct(direction), measured = kept(torque);
  // less E it is what a joint that stays cold would need
  const VectorXd cold = fit.fitted.cwiseProduct(direction) - fit.energy;

  Plot plot;
  plot.series = {{"measured", Hue::grey, Scatter{time, measured, 1}},
                 {"its mean at each speed", Hue::text, SegmentMeans(fit, torque)},
                 {"the mean if it had stayed cold", Hue::blue, SegmentMeans(fit, cold)}};
  plot.x = {TimeLabel(fit), 0, fit.time.tail(1)[0] / TimeUnit(fit), Scale::linear, {}};
  plot.y = LinearAxis(TorqueLabel(fit, "torque · sign(v)"), {measured, SegmentMeans(fit, cold).y});
  return plot;
}

/// |E| over time as a strip in the colours of the robot's link.
Plot HeatStrip(const SimulationView& view) {
  constexpr Index kCells = 240;
  const FitView& fit = view.fit;
  HeatMap map{Eigen::MatrixXd(1, kCells),
              {0, fit.time.tail(1)[0] / TimeUnit(fit)},
              {0, 1},
              {0, LargestEnergy(view)},
              TorqueLabel(fit, WarmestEnergy(fit) < 0 ? "−E" : "E")};
  // the size of E at places spread over the recording
  for (Index i = 0; i < kCells; ++i) {
    map.values(0, i) = std::abs(fit.energy[i * (fit.energy.size() - 1) / (kCells - 1)]);
  }
  Plot plot;
  plot.x = {TimeLabel(fit), map.x.first, map.x.second, Scale::linear, {}};
  plot.y = {"", 0, 1, Scale::linear, {{0.5, ""}}};
  plot.series.push_back({"", Hue::text, map});
  return plot;
}

std::string TitleAt(const SimulationView& view, Index sample) {
  const FitView& fit = view.fit;
  return fmt::format("After {} {}: E = {} {}", SignificantText(fit.time[sample] / TimeUnit(fit), 2),
                     TimeUnitName(fit), SignificantText(fit.energy[sample], 2), fit.torque_unit);
}

std::string RobotTitle(const SimulationView& view) {
  return fmt::format("{}, {}: heat and the torque that it changes",
                     std::filesystem::path(view.scenario.robot).stem().string(),
                     view.scenario.joint);
}

}  // namespace

bool HasWarmRobot(const SimulationView& view) {
  return view.scenario.plant == PlantKind::mujoco && view.fit.warms() &&
         view.fit.energy.size() > 1 && view.fit.energy.cwiseAbs().maxCoeff() > 0;
}

std::optional<std::vector<Image>> RenderWarmRobot(const SimulationView& view, GlContext& context,
                                                  const std::vector<Index>& samples, int width,
                                                  int height, const Theme& theme) {
  if (!HasWarmRobot(view)) return std::nullopt;
  Model robot(view.scenario, FindRobot(view.scenario.robot, view.scenario.name));
  RobotRenderer renderer(context, robot.model(), width, height);
  // near enough to fill the picture, far enough for all of its positions
  ViewFrom from;
  double reach = 0;
  for (Index sample : samples) {
    robot.Set(view.fit.position[sample], {});
    reach = std::max(reach, renderer.Reach(robot.data(), from));
  }
  from.distance *= reach / kFilled;
  // the link has the colour of its heat at each moment
  std::vector<Image> images;
  for (Index sample : samples) {
    const double heat = std::abs(view.fit.energy[sample]) / LargestEnergy(view);
    robot.Set(view.fit.position[sample], HeatColour(heat));
    images.push_back(renderer.Draw(robot.data(), from, theme.background));
  }
  return images;
}

std::optional<Figure> MakeWarmRobot(const SimulationView& view, GlContext& context) {
  if (!HasWarmRobot(view)) return std::nullopt;
  // the robot at the begin and at its warmest
  const Index warmest = WarmestSample(view);
  const auto images = RenderWarmRobot(view, context, {0, warmest}, 860, 600, LightTheme());

  Figure figure;
  figure.name = "warm_robot";
  figure.title = RobotTitle(view);
  figure.subtitle = fmt::format("{}; the joint's link has the colour of {}", view.scenario.name,
                                WarmestEnergy(view.fit) < 0 ? "−E" : "E");
  // how much its own heat changes the friction, and when
  figure.finding = fmt::format(
      "The joint's own heat changes its friction by {} {} at most, after {} {}.",
      SignificantText(view.fit.energy[warmest]), view.fit.torque_unit,
      SignificantText(view.fit.time[warmest] / TimeUnit(view.fit), 2), TimeUnitName(view.fit));
  figure.height = 800;
  figure.rows = {2.3, 1.9, 0.8};
  figure.columns = {1, 1};
  // robots above, torque and heat over the same time below
  figure.panels = {{TitleAt(view, 0), Picture{(*images)[0]}, 0, 0},
                   {TitleAt(view, warmest), Picture{(*images)[1]}, 0, 1},
                   {"", TorquePanel(view), 1, 0, 1, 2},
                   {"", HeatStrip(view), 2, 0, 1, 2}};
  return figure;
}

}  // namespace warmjoint::report
