// Fits: a small log of a simulated joint is made of the input, prepared, fitted by an identifier with options, judged, held out,
// written, read back and held against the log again. Each byte of the input makes one choice, in the order of `Recipe`; what the
// input lacks counts as 0.
#include "identification/answer/identify.h"

#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "identification/answer/check_estimate.h"
#include "identification/estimate.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "models/foundation/node.h"
#include "models/foundation/random_stream.h"
#include "models/friction/along_motion.h"
#include "models/friction/laws.h"
#include "models/recording/measurements.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;
using fuzz::Require;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The input, byte by byte.
class Recipe {
 public:
  explicit Recipe(std::string_view bytes) : bytes_(bytes) {}

  /// 0 to 255; 0 where the input has ended.
  int Next() {
    if (bytes_.empty()) return 0;
    const int byte = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return byte;
  }
  /// 0, ..., count - 1
  int Below(int count) { return Next() % count; }
  template <class T, std::size_t N>
  T OneOf(const std::array<T, N>& values) {
    return values[static_cast<std::size_t>(Below(static_cast<int>(N)))];
  }
  /// From lower to upper, even in its logarithm.
  double Between(double lower, double upper) {
    return lower * std::pow(upper / lower, Next() / 255.0);
  }

 private:
  std::string_view bytes_;
};

// --- the log -------------------------------------------------------------------------------------------------------------

/// The velocity of one of the kinds of motion that logs have. [n] rad/s
VectorXd MotionOf(Recipe& recipe, Index n, double h, RandomStream& random) {
  const int kind = recipe.Below(10);
  const double fastest = recipe.Between(0.01, 10), hold = recipe.Between(0.2, 20);
  const Index each = std::max<Index>(std::llround(hold / h), 1);
  const ArrayXd t = h * ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  VectorXd v = VectorXd::Zero(n);
  double level = fastest;
  for (Index i = 0; i < n; ++i) {
    const bool begins = i % each == 0;
    if (begins) level = std::copysign(random.Uniform(0.05, 1) * fastest, -level);
    switch (kind) {
      case 0:  // holds, of alternating sign
        v[i] = level;
        break;
      case 1:  // holds in one direction
        v[i] = std::abs(level);
        break;
      case 2:  // one speed in both directions
        v[i] = std::copysign(fastest, level);
        break;
      case 3:  // one speed, one direction
        v[i] = fastest;
        break;
      case 4:  // holds with rests between them
        v[i] = i / each % 2 == 0 ? level : 0;
        break;
      case 5:  // at rest but for a few samples
        v[i] = i % 50 == 7 ? fastest : 0;
        break;
      case 6:  // a sine
        v[i] = fastest * std::sin(6.3 * t[i] / hold);
        break;
      case 7:  // several sines, as of a hand
        v[i] = fastest * (0.6 * std::sin(3.1 * t[i] / hold) + 0.5 * std::sin(7.7 * t[i] / hold) +
                          0.3 * std::sin(19 * t[i] / hold));
        break;
      case 8:  // several sines with pauses
        v[i] = i / each % 3 == 2 ? 0 : fastest * std::sin(6.3 * t[i] / (0.37 * hold));
        break;
      default:  // at rest
        break;
    }
  }
  return v;
}

/// A friction with or without warming, a load gain of 0 as often as not.
Friction JointOf(Recipe& recipe) {
  const double coulomb = recipe.Between(0.01, 100);
  const Law& law = Laws()[static_cast<std::size_t>(recipe.Below(static_cast<int>(Laws().size())))];
  Friction friction{std::string(law.name), {}, {}, 0, 1};
  for (const ParameterInfo& one : law.parameters) {
    // levels and slopes of the size of the Coulomb friction; what has no usual value is a stiffness or damping
    double value = one.default_value > 0 ? one.default_value : 100 * coulomb;
    if (one.part != LawPart::other && one.part != LawPart::bristle) value = coulomb;
    if (one.part == LawPart::rest_level) value = 1.3 * coulomb;
    friction.parameters[std::string(one.name)] = value;
  }
  const Thermal thermal{-recipe.Between(0.01, 5), recipe.Between(1, 1000)};
  const double load_gain = recipe.Between(0.001, 1);
  const int has = recipe.Next();
  if (has & 1) friction.thermal = thermal;
  if (has & 2) friction.load_gain = load_gain;
  return friction;
}

