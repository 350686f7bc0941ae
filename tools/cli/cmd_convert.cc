// warmjoint convert FILE -o LOG: a log in another format as one that the other commands read.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/recording/log_formats.h"
#include "models/recording/read_recording.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/other_formats.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

constexpr Eigen::Index kFewestSamples = 3;  // why: a recording has as many at least

struct ConvertArguments {
  RecordingSource recording;
  std::string output, topic, joint;
};

/// Refuses options of text where columns are written as they are.
void RefuseLayout(const ReadSettings& read) {
  const ReadSettings usual;
  const std::pair<const char*, bool> given[] = {
      {"--scale", !read.scale.empty()},    {"--columns", !read.columns.empty()},
      {"--rate", read.rate != 0},          {"--wrap", read.wrap != 0},
      {"--gear", read.gear != usual.gear}, {"--torque-constant", read.torque_constant != 0},
      {"--unit", !read.unit.empty()}};
  for (const auto& [option, is_given] : given) {
    if (!is_given) continue;
    Refuse({option},
           "numbers of this format are written as they are; give {} to `warmjoint identify`",
           option);
  }
}

/// "log.h5" of the only one; "log_2.h5" of the second of several.
fs::path NameOf(const fs::path& output, std::size_t which, std::size_t count) {
  if (count == 1) return output;
  fs::path name = output;
  name.replace_filename(
      fmt::format("{}_{}{}", output.stem().string(), which + 1, output.extension().string()));
  return name;
}

ExitStatus ConvertOther(const ConvertArguments& arguments) {
  RefuseLayout(arguments.recording.read);
  const FileContent content = ReadOtherFormat({arguments.recording.files.front(), arguments.topic,
                                               arguments.joint, arguments.recording.read.map});
  for (const std::string& note : content.notes) SayNotice("notice: {}\n", note);
  const Eigen::Index samples = content.columns.empty() ? 0 : content.columns.front().values.size();
  if (samples < kFewestSamples) {
    Refuse({arguments.recording.files.front()},
           "has {} rows of numbers; a log has {} at least. Is its table elsewhere in the file?",
           samples, kFewestSamples);
  }
  WriteColumns(content, arguments.output);
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  Say(stdout, "{}: {} samples of {}\n", arguments.output, samples, ExcerptOfList(names));
  return ExitStatus::done;
}

/// What the program reads, in SI.
ExitStatus ConvertOurs(const ConvertArguments& arguments) {
  const std::vector<Measurements> recordings = ReadRecordings(arguments.recording);
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    for (const std::string& note : recordings[k].notes) SayNotice("notice: {}\n", note);
    const fs::path name = NameOf(arguments.output, k, recordings.size());
    WriteRecording(recordings[k], name);
    std::vector<std::string> columns;
    for (const RecordingColumn& column : RecordingColumns()) {
      if (column.get(recordings[k])) columns.push_back(column.name);
    }
    Say(stdout, "{}: {} samples of {}\n", name.string(), recordings[k].size(),
        fmt::join(columns, ", "));
  }
  return ExitStatus::done;
}

ExitStatus Convert(ConvertArguments& arguments, const CLI::App& parser) {
  const std::string& file = arguments.recording.files.front();
  RequireWritable(arguments.output);
  KeepApart({arguments.output}, {file});
  if (IsOtherFormat(file)) return ConvertOther(arguments);
  RequireReadable(file);
  if (!arguments.topic.empty()) Refuse({file}, "--topic is for bags; name columns with --map");
  // of a file without joints by name it is the joint's kind
  if (arguments.joint == "linear") arguments.recording.read.joint = JointKind::linear;
  if (!arguments.joint.empty() && arguments.joint != "linear" && arguments.joint != "rotary") {
    Refuse({"--joint"}, "'{}': {} has no joints by name; name its columns with --map",
           Excerpt(arguments.joint), file);
  }
  arguments.joint.clear();
  TakeProject(parser, arguments.recording);
  if (!MayHoldObjects(file)) return ConvertOurs(arguments);
  try {
    return ConvertOurs(arguments);
  } catch (const BadInput&) {
    return ConvertOther(arguments);
  }
}

}  // namespace

Command AddConvertCommand(CLI::App& program) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* parser = program.add_subcommand("convert", "Make a log of one in another format");
  arguments->recording.files.resize(1);
  AddValue(*parser, "LOG", "LOG", arguments->recording.files.front(),
           fmt::format("log whose name ends in {}, {}; folder of a rosbag2 or of .parquet; or a "
                       "table of text",
                       EndingsOf(ReadBy::converter), EndingsOf(ReadBy::program)))
      ->required();
  AddValue(*parser, "-o,--output", "FILE", arguments->output, "log to write: .h5 or .csv")
      ->required();
  GiveExample(*parser, "warmjoint convert drive.mcap --joint elbow -o log.h5");
  AddLayoutOptions(*parser, arguments->recording.read);
  parser->remove_option(parser->get_option("--joint"));
  BeginGroup(*parser, "Options");
  AddValue(*parser, "--joint", "NAME", arguments->joint,
           "joint of a bag's JointState, by default all; of a table of text rotary or linear");
  AddValue(*parser, "--topic", "TOPIC", arguments->topic,
           "topic of a bag; by default the only one of sensor_msgs/JointState");
  return {parser, [arguments, parser] { return Convert(*arguments, *parser); }};
}

}  // namespace warmjoint
