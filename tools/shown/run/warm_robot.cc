#include "tools/shown/run/warm_robot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "models/robots/robot_folder.h"
#include "sim/model/load_model.h"

namespace warmjoint::shown {
namespace {

using Eigen::Index;

constexpr double kFilled = 0.9;  // share of the picture that the robot reaches over
constexpr scene::Rgb kPaper{255, 255, 255};

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
  /// A point that many m along the joint's axis, and that far from it, at an angle about it.
  std::array<double, 3> Near(double along, double away, double angle) const {
    const double* axis = &data_->xaxis[3 * joint_];
    mjtNum turn[4], rotation[9];
    const mjtNum up[3] = {0, 0, 1};
    // a frame whose third axis is that of the joint
    mju_quatZ2Vec(turn, axis);
    if (std::abs(mju_dot3(up, axis)) > 1 - 1e-9) mju_quatZ2Vec(turn, up);
    mju_quat2Mat(rotation, turn);
    std::array<double, 3> point{};
    for (int i = 0; i < 3; ++i) {
      point[static_cast<std::size_t>(i)] =
          data_->xanchor[3 * joint_ + i] + along * axis[i] +
          away * (std::cos(angle) * rotation[3 * i] + std::sin(angle) * rotation[3 * i + 1]);
    }
    return point;
  }
  bool slides() const { return model_->jnt_type[joint_] == mjJNT_SLIDE; }
  double extent() const { return model_->stat.extent; }

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

/// The axis and an arrow's course about or along it, in the picture drawn last.
void MarkJoint(const Model& robot, const scene::RobotRenderer& renderer, RobotPicture& picture) {
  constexpr int kPoints = 25;
  const double reach = 0.2 * robot.extent(), away = 0.11 * robot.extent();
  for (const double along : {-reach, reach}) {
    picture.axis.push_back(renderer.PlaceOf(robot.Near(along, 0, 0)));
  }
  // three quarters of a turn at the near end, or a line beside the axis
  for (int i = 0; i < kPoints; ++i) {
    const double share = static_cast<double>(i) / (kPoints - 1);
    const auto point = robot.slides() ? robot.Near(reach * (2 * share - 1), away, 0)
                                      : robot.Near(reach, away, 1.5 * std::numbers::pi * share);
    picture.arc.push_back(renderer.PlaceOf(point));
  }
}

/// Pixels as one number each, [height x width].
Eigen::MatrixXd NumbersOf(const scene::Image& image) {
  Eigen::MatrixXd numbers(image.height, image.width);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const scene::Rgb pixel = image.At(x, y);
      numbers(y, x) = 65536.0 * pixel.red + 256.0 * pixel.green + pixel.blue;
    }
  }
  return numbers;
}

Index WarmestSample(const FitView& view) {
  Index at = 0;
  view.energy.cwiseAbs().maxCoeff(&at);
  return at;
}

}  // namespace

bool HasWarmRobot(const SimulationView& view) {
  return view.scenario.plant == PlantKind::mujoco && view.fit.warms() &&
         view.fit.energy.size() > 1 && LargestEnergy(view) > 0;
}

const std::vector<scene::Rgb>& HeatColours() {
  static const std::vector<scene::Rgb> colours{
      {254, 217, 118}, {253, 174, 78}, {240, 105, 55}, {208, 52, 38}, {127, 0, 20}};
  return colours;
}

scene::Rgb HeatColour(double fraction) {
  const std::vector<scene::Rgb>& colours = HeatColours();
  const int steps = static_cast<int>(colours.size()) - 1;
  // between two of them they are mixed
  const double place = steps * std::clamp(fraction, 0.0, 1.0);
  const int lower = std::min(steps - 1, static_cast<int>(place));
  const scene::Rgb& below = colours[static_cast<std::size_t>(lower)];
  const scene::Rgb& above = colours[static_cast<std::size_t>(lower) + 1];
  const auto mix = [&](std::uint8_t scene::Rgb::*channel) {
    const double share = place - lower;
    return static_cast<std::uint8_t>(
        std::lround((1 - share) * (below.*channel) + share * (above.*channel)));
  };
  return {mix(&scene::Rgb::red), mix(&scene::Rgb::green), mix(&scene::Rgb::blue)};
}

std::vector<RobotPicture> RenderWarmRobot(const SimulationView& view, scene::GlContext& context,
                                          const std::vector<Index>& samples, int width,
                                          int height) {
  Model robot(view.scenario, FindRobot(view.scenario.robot, view.scenario.name));
  scene::RobotRenderer renderer(context, robot.model(), width, height);
  // one view that all of its positions fill; perspective changes with the distance, so a few times
  scene::ViewFrom from;
  for (int round = 0; round < 3; ++round) {
    scene::Covered covered;
    for (const Index sample : samples) {
      robot.Set(view.fit.position[sample], {});
      covered.Join(renderer.Box(robot.data(), from));
    }
    from = renderer.Closer(from, covered, kFilled);
  }
  // the link has the colour of its heat at each moment
  std::vector<RobotPicture> pictures;
  for (const Index sample : samples) {
    const double heat = std::abs(view.fit.energy[sample]) / LargestEnergy(view);
    robot.Set(view.fit.position[sample], HeatColour(heat));
    RobotPicture& picture = pictures.emplace_back();
    picture.image = renderer.Draw(robot.data(), from, kPaper);
    MarkJoint(robot, renderer, picture);
  }
  return pictures;
}

Tree WarmRobotFacts(const SimulationView& view, scene::GlContext& context, ShownData& data) {
  constexpr int kWidth = 880, kHeight = 640;
  Tree facts{{"robot", std::filesystem::path(view.scenario.robot).stem().string()},
             {"joint", view.scenario.joint},
             {"colours", Tree::array()},
             {"pictures", Tree::array()}};
  for (const scene::Rgb& colour : HeatColours()) {
    facts["colours"].push_back(
        fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue));
  }
  // the robot at the begin and at its warmest
  const std::vector<Index> samples{0, WarmestSample(view.fit)};
  const auto pictures = RenderWarmRobot(view, context, samples, kWidth, kHeight);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    facts["pictures"].push_back({{"time", view.fit.time[samples[i]]},
                                 {"energy", view.fit.energy[samples[i]]},
                                 {"pixels", data.Hold(NumbersOf(pictures[i].image))},
                                 {"axis", pictures[i].axis},
                                 {"arc", pictures[i].arc}});
  }
  return facts;
}

}  // namespace warmjoint::shown
