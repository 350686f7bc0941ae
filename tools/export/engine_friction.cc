#include "tools/export/engine_friction.h"

#include <fmt/format.h>
#include <warmjoint/friction_model.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/foundation/bad_input.h"
#include "models/friction/friction_json.h"
#include "tools/shown/friction_doubt.h"

namespace warmjoint {
namespace {

constexpr int kSpeeds = 17;
constexpr int kPlaces = 64;

/// Speeds of a friction without a log, as shares of the speed at which it settles.
constexpr double kSlowest = 0.1, kFastest = 2;

/// Smaller shares of the mean friction are rounding, percent.
constexpr double kRounding = 1e-9;

/// Creep of frictionloss under a load on an inertia, s: (1 - d) / (d b) with MuJoCo's impedance d = 0.9 and
/// damping b = 2 / (0.95 * 0.02 s), where solreffriction and solimpfriction are at their defaults.
constexpr double kCreepTime = (1 - 0.9) / 0.9 * (0.95 * 0.02) / 2;

/// Places over which maps are averaged, as positions of the joint, rad or m; one where nothing depends on the place.
std::vector<double> PlacesOf(const Friction& friction) {
  double lowest = 0, highest = 0;
  for (const FrictionMap& map : friction.maps) {
    if (const MapAxis* axis = FindAxis(map, MapQuantity::position)) {
      lowest = std::min(lowest, axis->kernels.centres.front());
      highest = std::max(highest, axis->kernels.centres.back());
    }
    // one turn of the motor shows all of it
    if (FindAxis(map, MapQuantity::motor_position)) {
      highest = std::max(highest, lowest + 2 * std::numbers::pi / std::abs(friction.gear));
    }
  }
  if (lowest == highest) return {0};
  std::vector<double> places;
  for (int i = 0; i < kPlaces; ++i) places.push_back(lowest + (highest - lowest) * i / kPlaces);
  return places;
}

/// What a joint brakes with on one side, 1 or -1, at each speed: the mean over the places. N.m or N
struct BothWays {
  Eigen::VectorXd speeds;  // [n] rad/s or m/s
  Eigen::VectorXd forward, backward;

  Eigen::VectorXd Mean() const { return (forward + backward) / 2; }
};

BothWays Brakes(const Friction& friction, const Eigen::VectorXd& speeds, double energy) {
  const FrictionModel model(friction);
  const std::vector<double> places = PlacesOf(friction);
  BothWays sides{speeds, Eigen::VectorXd::Zero(speeds.size()),
                 Eigen::VectorXd::Zero(speeds.size())};
  for (const double position : places) {
    const JointPlace place{.position = position, .energy = energy};
    for (Eigen::Index i = 0; i < speeds.size(); ++i) {
      sides.forward[i] += model.Force(speeds[i], place) / static_cast<double>(places.size());
      sides.backward[i] -= model.Force(-speeds[i], place) / static_cast<double>(places.size());
    }
  }
  return sides;
}

/// Half of the range over the places at one speed, the larger of both directions, N.m or N.
double SwingOverPlaces(const Friction& friction, double speed, double energy) {
  const FrictionModel model(friction);
  double swing = 0;
  for (const double v : {speed, -speed}) {
    double least = kInfinity, most = -kInfinity;
    for (const double position : PlacesOf(friction)) {
      const double force = model.Force(v, {.position = position, .energy = energy});
      least = std::min(least, force);
      most = std::max(most, force);
    }
    swing = std::max(swing, (most - least) / 2);
  }
  return swing;
}

struct Line {
  double slope = 0;  // N.m.s/rad or N.s/m
  double level = 0;  // N.m or N
};

/// Least squares of y over v >= 0 with neither number below 0. Of one speed alone the slope is `slope`.
Line FitLine(const Eigen::VectorXd& v, const Eigen::VectorXd& y, double slope) {
  const double mean_v = v.mean(), mean_y = y.mean();
  const double spread = (v.array() - mean_v).square().sum();
  Line line{slope, 0};
  if (spread > 0) {
    line.slope = ((v.array() - mean_v) * (y.array() - mean_y)).sum() / spread;
  }
  line.slope = std::max(0.0, line.slope);
  line.level = mean_y - line.slope * mean_v;
  if (line.level < 0) {
    line.level = 0;
    line.slope = std::max(0.0, v.dot(y) / v.squaredNorm());
  }
  return line;
}

/// E settled at a speed, all stages together, N.m or N.
double Settled(const SeenFriction& seen, double speed) {
  const auto energies = SettledEnergy(seen.friction, speed);
  if (!energies) {
    Refuse({seen.joint}, "never settles at {} {}: its losses grow for ever; give a smaller --speed",
           speed, kVelocityUnit.For(seen.kind));
  }
  return std::accumulate(energies->begin(), energies->end(), 0.0);
}

/// The level at rest, the mean of both sides, N.m or N.
double AtRest(const Friction& friction, double energy) {
  const Law& law = *FindLaw(friction.law);
  const std::vector<double> values = LawValues(friction);
  return (law.holding_level(1, values.data()) + law.holding_level(-1, values.data())) / 2 + energy;
}

/// What of one joint is told, and by how much it is off.
class Omissions {
 public:
  Omissions(const SeenFriction& seen, double mean, std::vector<Omission>& found)
      : seen_(seen), mean_(mean), found_(found) {}

