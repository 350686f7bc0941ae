// warmjoint check RECORDING: what a log holds, and what can be identified from it.
#include <fmt/format.h>
#include <warmjoint/design.h>
#include <warmjoint/errors.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/preparation/check.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/check_until.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/shown/estimate_data.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct CheckArguments {
  RecordingSource recording;
  std::string format = "text";
  std::string segments;
  std::string plot;
  UntilArguments until;
};

/// The kept segments of a recording, a line for each. number: of the recording, from 1.
void AppendSegments(const PreparedLog& log, int number, std::string& csv) {
  // a line for each stretch of constant speed, with the samples that take part
  const auto& [m, selection] = log.constant_speed();
  for (const Segment& segment : selection.segments) {
    const auto kept = selection.keep.segment(segment.begin, segment.end - segment.begin).count();
    csv += fmt::format("{},{},{},{},{}\n", number, m.time[segment.begin], m.time[segment.end - 1],
                       segment.velocity, kept);
  }
}

/// One recording, or why it could not be read.
struct CheckedFile {
  std::string file;
  std::optional<RecordingCheck> check;
  std::string unreadable;
};

/// Reads, prepares and checks one of the recordings. One of several that cannot be read is reported as
/// such; one alone throws.
CheckedFile CheckOne(const RecordingSource& arguments, const std::string& path,
                     std::optional<PreparedLog>& log) {
  RecordingSource one = arguments;
  // read alone, so that a refusal is its own
  one.files = {path};
  try {
    log = ReadAndPrepare(one);
    return {path, CheckRecording(*log), {}};
  } catch (const BadInput& refusal) {
    if (arguments.files.size() == 1) throw;
    return {path, std::nullopt, refusal.what()};
  }
}

/// In a word.
std::string VerdictOn(const CheckedFile& file) {
  if (!file.check) return "unreadable";
  if (!file.check->faults.empty()) return "faults";
  const bool any = std::ranges::any_of(file.check->excitation, &Excitation::sufficient);
  return any ? "ok" : "no friction";
}

/// A row for each of several recordings, with what may differ between them.
std::string TableOf(const std::vector<CheckedFile>& files, const Page& page) {
  Table table{{"file", "samples", "rate Hz", "duration s", "segments", "from", "to", "torque in",
               "faults", "verdict"},
              {}};
  for (const CheckedFile& file : files) {
    // dashes where it cannot be read
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {file.file, "-", "-", "-", "-", "-", "-", "-", "-", VerdictOn(file)};
    if (!file.check) continue;
    const SamplingCheck& sampling = file.check->sampling;
    const MotionCheck& motion = file.check->motion;
    const std::string_view unit = kPositionUnit.For(file.check->joint);
    row = {file.file,
           std::to_string(sampling.samples),
           fmt::format("{:.4g}", sampling.rate),
           fmt::format("{:.4g}", sampling.duration),
           std::to_string(motion.segments),
           fmt::format("{:.4g} {}", motion.lower, unit),
           fmt::format("{:.4g} {}", motion.upper, unit),
           file.check->torque_unit,
           std::to_string(file.check->faults.size()),
           VerdictOn(file)};
  }
  return TableToText(table, 1, page);
}

/// Of one recording its check; of several a table, and each by itself.
std::string Text(const std::vector<CheckedFile>& files, const Page& page) {
  if (files.size() == 1) return CheckToText(*files.front().check);
  std::string text = TableOf(files, page);
  for (const CheckedFile& file : files) {
    text += "\n" + (file.check ? CheckToText(*file.check)
                               : fmt::format("recording   {}\n", file.unreadable));
  }
  return text;
}

/// As CheckToJson of one; of several {recordings[the same, and verdict; of an unreadable one source, reason,
/// verdict]}.
nlohmann::json Json(const std::vector<CheckedFile>& files) {
  if (files.size() == 1) return CheckToJson(*files.front().check);
  nlohmann::json recordings = nlohmann::json::array();
  for (const CheckedFile& file : files) {
    nlohmann::json& row = recordings.emplace_back(
        file.check ? CheckToJson(*file.check)
                   : nlohmann::json{{"source", file.file}, {"reason", file.unreadable}});
    row["verdict"] = VerdictOn(file);
  }
  return {{"recordings", recordings}};
}

