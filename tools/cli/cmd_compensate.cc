// warmjoint compensate LOG --friction FILE [--robot R]: what a compensator on the robot would have done, and what is no friction.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/description_text.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "models/recording/read_recording.h"
#include "models/robots/robot_folder.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/robot_options.h"
#include "tools/cli/typed_options.h"
#include "tools/compensate/compensate_log.h"
#include "tools/compensate/robot/external_torque.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

struct CompensateArguments {
  std::string friction, robot;
  RecordingSource recording;
  RobotSettings of_robot;
  CompensatorSettings settings{.correct = LevelCorrection::none};
  double dead_band = kNotGiven, pause = kNotGiven;
  std::string state;
  std::string output;
  std::string format = "text";
};

/// What is said of a log, in numbers.
struct Summary {
  int samples = 0;      // that slide
  double friction = 0;  // rms of them, N.m or N
  double residual = 0;  // rms of them, N.m or N
  double contact = 0;   // share of them
  KeptState end;

  template <class A>
  void Serialize(A* a) {
    a->Field("samples", &samples);
    a->Field("friction_rms", &friction, {.unit = "N.m"});
    a->Field("residual_rms", &residual, {.unit = "N.m"});
    a->Field("contact", &contact);
    a->Field("state_end", &end);
  }
};

Summary Summarise(const CompensatedLog& log, const Compensator& compensator) {
  Summary summary{.end = StateOf(compensator, log.measurements.time.tail<1>()[0])};
  const Compensated& found = log.found;
  for (Eigen::Index i = 0; i < found.residual.size(); ++i) {
    if (!std::isfinite(found.residual[i])) continue;
    ++summary.samples;
    summary.friction += found.friction[i] * found.friction[i];
    summary.residual += found.residual[i] * found.residual[i];
    summary.contact += found.contact[i];
  }
  if (summary.samples == 0) return summary;
  summary.friction = std::sqrt(summary.friction / summary.samples);
  summary.residual = std::sqrt(summary.residual / summary.samples);
  summary.contact /= summary.samples;
  return summary;
}

std::string SummaryText(const Summary& summary, const std::string& unit,
                        LevelCorrection correction) {
  std::string text =
      fmt::format("{} samples slide: friction {:.4g} {} rms, residual {:.4g} {} rms\n",
                  summary.samples, summary.friction, unit, summary.residual, unit);
  text += fmt::format("contact in {:.3g} % of them\n", 100 * summary.contact);
  text +=
      fmt::format("at the end: E {:.4g} {}", summary.end.energy + summary.end.second_energy, unit);
  if (correction == LevelCorrection::by_torque) {
    text += fmt::format(", level corrected by {:.4g} +- {:.2g} {}", summary.end.correction,
                        std::sqrt(summary.end.variance), unit);
  }
  return text + "\n";
}

/// The state to go on with; none where the file is not there yet.
std::optional<KeptState> ReadState(const std::string& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
  return ReadAs<KeptState>(ReadJsonNode(file));
}

