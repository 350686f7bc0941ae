// warmjoint design: which motion to record, and what its log will tell.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/design.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "models/foundation/parse_number.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/identify/recording_source.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct DesignArguments {
  DesignSettings settings;
  std::vector<std::string> limits;
  std::string aim = "D";
  std::string noise;
  std::optional<std::uint64_t> seed;
  RecordingSource after;            // an earlier log, or none
  RobotDesignSettings robot;        // or none
  std::vector<std::string> joints;  // of it; one where there is no robot
  std::vector<std::string> priors, at;
  std::string format = "text";
  std::string output;
};

double LimitNumber(const std::string& text, const std::string& entry) {
  const std::optional<double> number = ParseFinite(text);
  if (!number) {
    Refuse({"--limits"},
           "is '{}'; give numbers, as position=-1.5..1.5,velocity=0.05..1,acceleration=5,torque=30",
           Excerpt(entry));
  }
  return *number;
}

/// "a..b" or one number.
std::vector<double> LimitNumbers(const std::string& text, const std::string& entry) {
  const size_t dots = text.find("..");
  if (dots == std::string::npos) return {LimitNumber(text, entry)};
  return {LimitNumber(text.substr(0, dots), entry), LimitNumber(text.substr(dots + 2), entry)};
}

/// Takes one entry, "velocity=0.05..1".
void TakeLimit(const std::string& entry, MotionLimits& limits) {
  const size_t equals = entry.find('=');
  const std::string name = entry.substr(0, equals);
  const std::vector<std::string> known{"position", "velocity", "acceleration", "torque"};
  if (equals == std::string::npos || std::ranges::find(known, name) == known.end()) {
    Refuse({"--limits"},
           "has '{}'{}; its entries are position=a..b, velocity=a..b, acceleration=a and torque=a",
           Excerpt(entry), Suggestion(name, known));
  }
  const std::vector<double> numbers = LimitNumbers(entry.substr(equals + 1), entry);
  const double last = numbers.back();
  if (name == "position") {
    // one number: as far to both sides
    limits.position = {numbers.size() > 1 ? numbers[0] : -last, last};
    if ((*limits.position)[0] < last) return;
    Refuse({"--limits"}, "has '{}'; the lower position comes first", Excerpt(entry));
  }
  if (!(last > 0)) Refuse({"--limits"}, "has '{}'; it must be above 0", Excerpt(entry));
  if (name == "velocity") {
    // one number: the fastest
    constexpr double kSlowest = 0.05;
    limits.velocity = {numbers.size() > 1 ? numbers[0] : kSlowest * last, last};
    if (limits.velocity[0] > 0 && limits.velocity[0] < last) return;
    Refuse({"--limits"}, "has '{}'; the slowest speed comes first, above 0", Excerpt(entry));
  }
  if (numbers.size() > 1) Refuse({"--limits"}, "has '{}'; {} is one number", Excerpt(entry), name);
  if (name == "acceleration") limits.acceleration = last;
  if (name == "torque") limits.torque = last;
}

/// A number, or a log whose residual is the noise; its rate is taken, too.
void TakeNoise(const std::string& given, const ReadSettings& read, DesignSettings& settings) {
  if (given.empty()) return;
  settings.noise = ParseFinite(given);
  if (!settings.noise)
    return TakeNoiseOf(ReadAndPrepare({.files = {given}, .read = read}), settings);
  if (*settings.noise > 0) return;
  Refuse({"--noise"}, "is '{}'; give the standard deviation of a torque sample, above 0, or a log",
         Excerpt(given));
}

std::string Percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// A row for each number, a column for each part of the motion.
std::string TableOf(const Design& design, const Page& page) {
  Table table{{"95 % half width after"}, {}};
  for (const ForetoldAnswer& one : design.foretold) {
    table.header.push_back(fmt::format("{:.3g} min", one.minutes));
  }
  const auto row = [&](const std::string& name, const DesignAim& aim) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells.push_back(name);
    for (const ForetoldAnswer& one : design.foretold) {
      const auto half = HalfWidthShare(one, aim);
      cells.push_back(half ? Percent(*half) : "-");
    }
  };
  row("friction", {AimKind::friction});
  for (const auto& [name, deviation] : design.draws.front().deviations) {
    row(name, {AimKind::parameter, name});
  }
  return TableToText(table, 1, page);
}

