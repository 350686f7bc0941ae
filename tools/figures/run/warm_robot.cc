#include "tools/figures/run/warm_robot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"
#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/symbols.h"
#include "tools/scene/robot_renderer.h"

namespace warmjoint::figures {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kFilled = 0.94;  // share of the picture that the robot reaches over
constexpr scene::Rgb kPaper{255, 255, 255};
// blue, pale, red: told apart by colour-blind readers
constexpr std::array<scene::Rgb, 5> kColdToHot{
    {{33, 102, 172}, {127, 166, 201}, {217, 195, 174}, {232, 137, 95}, {178, 24, 43}}};

/// A robot with one joint that moves and warms.
class Model {
 public:
  Model(const Scenario& scenario, const std::string& path)
      : model_(LoadModel(path).model), data_(mj_makeData(model_.get())) {
    const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, scenario.joint.c_str());
    if (joint < 0) Refuse({path}, "has no joint '{}'", scenario.joint);
    joint_ = joint;
    body_ = model_->jnt_bodyid[joint];
    // light from everywhere, so that shades stay near the colours of the scale
    for (int c = 0; c < 3; ++c) {
      model_->vis.headlight.ambient[c] = 0.45f;
      model_->vis.headlight.diffuse[c] = 0.5f;
      model_->vis.headlight.specular[c] = 0;
    }
  }

  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }
  /// Of the joint, where the robot was put.
  scene::AxisLine axis() const {
    scene::AxisLine line;
    std::copy_n(&data_->xanchor[3 * joint_], 3, line.middle.begin());
    std::copy_n(&data_->xaxis[3 * joint_], 3, line.direction.begin());
    return line;
  }

  /// Puts the joint somewhere (rad or m) and paints its link.
  void Set(double position, scene::Rgb colour) {
    data_->qpos[model_->jnt_qposadr[joint_]] = position;
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
  int joint_ = 0;
  int body_ = 0;
};

double LargestEnergy(const SimulationView& view) { return std::abs(WarmestEnergy(view.fit)); }

/// sign(v) F of the truth, which holds no gravity, and as it were without warming.
Plot FrictionPanel(const SimulationView& view) {
  const FitView& fit = view.fit;
  const VectorXd direction = fit.velocity.array().sign();
  // the friction at the kept samples, in the direction of motion
  const auto kept = [&](const VectorXd& all) { return KeptOf(fit, all); };
  const VectorXd time = kept(fit.time) / TimeUnit(fit);
  const VectorXd friction = view.recording.truth.force.cwiseProduct(direction);
  // less E it is what a joint that stays cold would need
  const VectorXd cold = friction - fit.energy;

  Plot plot;
  plot.series = {{"friction", Hue::grey, Scatter{time, kept(friction), 1}},
                 {"its mean at each speed", Hue::text, SegmentMeans(fit, friction)},
                 {"the mean if it had stayed cold", Hue::blue, SegmentMeans(fit, cold)}};
  plot.x = TimeAxis(fit);
  plot.y =
      BulkAxis(TorqueLabel(fit, "friction · sign(v)"), {kept(friction), SegmentMeans(fit, cold).y});
  return plot;
}

/// |E| over time as a strip in the colours of the robot's link.
Plot HeatStrip(const SimulationView& view) {
  constexpr Index kCells = 240;
  const FitView& fit = view.fit;
  HeatMap map{Eigen::MatrixXd(1, kCells),
              {0, TimeAxis(fit).upper},
              {0, 1},
              {0, LargestEnergy(view)},
              TorqueLabel(fit, WarmestEnergy(fit) < 0 ? "−E" : "E")};
  for (const scene::Rgb& colour : kColdToHot) {
    map.colours.push_back(
        fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue));
  }
  // the size of E at places spread over the recording
  for (Index i = 0; i < kCells; ++i) {
    map.values(0, i) = std::abs(fit.energy[i * (fit.energy.size() - 1) / (kCells - 1)]);
  }
  Plot plot;
  // the panel below has the time
  plot.x = {"", map.x.first, map.x.second, Scale::linear, {{0, ""}}};
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
  return fmt::format("{}, {}: heat and the friction that it changes",
                     std::filesystem::path(view.scenario.robot).stem().string(),
                     view.scenario.joint);
}

}  // namespace