/// The rms of numbers that are known.
double Rms(const Eigen::VectorXd& values) {
  double sum = 0, count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value * value;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

std::string RobotText(const RobotExternal& found) {
  std::string text;
  for (const JointExternal& one : found.joints) {
    text += fmt::format("{}: friction {:.4g} {} rms, external {:.4g} rms, contact in {:.3g} %\n",
                        Printable(one.joint), Rms(one.friction), kTorqueUnit.For(one.kind),
                        Rms(one.external), 100 * one.contact.mean());
  }
  return text;
}

nlohmann::json RobotJson(const RobotExternal& found) {
  nlohmann::json joints = nlohmann::json::object();
  for (const JointExternal& one : found.joints) {
    joints[one.joint] = {{"friction_rms", Rms(one.friction)},
                         {"external_rms", Rms(one.external)},
                         {"contact", one.contact.mean()}};
  }
  return {{"joints", joints}, {"notices", found.notices}};
}

/// The text or the bytes of columns, by the name's ending.
std::string FileOf(const FileContent& columns, const std::filesystem::path& name) {
  return name.extension() == ".csv" ? ColumnsToCsv(columns) : ColumnsToHdf5(columns);
}

/// Refuses the options that stand on the command line and mean nothing here.
void RefuseGiven(const CLI::App& parser, std::initializer_list<const char*> options,
                 const char* why) {
  for (const char* const option : options) {
    if (parser.get_option(option)->count() > 0) Refuse({option}, "{}", why);
  }
}

/// How the robot's log is read, as a robot has it: factors and the torque constant are settings of its joints.
RobotSource SourceOf(const RecordingSource& recording, RobotSettings& settings) {
  RobotSource source{{}, recording.read};
  for (const std::string& file : recording.files) source.logs.push_back({file});
  for (const auto& [column, factor] : source.read.scale) TakeScale(column, factor, settings);
  source.read.scale.clear();
  if (source.read.torque_constant != 0) settings.torque_constant[""] = source.read.torque_constant;
  source.read.torque_constant = 0;
  return source;
}

/// All joints of a robot, with what acts from outside.
ExitStatus CompensateRobot(const CompensateArguments& arguments) {
  const std::filesystem::path robot = FindRobot(arguments.robot, "--robot");
  std::vector<std::filesystem::path> inputs = FilesOfDescription(robot);
  inputs.insert(inputs.end(), arguments.recording.files.begin(), arguments.recording.files.end());
  inputs.emplace_back(arguments.friction);
  Outputs outputs({arguments.output}, inputs);
  if (!arguments.output.empty()) RequireWritable(arguments.output);

  Activity activity("reading the description and the log");
  const RobotEstimate estimate = ReadRobotEstimate(arguments.friction);
  RobotSettings settings = arguments.of_robot;
  const RobotSource source = SourceOf(arguments.recording, settings);
  CompensatorSettings compensation = arguments.settings;
  if (!std::isnan(arguments.dead_band)) compensation.dead_band = arguments.dead_band;
  const RobotExternal found = FindExternal(robot, estimate, source, settings, compensation);

  if (!arguments.output.empty()) {
    outputs.Add(arguments.output, FileOf(ColumnsOf(found), arguments.output));
  }
  outputs.Write();
  std::FILE* const words = WordsBeside({arguments.output});
  activity.Aside([&] {
    for (const std::string& notice : found.notices) SayNotice("notice: {}\n", notice);
    if (arguments.format == "json") {
      fmt::print(words, "{}\n", RobotJson(found).dump(2));
    } else {
      Say(words, "{}", RobotText(found));
    }
  });
  return ExitStatus::done;
}

ExitStatus Compensate(CompensateArguments arguments) {
  // what is read must not be written over, but for the state
  std::vector<std::filesystem::path> inputs = InputsOf(arguments.recording);
  inputs.emplace_back(arguments.friction);
  Outputs outputs({arguments.output, arguments.state}, inputs);
  if (!arguments.output.empty()) RequireWritable(arguments.output);
  const std::optional<KeptState> kept = ReadState(arguments.state);
  if (!std::isnan(arguments.pause) && !kept) {
    Refuse({"--pause"}, "is the time since a state, and there is none; give --state FILE");
  }

  Activity activity("reading the recording");
  const JointToCompensate joint = ReadToCompensate(arguments.friction);
  arguments.recording = AsIdentified(joint.stored, std::move(arguments.recording));
  const PreparedLog log = ReadAndPrepare(arguments.recording);
  activity.Aside([&] { TellNotes(log); });

  // the compensator, cold or from its state
  CompensatorSettings settings = arguments.settings;
  settings.dead_band = std::isnan(arguments.dead_band) ? DeadBandOf(joint) : arguments.dead_band;
  Compensator compensator(joint.stored.model.friction, joint.doubt, settings);
  if (kept) {
    const auto pause = std::isnan(arguments.pause) ? std::nullopt : std::optional(arguments.pause);
    GoOn(compensator, *kept, log.raw().measurements.time[0], pause, arguments.state);
  }
  const CompensatedLog found = CompensateLog(joint.stored, log, compensator);
  const Summary summary = Summarise(found, compensator);

  // columns, state, words
  if (!arguments.output.empty()) {
    outputs.Add(arguments.output, FileOf(ColumnsOf(found), arguments.output));
  }
  if (!arguments.state.empty()) {
    outputs.Add(arguments.state, WriteFields(summary.end).dump(2) + "\n");
  }
  outputs.Write();
  std::FILE* const words = WordsBeside({arguments.output});
  activity.Aside([&] {
    if (joint.stored.status != Status::ok) {
      Say(stderr, "{} is {}: its friction is void, and so is what it compensates\n",
          arguments.friction, StatusName(joint.stored.status));
    }
    if (arguments.format == "json") {
      fmt::print(words, "{}\n", WriteFields(summary).dump(2));
    } else {
      Say(words, "{}", SummaryText(summary, found.measurements.torque_unit, settings.correct));
    }
  });
  return ExitStatus::done;
}

}  // namespace

