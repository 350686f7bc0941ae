// warmjoint predict ESTIMATE RECORDING: a stored estimate on another recording.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/identify/predict_recording.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct PredictArguments {
  std::string estimate;
  RecordingSource recording;
  std::string initial = "cold";
  EarlierRecording earlier;
  std::string output;
  std::string format = "text";
};

/// Refuses what cannot be had together, before any time is spent.
void CheckStart(const PredictArguments& arguments) {
  // both say how warm the joint is
  CheckEarlier(arguments.earlier, arguments.recording.files.size());
  if (!arguments.earlier.is_given() || arguments.initial == "cold") return;
  Refuse({"--follows"},
         "says how warm the joint is at the start, and so does --initial; leave one");
}

std::string PredictedToText(const PredictArguments& arguments, const StoredModel& stored,
                            const Predicted& predicted, const WarmStart& begin) {
  // how far prediction and record are apart
  const Metrics& metrics = predicted.metrics;
  const std::string& unit = predicted.measurements.torque_unit;
  Table table{
      {"prediction", "samples", fmt::format("RMSE {}", unit), fmt::format("MAE {}", unit), "Fit %"},
      {{predicted.measurements.source, std::to_string(metrics.n),
        fmt::format("{:.4g}", metrics.rmse), fmt::format("{:.4g}", metrics.mae),
        std::isfinite(metrics.fit) ? fmt::format("{:.2f}", metrics.fit) : "-"}}};
  std::string text = fmt::format("{} of {} ({})\n\n", stored.identifier, arguments.estimate,
                                 StatusName(stored.status)) +
                     TableToText(table, 1, PageOf(stdout));
  // how warm the joint has become
  if (stored.model.friction.thermal) {
    const std::string words =
        begin.follows ? fmt::format("at {:.4g}, {:.6g} s after {}", begin.follows->energy[0],
                                    begin.follows->pause, begin.follows->file)
                      : arguments.initial;
    text += fmt::format("\nE at the end: {:.4g} {} (begun {})\n",
                        predicted.torque.friction.energy.tail<1>()[0], unit, words);
  }
  return text;
}

ExitStatus Predict(PredictArguments arguments) {
  // what is read must not be written over, and all that can be refused is first
  std::vector<std::filesystem::path> inputs = InputsOf(arguments.recording);
  inputs.emplace_back(arguments.estimate);
  inputs.emplace_back(arguments.earlier.file);
  CheckStart(arguments);
  Outputs outputs({arguments.output}, inputs);

  Activity activity("reading the recording");
  // the estimate, the log, and the heat between them
  const StoredModel stored = ReadStoredModel(arguments.estimate);
  arguments.recording = AsIdentified(stored, std::move(arguments.recording));
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  activity.Aside([&] { TellNotes(log); });
  const WarmStart begin = StartOf(stored, arguments.estimate, arguments.initial, arguments.earlier,
                                  arguments.recording, log.raw().measurements);
  // what the friction says of the log, and what the log says of it
  const Predicted predicted = PredictLog(stored, log, begin.start);
  if (!arguments.output.empty()) outputs.Add(arguments.output, PredictedToCsv(predicted));
  outputs.Write();
  std::FILE* const words = WordsBeside({arguments.output});
  activity.Aside([&] {
    // void numbers are shown, since they were asked for
    if (stored.status != Status::ok) {
      Say(stderr, "{} is {}: its friction is void, and so is what it predicts\n",
          arguments.estimate, StatusName(stored.status));
    }
    if (arguments.format == "json") {
      nlohmann::json told = PredictedToJson(stored, predicted);
      if (begin.follows) told["follows"] = WriteFields(*begin.follows);
      fmt::print(words, "{}\n", told.dump(2));
    } else {
      Say(words, "{}", PredictedToText(arguments, stored, predicted, begin));
    }
  });
  return ExitStatus::done;
}

}  // namespace

Command AddPredictCommand(CLI::App& program) {
  auto arguments = std::make_shared<PredictArguments>();
  // the estimate, the recording, and how it is read
  CLI::App* parser = program.add_subcommand(
      "predict", "What a stored estimate predicts of another recording, and how well");
  AddValue(*parser, "ESTIMATE", "ESTIMATE", arguments->estimate,
           "estimate.json of identify, or a friction file")
      ->required();
  GiveExample(*parser, "warmjoint predict estimate.json other.csv -o predictions.csv");
  // what is written and printed, and with which heat it begins
  AddValue(*parser, "-o,--output", "FILE", arguments->output,
           "CSV of time, position, velocity, torque, predicted, residual, energy and "
           "whether the sample was compared");
  AddValue(*parser, "--initial", "cold|end|settled:SPEED", arguments->initial,
           "heat at the first sample: cold; end, that at the end of the estimate's own "
           "recording; settled:SPEED, that of sliding at SPEED for long")
      ->capture_default_str();
  AddFollowOptions(*parser, arguments->earlier);
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  AddRecordingOptions(*parser, arguments->recording);
  AddHoldOptions(*parser, arguments->recording.prepare);
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return Predict(*arguments);
          }};
}

}  // namespace warmjoint
