#include "tools/shown/run/simulation_view.h"

#include <warmjoint/prepared_log.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "identification/preparation/select.h"
#include "models/recording/read_recording.h"
#include "scenarios/read_scenario.h"
#include "tools/shown/estimate_data.h"

namespace warmjoint::shown {
namespace {

/// Leaves out what only seems to move at a constant speed: the truth knows where a filter smears a
/// reversal over its neighbours.
void KeepTrulyConstant(const Truth& truth, Selection& selection) {
  constexpr double alike = 0.1;  // of the segment's speed
  for (const Segment& segment : selection.segments) {
    for (Eigen::Index i = segment.begin; i < segment.end; ++i) {
      const double off = std::abs(truth.velocity[i] - segment.velocity);
      if (off > alike * std::abs(segment.velocity)) selection.keep[i] = false;
    }
  }
}

}  // namespace

SimulationView MakeSimulationView(const Scenario& scenario, const Simulation& recording) {
  Estimate truth;
  truth.friction = recording.truth.friction;
  // samples as an identifier takes them, less those that only seem to be at constant speed
  const LogSamples m = Prepare(recording.measurements).raw().measurements;
  Selection selection =
      scenario.plant == PlantKind::ideal ? SelectMoving(m) : SelectConstantSpeed(m);
  KeepTrulyConstant(recording.truth, selection);
  // the truth's own, not what the sampled motion says of it
  Prediction known;
  known.force = recording.truth.force;
  known.energy = recording.truth.energy;
  return {scenario, {m, recording.truth}, MakeFitView(m, selection, truth, known)};
}

bool IsSimulation(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / "scenario.yaml") &&
         std::filesystem::exists(directory / "truth.json");
}

SimulationView ReadSimulationView(const std::filesystem::path& directory) {
  const Scenario scenario = ReadScenario(directory / "scenario.yaml", {});
  // the files are in the units that the scenario says
  ReadSettings layout;
  layout.joint = scenario.joint_kind;
  layout.gear = scenario.friction.gear;
  const bool hdf5 = std::filesystem::exists(directory / "recording.h5");
  Simulation recording;
  recording.measurements =
      ReadRecordingFile(directory / (hdf5 ? "recording.h5" : "recording.csv"), layout);
  recording.truth = ReadTruth(directory / "truth.json");
  // the truth of another simulation does not fit the recording
  if (recording.truth.velocity.size() != recording.measurements.size()) {
    Refuse({directory / "truth.json"},
           "holds {} samples where the recording beside it has {}; both must be of one simulation",
           recording.truth.velocity.size(), recording.measurements.size());
  }
  return MakeSimulationView(scenario, recording);
}

Tree SimulationFacts(const SimulationView& view, ShownData& data) {
  const Friction& friction = view.recording.truth.friction;
  Tree facts{{"name", view.scenario.name}, {"fit", ViewFacts(view.fit, data)}, {"guess", nullptr}};
  if (friction.thermal && friction.maps.empty()) {
    facts["guess"] = GuessFacts(LogSamples(view.recording.measurements), view.fit.selection,
                                friction.thermal, data);
  }
  return facts;
}

}  // namespace warmjoint::shown