Command AddCompensateCommand(CLI::App& program) {
  auto arguments = std::make_shared<CompensateArguments>();
  CLI::App* parser = program.add_subcommand(
      "compensate", "Friction, residual and heat along a recording, as a controller has them");
  AddRecordingOptions(*parser, arguments->recording);
  AddValue(*parser, "--friction", "FILE", arguments->friction,
           "estimate.json of identify, or a friction file; with --robot the robot.json of "
           "identify-robot")
      ->required();
  GiveExample(*parser,
              "warmjoint compensate log.csv --friction estimate.json --correct -o out.csv");

  // how it compensates
  CompensatorSettings& settings = arguments->settings;
  parser->add_flag_callback(
      "--correct", [&settings] { settings.correct = LevelCorrection::by_torque; },
      "correct the level by the measured torque while there is no contact");
  AddNumber(*parser, "--share", settings.share, {0, 1, "from 0 to 1"},
            "of the friction that is compensated")
      ->capture_default_str();
  constexpr double most = std::numeric_limits<double>::infinity();
  AddNumber(*parser, "--dead-band", arguments->dead_band, {0, most, "of 0 or more, rad/s or m/s"},
            "speed below which nothing is compensated; where not given a tenth of the slowest "
            "at which the estimate knows friction");
  AddChoice(*parser, "--heat-by", settings.heat,
            "what heats: the model's friction, or the measured torque");
  AddValue(*parser, "--state", "FILE", arguments->state,
           "heat and correction to begin with, where the file is there; those at the end are "
           "written to it");
  AddNumber(*parser, "--pause", arguments->pause, {0, most, "of 0 or more, s"},
            "rest since the state; where not given the stamps of both tell it");
  AddValue(*parser, "-o,--output", "FILE", arguments->output,
           "CSV or HDF5 of time, position, velocity, torque, friction, residual, energy, loss, "
           "std, contact and compensation; of a robot the external torque of each joint and the "
           "force at the tool");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");

  // what a robot has besides
  BeginGroup(*parser, "All joints of a robot, and the force at its tool");
  AddValue(*parser, "--robot", "ROBOT", arguments->robot,
           "its description: MJCF or URDF file, or one of: warmjoint list robots");
  AddJointsOfLog(*parser, arguments->of_robot);
  AddKnownRobot(*parser, arguments->of_robot);
  return {parser, [arguments, parser] {
            if (arguments->robot.empty()) {
              RefuseGiven(*parser, {"--joints", "--tool", "--coupling", "--cutoff"},
                          "is of all joints of a robot; give --robot, its description, too");
              TakeProject(*parser, arguments->recording);
              return Compensate(*arguments);
            }
            RefuseGiven(*parser, {"--joint", "--gear", "--wrap", "--state", "--pause"},
                        "is of one joint; leave it out, or give the joint's estimate to --friction "
                        "and no --robot");
            return CompensateRobot(*arguments);
          }};
}

}  // namespace warmjoint