ExitStatus Check(const CheckArguments& arguments) {
  // outputs are refused before any time is spent
  const std::vector<std::filesystem::path> outputs{arguments.segments, arguments.plot};
  std::optional<Backend> backend;
  if (!arguments.plot.empty()) PictureFormatOf(arguments.plot);
  Outputs written(outputs, InputsOf(arguments.recording));
  if (!arguments.plot.empty()) backend.emplace();

  // options that make no layout are refused for all of them at once
  CheckReadSettings(arguments.recording.read);

  // each recording by itself, so that one cannot spoil the others
  std::vector<CheckedFile> files;
  std::string segments = "recording,begin,end,velocity,samples\n";
  Activity activity("reading the recording");
  for (const std::string& path : arguments.recording.files) {
    activity.Is("checking " + path);
    std::optional<PreparedLog> log;
    files.push_back(CheckOne(arguments.recording, path, log));
    if (!log) continue;
    // numbers and picture of what could be read
    AppendSegments(*log, static_cast<int>(files.size()), segments);
    if (files.size() == 1 && backend) {
      DrawRequest request{.figures = {"log"}};
      request.sources.push_back({{"kind", "estimate"}, {"place", arguments.plot}});
      request.sources[0].update(shown::FitFacts(shown::MakeFitView(*log, {}), request.data));
      written.Add(arguments.plot, PictureFor(arguments.plot, *backend, std::move(request)));
    }
  }
  written.Add(arguments.segments, segments);
  written.Write();

  // words and numbers keep apart where an output is standard output
  std::FILE* const words = WordsBeside(outputs);
  activity.Aside([&] {
    if (arguments.format == "json") {
      fmt::print(words, "{}\n", Json(files).dump(2));
    } else {
      Say(words, "{}", Text(files, PageOf(words)));
    }
    if (!arguments.plot.empty() && !files.front().check) {
      Say(stderr, "{}: is not drawn, since {} cannot be read; give one that can be read first\n",
          arguments.plot, files.front().file);
    }
  });

  // a recording that could not be read makes the whole fail
  const bool all_read =
      std::ranges::all_of(files, [](const CheckedFile& file) { return file.check.has_value(); });
  return all_read ? ExitStatus::done : ExitStatus::bad_input;
}

}  // namespace

Command AddCheckCommand(CLI::App& program) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* parser =
      program.add_subcommand("check", "What a log holds, and what can be identified from it");
  GiveExample(*parser, "warmjoint check log.csv --map torque=tau_Nm --unit position=deg");
  // what is made of recordings, then how they are read
  AddValue(*parser, "--plot", "FILE", arguments->plot,
           "picture of the (first) recording with its kept segments: .png, .svg or .pdf");
  AddValue(*parser, "--segments", "FILE", arguments->segments,
           "the constant speeds that are kept, as CSV: begin and end in s, velocity in SI");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  CLI::Option* const until = AddValue(
      *parser, "--until", "NAME=SHARE", arguments->until.goal,
      "whether, and after how many minutes, the half width of a 95 % interval is there, as "
      "friction=5% or thermal_time_constant=5%; status 3: not yet, with the minutes that "
      "are missing");
  parser
      ->add_flag(
          "--watch", arguments->until.watch,
          "with --until: reads a CSV file that is being recorded, or standard input (-), until "
          "the interval is there or it grows no more")
      ->needs(until);
  AddValue(*parser, "--identifier", "NAME", arguments->until.identify.identifier,
           "that --until asks")
      ->capture_default_str()
      ->needs(until);
  AddRecordingOptions(*parser, arguments->recording);
  AddHoldOptions(*parser, arguments->recording.prepare);
  // the project file counts before anything is read
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            if (arguments->until.goal.empty()) return Check(*arguments);
            if (!arguments->segments.empty() || !arguments->plot.empty()) {
              Refuse({"--until"}, "makes neither --segments nor --plot; leave them out");
            }
            return CheckUntil(arguments->until, arguments->recording, arguments->format);
          }};
}

}  // namespace warmjoint
