// warmjoint predict ESTIMATE RECORDING: a stored estimate on another recording.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tools/actions/initial_energy.h"
#include "tools/actions/outputs.h"
#include "tools/actions/predict_recording.h"
#include "tools/board/table.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/take_project.h"
#include "tools/parser/choice.h"
#include "tools/terminal/activity.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

struct PredictArguments {
  std::string estimate;
  RecordingArguments recording;
  std::string initial = "cold";
  std::string output;
  std::string format = "text";
};

/// The heat at the first sample.
CourseStart StartOf(const PredictArguments& arguments, const StoredModel& stored) {
  const std::vector<double> energies =
      InitialEnergy(arguments.initial, stored.model.friction, arguments.estimate);
  CourseStart start;
  if (!energies.empty()) start.energy = energies[0];
  if (energies.size() > 1) start.second_energy = energies[1];
  return start;
}

std::string PredictedToText(const PredictArguments& arguments, const StoredModel& stored,
                            const Predicted& predicted, int width) {
  const Metrics& metrics = predicted.metrics;
  const std::string& unit = predicted.measurements.torque_unit;
  Table table{
      {"prediction", "samples", fmt::format("RMSE {}", unit), fmt::format("MAE {}", unit), "Fit %"},
      {{predicted.measurements.source, std::to_string(metrics.n),
        fmt::format("{:.4g}", metrics.rmse), fmt::format("{:.4g}", metrics.mae),
        fmt::format("{:.2f}", metrics.fit)}}};
  std::string text = fmt::format("{} of {} ({})\n\n", stored.identifier, arguments.estimate,
                                 StatusName(stored.status)) +
                     TableToText(table, 1, width);
  if (stored.model.friction.thermal) {
    text += fmt::format("\nE at the end: {:.4g} {} (begun {})\n",
                        predicted.torque.friction.energy.tail<1>()[0], unit, arguments.initial);
  }
  return text;
}

ExitStatus Predict(const PredictArguments& arguments) {
  std::vector<std::filesystem::path> inputs(arguments.recording.recordings.begin(),
                                            arguments.recording.recordings.end());
  inputs.emplace_back(arguments.estimate);
  KeepApart({arguments.output}, inputs);
  if (!arguments.output.empty()) AtomicFile{arguments.output};

  Activity activity("reading the recording");
  const StoredModel stored = ReadStoredModel(arguments.estimate);
  const CourseStart start = StartOf(arguments, stored);
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  const Predicted predicted = PredictLog(stored, log, start);
  if (!arguments.output.empty()) WriteWholeFile(arguments.output, PredictedToCsv(predicted));
  std::FILE* const words = WordsBeside({arguments.output});
  activity.Aside([&] {
    if (stored.status != Status::ok) {
      Say(stderr, "{} is {}: its friction is void, and so is what it predicts\n",
          arguments.estimate, StatusName(stored.status));
    }
    if (arguments.format == "json") {
      fmt::print(words, "{}\n", PredictedToJson(stored, predicted).dump(2));
    } else {
      SayText(words, PredictedToText(arguments, stored, predicted, PageOf(words).width));
    }
  });
  return ExitStatus::done;
}

}  // namespace

Command AddPredictCommand(CLI::App& program) {
  auto arguments = std::make_shared<PredictArguments>();
  CLI::App* parser = program.add_subcommand(
      "predict", "What a stored estimate predicts of another recording, and how well");
  parser
      ->add_option("ESTIMATE", arguments->estimate, "estimate.json of identify, or a friction file")
      ->type_name("ESTIMATE")
      ->required();
  AddRecordingOptions(*parser, arguments->recording);
  AddHoldOptions(*parser, arguments->recording.holds);
  parser
      ->add_option("--initial", arguments->initial,
                   "heat at the first sample: cold; end, that at the end of the estimate's own "
                   "recording; settled:SPEED, that of sliding at SPEED for long")
      ->type_name("cold|end|settled:SPEED")
      ->capture_default_str();
  parser
      ->add_option("-o,--output", arguments->output,
                   "CSV of time, position, velocity, torque, predicted, residual, energy and "
                   "whether the sample was compared")
      ->type_name("FILE");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return Predict(*arguments);
          }};
}

}  // namespace warmjoint::inline tools
