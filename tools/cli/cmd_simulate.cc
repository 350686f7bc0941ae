// warmjoint simulate SCENARIO.yaml: one recording and the truth behind it.
#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "identification/preparation/select.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "scenarios/read_scenario.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/design/read_motion.h"
#include "tools/store/run_store.h"
#include "tools/suite/engine.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct SimulateArguments {
  std::string scenario;
  std::string from;        // run directory to replay a realization of
  std::string variant;     // of the run's ladder
  RecordingSource motion;  // recording to carry out again
  std::vector<std::string> set;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> realization;
  std::string format = "csv";
  std::string output;
};

/// The scenario that a run carried out, by its resolved suite.
Scenario ScenarioOfRun(const SimulateArguments& arguments) {
  // the run as it was, or it is no replay
  const bool changed = !arguments.scenario.empty() || !arguments.set.empty() || arguments.seed ||
                       !arguments.motion.files.empty();
  if (changed) {
    Refuse({"--from"}, "replays a run as it was: leave out SCENARIO, --set, --seed and --motion");
  }

  // the suite that the run stored, not a file that may have changed
  const RunStore store = RunStore::OpenToRead(arguments.from);
  NoticeEditedSuite(store);
  const Suite& suite = store.suite();
  if (arguments.realization.value_or(0) >= static_cast<std::uint64_t>(suite.realizations)) {
    Refuse({"--realization"}, "is {}; {} has 0 to {}", *arguments.realization, arguments.from,
           suite.realizations - 1);
  }

  // the variant by its name; a run without a ladder has one scenario
  if (!suite.ladder && arguments.variant.empty()) return VariantScenario(suite, 0);
  std::vector<std::string> names;
  for (int i = 0; suite.ladder && i < suite.variants(); ++i) {
    names.push_back(suite.ladder->variants[static_cast<std::size_t>(i)].name);
  }
  const auto named = std::find(names.begin(), names.end(), arguments.variant);
  if (named == names.end()) {
    Refuse({"--variant"}, "there is no variant '{}' of {}{}", Excerpt(arguments.variant),
           arguments.from, Suggestion(arguments.variant, names));
  }
  return VariantScenario(suite, static_cast<int>(named - names.begin()));
}

/// Of a file that is a motion, or of a recording.
TimedMotion MotionFrom(const RecordingSource& source) {
  if (const auto motion = ReadMotion(source.files.front())) return *motion;
  const Measurements log = Prepare(ReadRecordings(source)).raw().measurements;
  return {MotionOf(log, SelectConstantSpeed(log)), log.time[log.size() - 1] - log.time[0]};
}

/// Of a scenario file, with the motion of --motion, or of a run.
Scenario ResolveScenario(const SimulateArguments& arguments) {
  if (!arguments.from.empty()) return ScenarioOfRun(arguments);
  if (arguments.scenario.empty()) Refuse({"simulate"}, "give SCENARIO, or --from RUN");
  // a log's motion first, for as long as it lasts, so that --set can still change it
  Settings settings;
  if (!arguments.motion.files.empty()) {
    const TimedMotion made = MotionFrom(arguments.motion);
    settings = MotionSettings(made.motion, made.duration);
  }
  for (const auto& [key, value] : ReadPairs(arguments.set, "--set")) {
    settings.push_back({key, value});
  }
  Scenario scenario = ReadScenario(arguments.scenario, settings);
  // --seed goes over all of them
  if (arguments.seed) scenario.seed = *arguments.seed;
  return scenario;
}

/// One realization, with its progress on stderr where it takes its time.
Simulation Carried(Plant& plant, const Scenario& scenario, std::uint64_t realization) {
  ProgressLine line;
  return plant.Run(realization, [&](double share) {
    // the rest at the mean speed until now
    if (!line.Due()) return;
    std::string words = fmt::format("{:.1f} % of {:g} s", 100 * share, scenario.duration);
    if (share > 0) {
      const double left = line.seconds() * (1 - share) / share;
      words += fmt::format(", {} left", DurationInWords(left));
    }
    line.Show(words);
  });
}

ExitStatus Simulate(const SimulateArguments& arguments) {
  // what cannot be simulated is refused before its outputs are made
  const Scenario scenario = ResolveScenario(arguments);
  const std::unique_ptr<Plant> plant = MakePlant(scenario);
  std::vector<std::filesystem::path> outputs, inputs{arguments.scenario};
  const std::vector<std::string> files{"recording.csv", "recording.h5", "truth.json",
                                       "scenario.yaml"};
  for (const std::string& file : files) {
    outputs.push_back(std::filesystem::path(arguments.output) / file);
  }
  // none of its inputs is written over
  for (const std::string& input : arguments.motion.files) inputs.emplace_back(input);
  KeepApart(outputs, inputs);
  AtomicDirectory directory(arguments.output, files);

  const Simulation recording = Carried(*plant, scenario, arguments.realization.value_or(0));
  const std::filesystem::path& folder = directory.temporary();
  WriteRecording(recording.measurements, folder / ("recording." + arguments.format));
  WriteTruth(recording.truth, folder / "truth.json");
  WriteWholeFile(folder / "scenario.yaml", ScenarioToYaml(scenario));
  directory.Commit();
  // what came of it, and whether the joint did what it should
  Say(stdout, "{}: {} samples over {:.6g} s\n", arguments.output, recording.measurements.size(),
      scenario.duration);
  if (!recording.following.Follows()) {
    SayNotice("notice: {}\n", recording.following.Words());
  }
  return ExitStatus::done;
}

}  // namespace

Command AddSimulateCommand(CLI::App& program) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* parser =
      program.add_subcommand("simulate", "Simulate a scenario: a recording and its truth");
  GiveExample(*parser, "warmjoint simulate scenario.yaml --seed 8 -o runs/scenario");
  AddValue(*parser, "-o,--output", "DIR", arguments->output,
           "directory for the files, made as a whole")
      ->required();
  // what is simulated: a scenario, a run's realization or a log's motion
  AddValue(*parser, "SCENARIO", "SCENARIO", arguments->scenario, "scenario file (YAML)");
  AddValue(*parser, "--from", "RUN", arguments->from, "run directory: replay its --realization");
  AddValue(*parser, "--variant", "TEXT", arguments->variant, "of the run's ladder");
  AddValue(*parser, "--motion", "RECORDING", arguments->motion.files,
           "CSV or HDF5 file whose motion is replayed; without a torque column its velocity is "
           "followed from row to row, as motion.csv of `design`")
      ->expected(1);

  // what changes of it
  AddValue(*parser, "--set", "ENTRY=VALUE", arguments->set,
           "another value for a key, as noise.torque=0.1")
      ->take_all();
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  AddWholeNumber(*parser, "--seed", arguments->seed, 0, largest, "instead of the scenario's");
  AddWholeNumber(*parser, "--realization", arguments->realization, 0, largest,
                 "which of the seed's realizations; default: 0");

  AddChoice(*parser, "--format", arguments->format, {"csv", "h5"}, "of the recording; h5: HDF5");
  AddLayoutOptions(*parser, arguments->motion.read);
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->motion);
            return Simulate(*arguments);
          }};
}

}  // namespace warmjoint