/// What is foretold of one joint.
std::string TextOf(const Design& design, const Page& page) {
  const ForetoldAnswer& whole = design.foretold.back();
  std::string text = TableOf(design, page);
  if (whole.status != Status::ok) {
    text += fmt::format("The identifier would refuse this log ({}): {}\n", NameOf(whole.status),
                        whole.message);
  }
  for (const DesignRatio& ratio : design.ratios) {
    text += fmt::format(
        "standard deviation over that of {}: {:.2f}, in the worst draw of the prior {:.2f}\n",
        ratio.against, ratio.middle, ratio.worst);
  }
  if (design.settings.aim.share) {
    text += design.enough ? fmt::format("{} is reached after {:.3g} min\n",
                                        TextOf(design.settings.aim), *design.enough)
                          : fmt::format("{} is not reached in {:g} min: give more --minutes\n",
                                        TextOf(design.settings.aim), design.settings.minutes);
  }
  return text;
}

/// The same of all joints of a robot, and what they do to each other.
std::string TextOf(const RobotDesign& design, const Page& page) {
  std::string text;
  for (const JointDesign& joint : design.joints) {
    text += fmt::format("{}\n{}\n", joint.name, TextOf(static_cast<const Design&>(joint), page));
  }
  if (design.joints.size() > 1) {
    text += design.coupling.empty()
                ? "No joint's torque shows that others move: each can be identified by itself.\n"
                : "These torques show that others move; `warmjoint identify-robot` takes that into "
                  "account, and `identify` of one joint does not:\n";
  }
  for (const DesignCoupling& one : design.coupling) {
    text += fmt::format("  {} by {}: up to {:.3g}\n", one.joint, one.by, one.torque);
  }
  for (const std::string& notice : design.notices) text += notice + "\n";
  return text;
}

/// Settings of a robot's joints.
RobotDesignSettings RobotOf(const DesignArguments& arguments) {
  RobotDesignSettings robot = arguments.robot;
  if (arguments.joints.empty()) {
    Refuse({"--joint"}, "is not given; name the joints of {} that move, or give '.*' for all",
           robot.robot);
  }
  robot.joints = arguments.joints;
  robot.each = arguments.settings;
  for (const auto& [joint, value] : ReadPairs(arguments.at, "--at")) {
    const auto number = ParseFinite(value);
    if (!number) Refuse({"--at"}, "'{}={}' is no number", Excerpt(joint), Excerpt(value));
    robot.at[joint] = *number;
  }
  // for all joints, or of one
  for (const std::string& prior : arguments.priors) {
    const size_t equals = prior.find('=');
    if (equals == std::string::npos) {
      robot.each.prior = prior;
    } else {
      robot.priors[prior.substr(0, equals)] = prior.substr(equals + 1);
    }
  }
  return robot;
}

/// The files of a design, and what is said of it.
struct Made {
  std::vector<std::pair<std::string, std::string>> files;
  std::function<std::string(const Page&)> words;
};

Made MakeMotion(const DesignArguments& arguments, const std::optional<PreparedLog>& after,
                const std::function<void(const std::string&)>& watch) {
  if (!arguments.robot.robot.empty()) {
    const auto design =
        std::make_shared<RobotDesign>(DesignRobotMotion(RobotOf(arguments), after, watch));
    return {FilesOf(*design), [design](const Page& page) { return TextOf(*design, page); }};
  }
  if (arguments.joints.size() > 1 || arguments.priors.size() > 1 || !arguments.at.empty()) {
    Refuse({"design"}, "several joints, --prior of each and --at are for a robot; give its file");
  }
  DesignSettings settings = arguments.settings;
  if (!arguments.priors.empty()) settings.prior = arguments.priors.front();
  const auto design = std::make_shared<Design>(DesignMotion(settings, after, watch));
  const std::string joint = arguments.joints.empty() ? "joint" : arguments.joints.front();
  return {FilesOf(*design, joint), [design](const Page& page) { return TextOf(*design, page); }};
}