  /// size: N.m or N; what is rounding is not told.
  void Add(std::string_view what, double size, std::string meaning) {
    const double percent = mean_ > 0 ? 100 * size / mean_ : 0;
    if (std::abs(percent) > kRounding) found_.push_back({std::string(what), percent, meaning});
  }

  void Tell(std::string_view what, std::optional<double> percent, std::string meaning) {
    found_.push_back({std::string(what), percent, std::move(meaning)});
  }

  std::string Torque(double value) const {
    return fmt::format("{:.3g} {}", value, kTorqueUnit.For(seen_.kind));
  }

 private:
  const SeenFriction& seen_;
  double mean_;
  std::vector<Omission>& found_;
};

/// What a held joint does in that engine.
void TellCreep(const SeenFriction& seen, const EngineFriction& found, EngineFormat format,
               Omissions& out) {
  if (HasStaticLevel(format) || format == EngineFormat::ur) return;
  if (format == EngineFormat::urdf) {
    out.Tell("creep", std::nullopt,
             "how a joint holds is the reader's choice; MuJoCo reads frictionloss");
    return;
  }
  const std::string words = fmt::format(
      "frictionloss lets a held joint creep at {:.3g} s times load over effective inertia; noslip "
      "iterations or warmjoint's plugin hold it",
      kCreepTime);
  if (!seen.inertia || !(found.slowest > 0)) return out.Tell("creep", std::nullopt, words);
  // under half of the level, on the joint's own inertia
  const double creep = kCreepTime * found.level / 2 / *seen.inertia;
  out.Tell(
      "creep", 100 * creep / found.slowest,
      fmt::format("{}: {:.3g} {} under half of the level on {:.3g} {}, as a share of the slowest "
                  "speed",
                  words, creep, kVelocityUnit.For(seen.kind), *seen.inertia,
                  seen.kind == JointKind::rotary ? "kg.m^2" : "kg"));
}

void TellLeftOut(const SeenFriction& seen, const BothWays& sides, EngineFormat format,
                 EngineFriction& found) {
  const Friction& friction = seen.friction;
  const Eigen::VectorXd mean = sides.Mean();
  Omissions out(seen, mean.mean(), found.left_out);
  // directions, and what is no straight line over the speed
  const Eigen::VectorXd apart = (sides.forward - sides.backward) / 2;
  out.Add("asymmetry", apart.cwiseAbs().mean(),
          fmt::format("forwards {} more than the mean, backwards as much less",
                      out.Torque(apart.mean())));
  const Eigen::VectorXd line = (found.viscous * sides.speeds).array() + found.level;
  out.Add("speed", std::sqrt((mean - line).squaredNorm() / static_cast<double>(line.size())),
          "friction over speed is no straight line, rms");
  if (!HasStaticLevel(format)) {
    const double rise = found.static_level - found.level;
    out.Add("rest", rise, fmt::format("a joint at rest holds {} more", out.Torque(rise)));
  }

  // heat, place and load
  if (friction.thermal) {
    const double change = Brakes(friction, sides.speeds, Settled(seen, found.speed)).Mean().mean() -
                          Brakes(friction, sides.speeds, 0).Mean().mean();
    out.Add("heat", change,
            fmt::format("from cold to settled at {:.3g} {} friction changes by {}", found.speed,
                        kVelocityUnit.For(seen.kind), out.Torque(change)));
  }
  const double swing =
      SwingOverPlaces(friction, sides.speeds[sides.speeds.size() / 2], found.energy);
  out.Add("position", swing,
          fmt::format("over the place friction swings by {} to both sides", out.Torque(swing)));
  if (friction.load_gain != 0) {
    out.Tell("load", std::nullopt,
             fmt::format("friction grows by {:.3g} of the load", friction.load_gain));
  }
  TellCreep(seen, found, format, out);
}

}  // namespace

SeenFriction SeenOf(const std::string& joint, const Estimate& estimate, const std::string& file) {
  if (!estimate.friction) {
    Refuse({file}, "is {} and holds no friction; identify again with --force to use it anyway",
           StatusName(estimate.status));
  }
  RefuseAmperes(*estimate.friction, {file});
  SeenFriction seen{joint, *estimate.friction};
  seen.doubt = shown::DoubtOf(estimate);
  for (const EstimatedParameter& one : estimate.parameters) {
    const bool linear = one.unit == kTorqueUnit.linear || one.unit == kViscousUnit.linear;
    if (linear) seen.kind = JointKind::linear;
    if (one.name == "inertia" && one.value > 0) seen.inertia = one.value;
    if (one.interval95) seen.intervals[one.name] = *one.interval95;
  }
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    if (one.speed != 0) seen.speeds.push_back(std::abs(one.speed));
    const double half = (one.interval95[1] - one.interval95[0]) / 2;
    if (half > 0) seen.half_width = std::min(half, seen.half_width.value_or(half));
  }
  std::ranges::sort(seen.speeds);
  return seen;
}