/// What real logs are spoilt by.
void Spoil(Recipe& recipe, Measurements& m) {
  const Index n = m.size();
  const Index at = n * recipe.Below(100) / 100;
  switch (recipe.Below(16)) {
    case 0:
      m.torque.setZero();
      break;
    case 1:
      m.torque = -m.torque;
      break;
    case 2:
      m.torque *= 1e-9;
      break;
    case 3:
      m.torque[at] = kNaN;
      break;
    case 4:
      m.torque[at] += 1e6;
      break;
    case 5:
      m.time.tail(n - at).array() += 1000;
      break;
    case 6:
      m.time.array() += 1.7e9;
      break;
    case 7:
      m.velocity *= 57.3;
      break;
    case 8:
      m.torque.tail(n - at).setConstant(m.torque[at]);
      break;
    case 9:
      m.velocity.resize(0);  // a log of positions
      break;
    default:
      break;
  }
}

/// Further columns, and a torque and positions in steps.
void AddColumns(Recipe& recipe, const VectorXd& load, Measurements& m) {
  if (const double step = recipe.OneOf(std::array{0.0, 0.0, 0.001, 0.1}); step > 0) {
    m.position = (m.position / step).array().round() * step;
  }
  if (const double step = recipe.OneOf(std::array{0.0, 0.0, 0.01, 5.0}); step > 0) {
    m.torque = (m.torque / step).array().round() * step;
  }
  const int more = recipe.Next();
  if (more & 1) m.load = load;
  if (more & 2) m.temperature = (30 + 0.01 * m.time.array()).matrix();
  if (more & 4) m.motor_position = (50.3 * m.position).eval();
  if (more & 8) m.gear = 50.3;
  if (more & 16) {
    m.joint = JointKind::linear;
    m.torque_unit = "N";
  }
}

Measurements LogOf(Recipe& recipe) {
  const Index n = 3 + 2 * recipe.Next();
  const double h = recipe.OneOf(std::array{0.01, 0.05, 0.2, 1.0});
  RandomStream random({static_cast<std::uint64_t>(recipe.Next()), 0}, Stream::test);
  Measurements m;
  m.source = "fuzz";
  m.time = h * VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  m.velocity = MotionOf(recipe, n, h, random);
  m.position = VectorXd::Zero(n);
  for (Index i = 1; i < n; ++i) m.position[i] = m.position[i - 1] + h * m.velocity[i - 1];

  // friction, gravity, inertia and noise
  const Friction friction = JointOf(recipe);
  const double weight = recipe.OneOf(std::array{0.0, 0.5, 8.0}),
               mass = recipe.OneOf(std::array{0.0, 0.01, 1.0});
  const VectorXd gravity = weight * (m.position.array().sin() - 0.3 * m.position.array().cos());
  JointTrajectory motion{m.time, m.velocity, m.position, m.position};
  motion.load = gravity;
  m.torque = AlongMotion(friction).Predict(motion).force + gravity;
  for (Index i = 1; i < n; ++i) m.torque[i] += mass * (m.velocity[i] - m.velocity[i - 1]) / h;
  const double noise = recipe.OneOf(std::array{0.0, 1e-6, 0.01, 0.3, 30.0});
  const double of_velocity = recipe.OneOf(std::array{0.0, 0.0, 0.01});
  for (double& torque : m.torque) torque += noise * random.Normal();
  for (double& v : m.velocity) v += of_velocity * random.Normal();
  AddColumns(recipe, gravity, m);
  Spoil(recipe, m);
  return m;
}