bool HasWarmRobot(const SimulationView& view) {
  return view.scenario.plant == PlantKind::mujoco && view.fit.warms() &&
         view.fit.energy.size() > 1 && LargestEnergy(view) > 0;
}

scene::Rgb HeatColour(double fraction) {
  constexpr int kSteps = static_cast<int>(kColdToHot.size()) - 1;
  // between two of them they are mixed
  const double place = kSteps * std::clamp(fraction, 0.0, 1.0);
  const int lower = std::min(kSteps - 1, static_cast<int>(place));
  const scene::Rgb& below = kColdToHot[static_cast<std::size_t>(lower)];
  const scene::Rgb& above = kColdToHot[static_cast<std::size_t>(lower) + 1];
  const auto mix = [&](std::uint8_t scene::Rgb::*channel) {
    const double share = place - lower;
    return static_cast<std::uint8_t>(
        std::lround((1 - share) * (below.*channel) + share * (above.*channel)));
  };
  return {mix(&scene::Rgb::red), mix(&scene::Rgb::green), mix(&scene::Rgb::blue)};
}

std::optional<std::vector<scene::Image>> RenderWarmRobot(const SimulationView& view,
                                                         scene::GlContext& context,
                                                         const std::vector<Index>& samples,
                                                         int width, int height) {
  if (!HasWarmRobot(view)) return std::nullopt;
  Model robot(view.scenario, FindRobot(view.scenario.robot, view.scenario.name));
  scene::RobotRenderer renderer(context, robot.model(), width, height);
  // one view that all of its positions fill; perspective changes with the distance, so a few times
  scene::ViewFrom from;
  for (int round = 0; round < 3; ++round) {
    scene::Covered covered;
    for (Index sample : samples) {
      robot.Set(view.fit.position[sample], {});
      covered.Join(renderer.Box(robot.data(), from));
    }
    from = renderer.Closer(from, covered, kFilled);
  }
  // the link has the colour of its heat at each moment
  std::vector<scene::Image> images;
  for (Index sample : samples) {
    const double heat = std::abs(view.fit.energy[sample]) / LargestEnergy(view);
    robot.Set(view.fit.position[sample], HeatColour(heat));
    images.push_back(renderer.Draw(robot.data(), from, kPaper, robot.axis()));
  }
  return images;
}

std::optional<Figure> MakeWarmRobot(const SimulationView& view, scene::GlContext& context) {
  if (!HasWarmRobot(view)) return std::nullopt;
  // the robot at the begin and at its warmest
  const Index warmest = WarmestSample(view.fit);
  const auto images = RenderWarmRobot(view, context, {0, warmest}, 880, 640);
  const auto picture = [](const scene::Image& image) { return Picture{scene::EncodePng(image)}; };

  // how much its own heat changes the friction, and when
  Figure figure{
      "warm_robot", RobotTitle(view),
      fmt::format("{}; the joint's link has the colour of {}", view.scenario.name,
                  WarmestEnergy(view.fit) < 0 ? "−E" : "E"),
      fmt::format("The joint's own heat changes its friction by {} {} at most, after {} {}.",
                  SignificantText(view.fit.energy[warmest]), view.fit.torque_unit,
                  SignificantText(view.fit.time[warmest] / TimeUnit(view.fit), 2),
                  TimeUnitName(view.fit))};
  figure.height = 0;
  figure.rows = {340, 60, 260};
  figure.columns = {1, 1};
  // robots above, heat and friction over the same time below
  figure.panels = {{TitleAt(view, 0), picture((*images)[0]), 0, 0},
                   {TitleAt(view, warmest), picture((*images)[1]), 0, 1},
                   {"", HeatStrip(view), 1, 0, 1, 2},
                   {"", FrictionPanel(view), 2, 0, 1, 2}};
  return figure;
}

}  // namespace warmjoint::figures