EngineFriction InEngine(const SeenFriction& seen, const Warmth& warmth, EngineFormat format) {
  const bool linear = seen.kind == JointKind::linear;
  EngineFriction found{.joint = seen.joint,
                       .kind = seen.kind,
                       .warm = warmth.share,
                       .left_out = {},
                       .half_width = seen.half_width,
                       .inertia = seen.inertia};
  if (!std::isfinite(warmth.share) || warmth.share < 0) {
    Refuse({"--warm"}, "is {}; it must be a number of 0 or more, 1 settled", warmth.share);
  }
  // the speed at which it settles, and those that it is to be right at
  const std::vector<double>& speeds = seen.speeds;
  found.speed = warmth.speed     ? *warmth.speed
                : speeds.empty() ? (linear ? 0.1 : 1)
                                 : speeds[speeds.size() / 2];
  if (!std::isfinite(found.speed) || found.speed <= 0) {
    Refuse({"--speed"}, "is {}; it must be above 0 {}", found.speed, kVelocityUnit.For(seen.kind));
  }
  found.slowest = speeds.empty() ? kSlowest * found.speed : speeds.front();
  found.fastest = speeds.empty() ? kFastest * found.speed : speeds.back();
  if (warmth.share > 0) found.energy = warmth.share * Settled(seen, found.speed);

  const Eigen::VectorXd over = Eigen::VectorXd::LinSpaced(kSpeeds, found.slowest, found.fastest);
  const BothWays sides = Brakes(seen.friction, over, found.energy);
  const auto viscous = seen.friction.parameters.find("viscous");
  const double slope = viscous == seen.friction.parameters.end() ? 0 : viscous->second;
  const Line line = FitLine(over, sides.Mean(), slope);
  found.viscous = line.slope;
  found.level = line.level;
  found.static_level = std::max(line.level, AtRest(seen.friction, found.energy));
  TellLeftOut(seen, sides, format, found);
  return found;
}

}  // namespace warmjoint