ExitStatus MakeDesign(DesignArguments arguments) {
  DesignSettings& settings = arguments.settings;
  settings.aim = AimFrom(arguments.aim);
  for (const std::string& entry : arguments.limits) TakeLimit(entry, settings.limits);
  TakeNoise(arguments.noise, arguments.after.read, settings);
  if (arguments.seed) settings.seed = *arguments.seed;
  AtomicDirectory directory(arguments.output, {"design.json", "motion.csv", "setpoints.csv",
                                               "trajectory.yaml", "motion.script"});

  Activity activity("reading what is known");
  std::optional<PreparedLog> after;
  if (!arguments.after.files.empty()) after = ReadAndPrepare(arguments.after);
  const Made made =
      MakeMotion(arguments, after, [&](const std::string& words) { activity.Is(words); });
  std::vector<std::string> names;
  for (const auto& [name, text] : made.files) {
    WriteWholeFile(directory.temporary() / name, text);
    names.push_back(name);
  }
  directory.Commit();
  activity.Aside([&] {
    if (arguments.format == "json") {
      fmt::print(stdout, "{}", made.files.front().second);
    } else {
      Say(stdout, "{}{}: {}\n", made.words(PageOf(stdout)), arguments.output,
          fmt::join(names, ", "));
    }
  });
  return ExitStatus::done;
}

}  // namespace

Command AddDesignCommand(CLI::App& program) {
  auto arguments = std::make_shared<DesignArguments>();
  DesignSettings& settings = arguments->settings;
  CLI::App* parser =
      program.add_subcommand("design", "Which motion to record, and what its log will tell");
  GiveExample(
      *parser,
      "warmjoint design --limits position=-1.5..1.5,velocity=0.05..1 --minutes 20 -o motion");
  AddValue(*parser, "ROBOT", "ROBOT", arguments->robot.robot,
           "a robot of `list robots`, or an MJCF or URDF file, whose limits of position, velocity "
           "and effort count, and whose links stay apart");
  AddValue(*parser, "-o,--output", "DIR", arguments->output,
           "directory for the files, made as a whole")
      ->required();
  AddNumber(*parser, "--minutes", settings.minutes, {1, 600, "from 1 to 600"},
            "length of the recording")
      ->capture_default_str();
  AddValue(*parser, "--limits", "NAME=A..B,...", arguments->limits,
           "position, velocity (slowest and fastest), acceleration and torque that the motion "
           "keeps to; rad, s and N.m, or m, s and N")
      ->delimiter(',')
      ->take_all();
  AddValue(*parser, "--for", "AIM", arguments->aim,
           "D: all parameters alike; friction, or the name of a parameter; with =5% the half width "
           "of its 95 % interval that is enough")
      ->capture_default_str();

  BeginGroup(*parser, "What is expected");
  AddValue(*parser, "--prior", "[JOINT=]FILE", arguments->priors,
           "friction that is expected, of all joints or of one: an estimate.json, or a friction "
           "file whose numbers may be ranges; else broad ranges");
  AddValue(*parser, "--noise", "NUMBER|LOG", arguments->noise,
           "standard deviation of a torque sample, N.m or N, or a log of these sensors, whose rate "
           "is taken, too; else 2 % of the friction");
  AddNumber(*parser, "--rate", settings.rate, {1, 10000, "from 1 to 10000"},
            "samples in a second, Hz")
      ->capture_default_str();
  AddNumber(*parser, "--hold", settings.hold, {1, 600, "from 1 to 600"},
            "longest stroke at one speed, s")
      ->capture_default_str();
  AddChoice(*parser, "--joint-kind", settings.joint,
            "rotary, with rad and N.m, or linear, with m and N");
  AddValue(*parser, "--joint", "NAME", arguments->joints,
           "of the robot, a name or a pattern of names; joints that are given move at once");
  AddValue(*parser, "--at", "JOINT=VALUE", arguments->at,
           "where a joint of the robot begins, or stands: rad or m");
  AddNumber(*parser, "--clearance", arguments->robot.clearance, {0, 1, "from 0 to 1"},
            "that the robot's links keep from each other and from what stands around, m")
      ->capture_default_str();
  AddValue(*parser, "--identifier", "NAME", settings.identifier, "that will read the log")
      ->capture_default_str();
  AddChoice(*parser, "--start", settings.start, "what will be known of the heat at the start");
  AddValue(*parser, "--after", "RECORDING", arguments->after.files,
           "earlier log of the joint, with which the new one will be identified: the motion adds "
           "what it lacks")
      ->expected(1);
  AddWholeNumber(*parser, "--seed", arguments->seed, 0, std::numeric_limits<std::uint64_t>::max(),
                 "of all random numbers; default: 1");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"},
            "of what is printed; json: as in design.json");
  return {parser, [arguments] { return MakeDesign(*arguments); }};
}

}  // namespace warmjoint