// --- the answer ----------------------------------------------------------------------------------------------------------

/// Three of sixteen are auto's, as its fits are those of all.
const Identifier& IdentifierOf(Recipe& recipe) {
  const std::size_t at = static_cast<std::size_t>(recipe.Below(16));
  return at < Identifiers().size() ? Identifiers()[at] : FindIdentifier("auto");
}

/// A value for each option that the identifier has and that changes its model; few kernels, which take less time.
Options OptionsOf(Recipe& recipe, const Identifier& identifier) {
  const std::map<std::string, std::vector<std::string>> choices{
      {"gravity", {"none", "sincos", "paired"}},
      {"load", {"none", "estimated"}},
      {"law", {"viscous_coulomb", "coulomb", "asymmetric"}},
      {"motion", {"chosen", "constant", "any"}},
      {"loss", {"squares", "huber"}},
      {"torque_lag", {"none", "estimated"}},
      {"torque_delay", {"estimated", "none"}},
      {"warming", {"none", "estimated"}},
      {"initial_energy", {"zero", "estimated", "expected"}}};
  std::map<std::string, std::string> given;
  for (const auto& [name, values] : choices) {
    const std::string& value = values[static_cast<std::size_t>(recipe.Next()) % values.size()];
    if (!identifier.options.Has(name)) continue;
    const auto list = identifier.options.List();
    const std::string allowed =
        "|" + std::ranges::find(list, name, &OptionInfo::name)->allowed + "|";
    if (allowed.find("|" + value + "|") != std::string::npos) given[name] = value;
  }
  for (const OptionInfo& option : identifier.options.List()) {
    if (option.name.ends_with("kernels")) given[option.name] = "4";
  }
  return identifier.options.Read(given, {"--set"});
}

/// What every answer owes: a sentence, finite numbers, and no friction where it is not ok.
void RequireHonest(const Estimate& estimate) {
  Require(!estimate.FullMessage().empty());
  Require(estimate.status == Status::ok || !estimate.friction);
  for (const EstimatedParameter& one : estimate.parameters) {
    Require(std::isfinite(one.value) && std::isfinite(one.std.value_or(0)));
    if (!one.interval95) continue;
    Require(std::isfinite((*one.interval95)[0]) && std::isfinite((*one.interval95)[1]));
    Require((*one.interval95)[0] <= (*one.interval95)[1]);
  }
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    Require(std::isfinite(one.value) && std::isfinite(one.std));
  }
}

/// Holds the numbers against a log, as those of another program.
void Recheck(Measurements m, Estimate estimate) {
  CheckEstimate(Prepare(std::move(m)), {}, estimate);
  RequireHonest(estimate);
}

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  Recipe recipe(bytes);
  const Identifier& identifier = IdentifierOf(recipe);
  const Options options = OptionsOf(recipe, identifier);
  const auto start = recipe.OneOf(std::array{StartBelief::cold, StartBelief::unknown});
  const Measurements m = LogOf(recipe);

  // as `identify` does it
  const PreparedLog log = Prepare(m);
  Require(!CheckToText(CheckRecording(log)).empty());
  const IdentifierInput input{log, options, {}};
  Answer answer = FitAndCheck(identifier, input, {.start = start});
  const HeldOut held = HoldOut(identifier, input, 0.3, answer.fit);
  JudgeHeldOut(held, answer);
  const Estimate estimate = ReportAnswer(identifier, input, answer);
  RequireHonest(estimate);
  RequireHonest(IdentifyUnchecked(identifier, input));

  // as `predict` and `compare` read it again, with all of the log's columns and without its load
  const std::string text = EstimateToTree(estimate).dump();
  const Estimate again = EstimateFrom(ParseJsonNode(text, "fuzz.json"));
  Require(EstimateToTree(again).dump() == text);
  Measurements plain = m;
  plain.load.reset();
  Recheck(m, again);
  Recheck(std::move(plain), again);
}
