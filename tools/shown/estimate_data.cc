#include "tools/shown/estimate_data.h"

#include <warmjoint/friction.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "identification/alternating/first_guess.h"
#include "identification/estimate.h"
#include "identification/fit/fit_parameters.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lack_of_fit/table.h"
#include "identification/preparation/check.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/evaluate_map.h"
#include "models/friction/thermal.h"
#include "models/recording/measurements.h"
#include "tools/shown/fitted_friction.h"
#include "tools/shown/shown_estimate.h"

namespace warmjoint::shown {
namespace {

/// [name, symbol] of the parameters of all laws, law by law, then those of warming, which is their order in pictures.
Tree SymbolsOfLaws() {
  Tree symbols = Tree::array();
  const auto add = [&](const ParameterInfo& info) { symbols.push_back({info.name, info.symbol}); };
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) add(info);
  }
  for (const ParameterInfo& info : Thermal::parameters) add(info);
  symbols.push_back({kDiscreteGainName, "ke"});
  symbols.push_back({kPoleName, "te"});
  return symbols;
}

Tree RowsOf(const std::vector<EstimatedParameter>& parameters) {
  Tree rows = Tree::array();
  for (const EstimatedParameter& one : parameters) {
    Tree row = WriteFields(one);
    row["name"] = one.name;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Each test with what it asks, what helps, and over what its finding shows.
Tree TestsOf(const Estimate& estimate, bool warms) {
  static constexpr const char* kOver[] = {"time", "position", "velocity", "energy", "motor_angle"};
  Tree tests = Tree::array();
  for (const Diagnostic& one : estimate.diagnostics) {
    const LackOfFitTest* row = FindLackOfFitTest(one.test);
    const SeenOver over = row ? row->over : SeenOver::time;
    const bool cold = over == SeenOver::energy && !warms;
    tests.push_back({{"test", one.test},
                     {"made", one.made},
                     {"reason", one.reason},
                     {"rejected", one.rejected},
                     {"effect", one.effect},
                     {"effect_unit", one.effect_unit},
                     {"p_adjusted", one.p_adjusted},
                     {"question", row ? std::string(row->words.question) : one.test},
                     {"advice", row ? std::string(row->words.advice)
                                    : "The residual shows " + one.test + ": look at its pictures."},
                     {"over", cold ? "time" : kOver[static_cast<int>(over)]}});
  }
  return tests;
}

Tree AssumptionsOf(const Estimate& estimate) {
  Tree rows = Tree::array();
  for (const Assumption& one : ShownAssumptions(estimate)) {
    rows.push_back({{"sentence", one.meaning.empty() ? one.name : AsSentence(one.meaning)},
                    {"moves", Tree::object()}});
    for (const auto& [name, move] : one.moves) rows.back()["moves"][name] = move;
  }
  return rows;
}

/// What is known of the answer, with or without a recording.
Tree AnswerFacts(const Estimate& estimate, bool warms) {
  const auto metrics = [](const std::optional<Metrics>& known) {
    return known ? WriteFields(*known) : Tree();
  };
  Tree trace = Tree::array();
  for (const TraceEntry& entry : estimate.trace) trace.push_back(WriteFields(entry));
  const bool passed = estimate.status == Status::ok;
  return {{"identifier", estimate.identifier},
          {"method", CurrentName(estimate.identifier)},
          {"status", std::string(NameOf(estimate.status))},
          {"message", passed ? estimate.message : estimate.FullMessage()},
          {"warnings", estimate.warnings},
          {"remarks", Remarks(estimate)},
          {"without_holdout", estimate.without_holdout},
          {"metrics", metrics(estimate.metrics)},
          {"holdout", metrics(estimate.holdout)},
          {"parameters", RowsOf(estimate.parameters)},
          {"shown", RowsOf(ShownParameters(estimate))},
          {"symbols", SymbolsOfLaws()},
          {"tests", TestsOf(estimate, warms)},
          {"assumptions", AssumptionsOf(estimate)},
          {"trace", std::move(trace)},
          {"has_gravity", estimate.gravity.has_value()},
          {"has_friction", estimate.friction.has_value()}};
}

/// [begin, end, velocity] of each segment.
Tree SegmentsOf(const FitView& view, ShownData& data) {
  Eigen::MatrixXd rows(view.selection.segments.size(), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Segment& segment = view.selection.segments[static_cast<std::size_t>(i)];
    rows.row(i) << static_cast<double>(segment.begin), static_cast<double>(segment.end),
        segment.velocity;
  }
  return data.Hold(rows);
}

Tree ColumnsOf(const FitView& view, ShownData& data) {
  Tree columns{{"time", data.Hold(view.time)},
               {"position", data.Hold(view.position)},
               {"velocity", data.Hold(view.velocity)},
               {"torque", data.Hold(view.torque)},
               {"rigid", data.Hold(view.rigid)},
               {"keep", data.Hold(Eigen::VectorXd(view.selection.keep.cast<double>()))}};
  const auto add = [&](const char* name, const Eigen::VectorXd& values) {
    if (values.size() > 0) columns[name] = data.Hold(values);
  };
  add("motor_angle", view.motor_angle);
  add("fitted", view.fitted);
  add("energy", view.energy);
  add("energy_std", view.energy_std);
  return columns;
}

/// The friction over velocity, at one speed, and its maps.
void AddFriction(const FitView& view, ShownData& data, Tree& facts) {
  facts["curves"] = Tree::array();
  for (const FrictionCurve& one : CurvesOf(view)) {
    facts["curves"].push_back({{"energy", one.energy},
                               {"speed", data.Hold(one.speed)},
                               {"force", data.Hold(one.force)},
                               {"std", data.Hold(one.deviation)}});
  }
  if (view.at_speed) {
    facts["at_speed"] = {{"speed", view.at_speed->speed},
                         {"cold", view.at_speed->cold},
                         {"force", data.Hold(view.at_speed->force)},
                         {"std", data.Hold(view.at_speed->deviation)}};
  }
  if (!view.has_maps()) return;
  facts["at_heats"] = Tree::array();
  for (const ForceAtHeat& one : ForcesOf(view)) {
    facts["at_heats"].push_back({{"energy", one.energy}, {"force", data.Hold(one.force)}});
  }
  const bool over_motor = std::ranges::any_of(
      view.estimate.friction->maps,
      [](const FrictionMap& map) { return FindAxis(map, MapQuantity::motor_position) != nullptr; });
  if (over_motor && view.motor_angle.size() > 0) {
    const MotorMaps maps = MotorMapsOf(view);
    facts["motor_maps"] = {{"with", data.Hold(maps.with)}, {"without", data.Hold(maps.without)}};
  }
  if (const auto map = AngleMapOf(view)) {
    facts["angle_map"] = {{"over_motor", map->over_motor}, {"lower", map->lower},
                          {"upper", map->upper},           {"fastest", map->fastest},
                          {"energies", map->energies},     {"levels", Tree::array()}};
    for (const Eigen::MatrixXd& level : map->levels) {
      facts["angle_map"]["levels"].push_back(data.Hold(level));
    }
  }
}

/// Maps and bands, as estimate.json has them.
Tree PlaceFacts(const Estimate& estimate) {
  Tree whole = EstimateToTree(estimate), facts = Tree::object();
  for (const char* key : {"friction", "bands"}) {
    if (whole.contains(key)) facts[key] = std::move(whole[key]);
  }
  return facts;
}

}  // namespace

Tree ViewFacts(const FitView& view, ShownData& data) {
  Tree facts = AnswerFacts(view.estimate, view.warms());
  facts["source"] = view.source;
  facts["torque_unit"] = view.torque_unit;
  facts["position_unit"] = std::string(kPositionUnit.For(view.joint));
  facts["velocity_unit"] = std::string(kVelocityUnit.For(view.joint));
  facts["any_motion"] = IsOfAnyMotion(view);
  facts["has_fit"] = view.has_fit;
  facts["warms"] = view.warms();
  facts["has_maps"] = view.has_maps();
  facts["segments"] = SegmentsOf(view, data);
  facts["columns"] = ColumnsOf(view, data);
  if (view.has_fit) AddFriction(view, data, facts);
  return facts;
}

Tree GuessFacts(const LogSamples& measurements, const Selection& selection,
                const std::optional<Thermal>& truth, ShownData& data) {
  if (selection.count() == 0) return nullptr;
  const FirstGuess guess = GuessThermal(measurements, selection);
  if (!guess.thermal) return nullptr;
  const std::vector<Unknown> rows = HeatParameters(*guess.thermal, measurements);
  const TorqueEnvelope& envelope = *guess.envelope;
  Tree facts{{"gain", guess.thermal->gain},      {"time_constant", guess.thermal->time_constant},
             {"gain_unit", rows[0].unit},        {"cold", envelope.cold},
             {"settled", envelope.settled},      {"time_to_63", envelope.time_to_63},
             {"time", data.Hold(envelope.time)}, {"level", data.Hold(envelope.level)}};
  if (truth) facts["truth"] = {{"gain", truth->gain}, {"time_constant", truth->time_constant}};
  return facts;
}

Tree EstimateFacts(const EstimateView& view, ShownData& data, const std::optional<Thermal>& truth) {
  const bool warms = view.fit && view.fit->warms();
  Tree facts{{"answer", AnswerFacts(view.estimate, warms)},
             {"places", PlaceFacts(view.estimate)},
             {"fit", view.fit ? ViewFacts(*view.fit, data) : Tree()},
             {"held_out", view.held_out ? ViewFacts(*view.held_out, data) : Tree()},
             {"guess", nullptr}};
  // without a warming that was found, or constant speeds, a guess of one means nothing
  const bool has_guess =
      warms && !IsOfAnyMotion(*view.fit) && !view.fit->has_maps() && !view.estimate.gravity;
  if (has_guess) facts["guess"] = GuessFacts(*view.measurements, view.fit->selection, truth, data);
  return facts;
}

Tree FitFacts(const FitView& view, ShownData& data) {
  return {{"answer", AnswerFacts(view.estimate, view.warms())},
          {"places", PlaceFacts(view.estimate)},
          {"fit", ViewFacts(view, data)},
          {"held_out", nullptr},
          {"guess", nullptr}};
}

Tree PageFacts(const FitView& view, const RecordingCheck& check,
               const std::vector<std::string>& commands, ShownData& data) {
  return {
      {"fit", ViewFacts(view, data)}, {"check", Tree(CheckToJson(check))}, {"commands", commands}};
}

std::string FileOf(const std::string& joint, std::set<std::string>& taken) {
  constexpr std::size_t longest =
      100;  // characters; why: with its end and a number below what file systems take
  std::string name = Excerpt(joint, longest);
  std::ranges::replace(name, '/', '_');
  if (name.empty() || name.front() == '.') name.insert(0, "_");
  std::string free = name;
  for (int i = 2; !taken.insert(Lowercase(free)).second; ++i) free = fmt::format("{}_{}", name, i);
  return free;
}

Tree RobotFacts(const RobotEstimate& robot, ShownData& data) {
  Tree joints = Tree::array();
  std::set<std::string> taken;
  for (const RobotJointEstimate& one : robot.joints) {
    if (!one.series) continue;
    const JointSeries& series = *one.series;
    const auto& held_out = one.summary.rms_held_out;
    joints.push_back({{"joint", Printable(one.summary.joint)},
                      {"file", FileOf(one.summary.joint, taken)},
                      {"status", std::string(NameOf(one.estimate.status))},
                      {"message", one.estimate.message},
                      {"torque_unit", one.summary.torque_unit},
                      {"rms_held_out", held_out ? Tree(*held_out) : Tree()},
                      {"time", data.Hold(series.time)},
                      {"velocity", data.Hold(series.velocity)},
                      {"measured", data.Hold(series.measured)},
                      {"fitted", data.Hold(series.fitted)},
                      {"energy", data.Hold(series.energy)},
                      {"keep", data.Hold(Eigen::VectorXd(series.kept.cast<double>()))}});
  }
  return joints;
}

}  // namespace warmjoint::shown
