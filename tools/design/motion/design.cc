// From what is asked to a motion and what its log will tell.
#include <fmt/format.h>
#include <warmjoint/design.h>
#include <warmjoint/identify.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>

#include "identification/estimate.h"
#include "identification/fields/fit_fields.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/identifiers/structures.h"
#include "identification/linear/linear_laws.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "scenarios/scenario.h"
#include "sim/plant/plant.h"
#include "tools/design/motion/design_joint.h"
#include "tools/design/search_speeds.h"
#include "tools/design/until.h"

namespace warmjoint {
namespace {

constexpr int kDraws = 9;
constexpr double kRelativeNoise =
    0.02;                          // of the friction's level, where nothing is said of the noise
constexpr int kParts = 8;          // of the motion, after which answers are foretold
constexpr int kRandomMotions = 5;  // why: the median of so many

/// The largest friction of a cold joint at a speed, N.m or N.
double Level(const Friction& friction, double speed) {
  const Law& law = *FindLaw(friction.law);
  std::vector<double> values;
  for (const ParameterInfo& one : law.parameters) {
    values.push_back(friction.parameters.at(std::string(one.name)));
  }
  return std::max(std::abs(law.force(speed, values.data())),
                  std::abs(law.force(-speed, values.data())));
}

/// The settings with a fastest speed at which no friction of the prior needs more than the torque.
DesignSettings WithinTorque(DesignSettings settings, const std::vector<Friction>& frictions) {
  auto& [slowest, fastest] = settings.limits.velocity;
  if (!settings.limits.torque) return settings;
  const double torque = *settings.limits.torque;
  for (const Friction& friction : frictions) {
    if (Level(friction, slowest) > torque) {
      Refuse({"--limits"},
             "torque is {:g}, and friction alone takes {:g} at the slowest speed, {:g}; raise it, "
             "or lower velocity",
             torque, Level(friction, slowest), slowest);
    }
    // halve the range until it is as narrow as no drive resolves
    double allowed = slowest, beyond = fastest;
    if (Level(friction, fastest) <= torque) continue;
    for (int i = 0; i < 40; ++i) {
      const double middle = (allowed + beyond) / 2;
      (Level(friction, middle) <= torque ? allowed : beyond) = middle;
    }
    fastest = allowed;
  }
  if (!(fastest > 1.2 * slowest)) {
    Refuse({"--limits"},
           "torque {:g} leaves speeds from {:g} to {:g}, too few to tell friction over speed; "
           "raise it, or lower the slowest velocity",
           torque, slowest, fastest);
  }
  return settings;
}

/// Refuses limits in which no stroke reaches its speed.
void CheckRoom(const DesignSettings& settings) {
  const MotionLimits& limits = settings.limits;
  if (!limits.position) return;
  const double room = (*limits.position)[1] - (*limits.position)[0];
  const double fastest = limits.velocity[1];
  // why: a stroke that holds its speed as long as its ramps last
  const double needed = 3 * fastest * fastest / limits.acceleration;
  if (room / 2 >= needed) return;
  Refuse({"--limits"},
         "position leaves {:g} {}; strokes at {:g} need {:g} with this acceleration: widen it, "
         "lower velocity to {:g}, or raise acceleration",
         room, kPositionUnit.For(settings.joint), fastest, 2 * needed,
         std::sqrt(room / 6 * limits.acceleration));
}

/// A log of the motion.
Simulation Carried(const DesignSettings& settings, const Friction& friction, double noise,
                   const std::vector<MotionKnot>& knots) {
  Scenario scenario;
  scenario.name = "design";
  scenario.joint_kind = settings.joint;
  scenario.friction = friction;
  scenario.motion.start = knots.front().position;
  for (const MotionKnot& knot : knots)
    scenario.motion.corners.push_back({knot.time, knot.velocity});
  scenario.noise.torque = noise;
  scenario.sampling.rate = settings.rate;
  scenario.sampling.sensor_rate = settings.rate;
  scenario.duration = knots.back().time;
  scenario.seed = settings.seed;
  return MakeIdealPlant(scenario)->Run(0);
}

IdentifySettings IdentifyAs(const DesignSettings& settings) {
  IdentifySettings identify;
  identify.identifier = settings.identifier;
  identify.start = settings.start;
  return identify;
}

/// What the identifier answers after each part of the motion, behind an earlier log.
std::vector<ForetoldAnswer> Foretell(const DesignSettings& settings, const PreparedLog& log,
                                     const std::optional<PreparedLog>& after,
                                     const std::function<void(const std::string&)>& watch) {
  std::vector<ForetoldAnswer> foretold;
  for (int part = 1; part <= kParts; ++part) {
    const double minutes = settings.minutes * part / kParts;
    if (watch) watch(fmt::format("foretelling the answer after {:.3g} min", minutes));
    PreparedLog seen = part < kParts ? log.Before(60 * minutes) : log;
    if (after) seen = Join({*after, seen});
    const Estimate estimate = Identify(seen, IdentifyAs(settings), {.fraction = 0});
    foretold.push_back({minutes, estimate.status, estimate.message, estimate.parameters,
                        estimate.friction_at_speeds});
  }
  return foretold;
}

/// Minutes after which the aim's share is reached, between two foretold answers on a straight line of the logarithms.
std::optional<double> MinutesUntil(const DesignAim& aim,
                                   const std::vector<ForetoldAnswer>& foretold) {
  if (!aim.share) return std::nullopt;
  std::optional<std::pair<double, double>> before;
  for (const ForetoldAnswer& one : foretold) {
    const auto half = HalfWidthShare(one, aim);
    if (!half) continue;
    if (*half <= *aim.share) {
      if (!before || before->second <= *half) return one.minutes;
      const double part = std::log(before->second / *aim.share) / std::log(before->second / *half);
      return before->first * std::pow(one.minutes / before->first, part);
    }
    before = {one.minutes, *half};
  }
  return std::nullopt;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Between samples, s.
std::vector<double> StepsOf(const PreparedLog& log) {
  const Eigen::VectorXd& time = log.raw().measurements.time;
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  return steps;
}

/// Deviations of the design over those of other motions.
std::vector<DesignRatio> Compare(const SpeedSearch& search, const std::vector<MotionKnot>& knots) {
  const DesignSettings& settings = search.settings;
  const std::vector<AimCost> costs = CostsOf(search);
  const auto laid_out = [&](const std::vector<SpeedBlock>& blocks) {
    return LayOut(blocks, settings.limits, settings.hold);
  };
  std::vector<std::vector<MotionKnot>> random;
  for (std::uint64_t draw = 1; draw <= kRandomMotions; ++draw) {
    random.push_back(laid_out(RandomSpeeds(settings, draw)));
  }
  const std::vector<std::pair<std::string, std::vector<std::vector<MotionKnot>>>> others{
      {"random speeds", random}, {"ladder", {laid_out(LadderOfSpeeds(settings))}}};
  std::vector<DesignRatio> ratios;
  for (const auto& [name, motions] : others) {
    DesignRatio ratio{name, 1, 0};
    for (size_t j = 0; j < costs.size(); ++j) {
      const PossibleJoint& joint = search.joints[j];
      std::vector<double> theirs;
      for (const auto& motion : motions) theirs.push_back(CostOf(motion, search, costs[j], joint));
      const double over = std::exp(CostOf(knots, search, costs[j], joint) - Median(theirs));
      if (j == 0) ratio.middle = over;
      ratio.worst = std::max(ratio.worst, over);
    }
    ratios.push_back(ratio);
  }
  return ratios;
}

/// What is expected after an earlier log: its answer's friction, with what it leaves open; and its noise where nothing is said of that.
DrawnFriction PriorAfter(const PreparedLog& after, DesignSettings& settings) {
  const Estimate estimate = Identify(after, IdentifyAs(settings), {.fraction = 0});
  if (estimate.status != Status::ok || !estimate.friction) {
    Refuse({"--after"}, "the log alone gives no friction ({}): {}; say what is expected by --prior",
           NameOf(estimate.status), estimate.message);
  }
  if (!settings.noise && estimate.metrics) settings.noise = estimate.metrics->rmse;
  DrawnFriction prior;
  prior.friction = *estimate.friction;
  const Node node(EstimateToTree(estimate), "--after");
  if (estimate.covariance) prior.draws.posterior = PosteriorOfEstimate(node, prior.friction);
  return prior;
}

/// Whether the fits of an identifier have a curve over the speed beside the law.
bool FitsCurve(const std::string& identifier) {
  const Options& options = FindIdentifier(identifier).options;
  const auto* of_auto = options.Find<AutoOptions>();
  const auto fields = of_auto ? of_auto->fields : options.OrDefault<FieldOption>().fields;
  return std::ranges::find(fields.kinds, FieldKind::speed_friction) != fields.kinds.end();
}

/// The prior's draws as the search sees them, behind an earlier log.
std::vector<PossibleJoint> JointsOf(const DesignSettings& settings,
                                    const std::vector<Friction>& frictions,
                                    const std::optional<PreparedLog>& after) {
  std::vector<PossibleJoint> joints;
  std::optional<std::array<double, 2>> curve;
  if (FitsCurve(settings.identifier)) curve = settings.limits.velocity;
  for (const Friction& friction : frictions) {
    joints.emplace_back(friction, settings.start, *settings.noise, settings.rate, curve);
  }
  const double cell = CellLength(settings, joints);
  for (PossibleJoint& joint : joints) {
    if (after) joint.Know(CellsOf(after->constant_speed(), cell));
  }
  return joints;
}

/// What the motion tells of each draw.
std::vector<DesignDraw> DrawsOf(const SpeedSearch& search, const std::vector<MotionKnot>& knots) {
  const MotionCells cells = CellsOf(knots, CellLength(search.settings, search.joints));
  std::vector<DesignDraw> draws;
  for (const PossibleJoint& joint : search.joints) {
    DesignDraw& draw = draws.emplace_back(DesignDraw{joint.friction()});
    const Eigen::VectorXd deviations = Deviations(joint, cells);
    for (size_t i = 0; i < joint.names().size(); ++i) {
      draw.deviations.emplace_back(joint.names()[i], deviations[static_cast<Eigen::Index>(i)]);
    }
  }
  return draws;
}

}  // namespace

void TakeNoiseOf(const PreparedLog& log, DesignSettings& settings) {
  const Estimate estimate = Identify(log, IdentifyAs(settings), {.fraction = 0});
  if (!estimate.metrics || !(estimate.metrics->rmse > 0)) {
    Refuse({log.raw().measurements.source},
           "gives no noise ({}): {}; give the standard deviation of a torque sample by --noise",
           NameOf(estimate.status), estimate.message);
  }
  settings.noise = estimate.metrics->rmse;
  // a clock's rounding is no rate
  settings.rate = std::round(1e6 / Median(StepsOf(log))) / 1e6;
}

ExpectedJoint Expect(const DesignSettings& asked, const std::optional<PreparedLog>& after) {
  ExpectedJoint expected{asked, {}, {}, after};
  DesignSettings& settings = expected.settings;
  const DrawnFriction prior =
      after && asked.prior.empty() ? PriorAfter(*after, settings) : PriorOf(settings);
  expected.frictions = Representatives(prior, asked.seed, kDraws);
  settings = WithinTorque(settings, expected.frictions);
  CheckRoom(settings);
  if (!settings.noise) {
    settings.noise = kRelativeNoise * Level(prior.friction, settings.limits.velocity[0]);
  }
  expected.joints = JointsOf(settings, expected.frictions, after);
  return expected;
}

double ExpectedJoint::Level(double speed) const {
  double level = 0;
  for (const Friction& friction : frictions) {
    level = std::max(level, warmjoint::Level(friction, speed));
  }
  return level;
}

std::vector<SpeedBlock> BestBlocks(const ExpectedJoint& expected, const WatchDesign& watch) {
  SpeedSearch search{expected.settings, expected.joints};
  if (watch) {
    search.watch = [&watch](double share) {
      watch(fmt::format("{:.0f} % of the search", 100 * share));
    };
  }
  return SearchSpeeds(search);
}

Design Foretold(const ExpectedJoint& expected, std::vector<MotionKnot> knots,
                const WatchDesign& watch) {
  // of the middle by the identifier itself, of all draws by the information
  Design design;
  design.settings = expected.settings;
  design.knots = std::move(knots);
  const SpeedSearch search{expected.settings, expected.joints};
  const Simulation made = Carried(expected.settings, expected.frictions.front(),
                                  *expected.settings.noise, design.knots);
  design.foretold = Foretell(expected.settings, Prepare(made.measurements), expected.after, watch);
  design.enough = MinutesUntil(expected.settings.aim, design.foretold);
  design.ratios = Compare(search, design.knots);
  design.draws = DrawsOf(search, design.knots);
  return design;
}

Design DesignMotion(const DesignSettings& asked, const std::optional<PreparedLog>& after,
                    const std::function<void(const std::string& words)>& watch) {
  const ExpectedJoint expected = Expect(asked, after);
  const std::vector<SpeedBlock> blocks = BestBlocks(expected, watch);
  return Foretold(expected, LayOut(blocks, expected.settings.limits, expected.settings.hold),
                  watch);
}

}  // namespace warmjoint
