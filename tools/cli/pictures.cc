#include "tools/cli/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "identification/estimate.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/parse_number.h"
#include "models/recording/read_recording.h"
#include "tools/cli/typed_options.h"
#include "tools/shown/estimate_data.h"
#include "tools/shown/kernel_example.h"
#include "tools/shown/run/run_data.h"
#include "tools/shown/run/simulation_view.h"
#include "tools/shown/run/warm_robot.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// The recording that an estimate file remembers; none where it names none, or it has gone.
RecordingSource OwnRecording(const Estimate& estimate, const std::string& file) {
  // a recording that is not named, or has gone, is no reason for no pictures
  const std::optional<RecordingSource> remembered = RecordingOf(estimate, file);
  if (!remembered) {
    SayNotice("{}: names no recording; give --recording for the pictures that need it\n", file);
    return {};
  }
  for (const std::string& recording : remembered->files) {
    if (fs::exists(recording)) continue;
    // a warning, which --quiet leaves: it was there when the estimate was made
    Say(stderr,
        "{}: its recording {} is not there; give --recording for the pictures that need it\n", file,
        recording);
    return {};
  }
  return *remembered;
}

PictureSource OfEstimate(const fs::path& path, const RecordingSource& given,
                         shown::ShownData& data) {
  // the estimate beside the recording that is given, else beside its own, else alone
  Estimate estimate = ReadEstimate(path);
  const bool is_own = given.files.empty();
  const RecordingSource shown = is_own ? OwnRecording(estimate, path) : given;
  const shown::EstimateView view =
      shown.files.empty() ? shown::EstimateView{std::move(estimate)}
      : is_own            ? shown::ViewOwnRecording(std::move(estimate), ReadAndPrepare(shown))
                          : shown::MakeEstimateView(std::move(estimate), ReadAndPrepare(shown));
  return {shown::EstimateFacts(view, data), {shown.files.begin(), shown.files.end()}};
}

PictureSource OfSimulation(const fs::path& directory, shown::ShownData& data) {
  const shown::SimulationView view = shown::ReadSimulationView(directory);
  PictureSource source{shown::SimulationFacts(view, data), {directory / "recording.csv"}};
  // a robot that warms needs OpenGL for its pictures
  source.facts["robot"] = nullptr;
  if (!shown::HasWarmRobot(view)) return source;
  const std::unique_ptr<scene::GlContext> context = scene::MakeGlContext();
  source.facts["robot"] = shown::WarmRobotFacts(view, *context, data);
  return source;
}

/// A joint's motion as a picture shows it. prefix: of its columns
Tree MotionFacts(const FileContent& motion, const std::string& prefix, const Tree& design,
                 const fs::path& file) {
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(motion.columns, name, &FileColumn::name);
    if (found == motion.columns.end()) {
      Refuse({file}, "has no column '{}'; make it by `warmjoint design`", name);
    }
    return std::vector<double>(found->values.begin(), found->values.end());
  };
  const bool is_linear = design.value("settings", Tree::object()).value("joint", "") == "linear";
  const JointKind joint = is_linear ? JointKind::linear : JointKind::rotary;
  return {{"time", column("time")},
          {"velocity", column(prefix + "velocity")},
          {"unit", kVelocityUnit.For(joint)}};
}

/// Of a directory of `design`: of each joint what is foretold, and its motion.
PictureSource OfDesign(const fs::path& directory) {
  const Tree design = ReadJsonFile(directory / "design.json");
  const fs::path file = directory / "motion.csv";
  const FileContent motion = ParseTable(ReadWholeFile(file), file);
  Tree joints = Tree::array();
  if (!design.contains("joints")) {
    joints.push_back({{"file", "design"},
                      {"joint", ""},
                      {"design", design},
                      {"motion", MotionFacts(motion, "", design, file)}});
  } else {
    std::set<std::string> taken;
    for (const auto& [name, one] : design["joints"].items()) {
      joints.push_back({{"file", shown::FileOf(name, taken)},
                        {"joint", name},
                        {"design", one},
                        {"motion", MotionFacts(motion, name + "_", one, file)}});
    }
  }
  return {{{"joints", joints}}};
}

constexpr double kSmallest = 20, kLargest = 2000;  // mm

double Millimetres(const std::string& text, const std::string& size) {
  // within what can be printed
  const std::optional<double> number = ParseNumber(text);
  if (!number || !(*number >= kSmallest && *number <= kLargest)) {
    Refuse({"--size"},
           "'{}' is no size; give width x height in mm, {:.0f} to {:.0f} each, as 88x60, or the "
           "width alone",
           size, kSmallest, kLargest);
  }
  return *number;
}

}  // namespace

PictureSource SourceOf(const std::string& source, const RecordingSource& recording,
                       shown::ShownData& data) {
  // by what stands there, of a file by its kind, of a directory by what it holds
  PictureSource made;
  std::string kind = "kernels";
  if (source == kKernelsSource && !fs::exists(source)) {
    made.facts = shown::KernelFacts(data);
  } else if (fs::is_regular_file(source)) {
    kind = "estimate";
    made = OfEstimate(source, recording, data);
  } else if (fs::exists(fs::path(source) / "design.json")) {
    kind = "design";
    made = OfDesign(source);
  } else if (shown::IsSimulation(source)) {
    kind = "simulation";
    made = OfSimulation(source, data);
  } else {
    kind = "run";
    made.store = std::make_shared<RunStore>(RunStore::OpenToRead(source));
    made.facts = shown::RunFacts(*made.store, data);
  }
  made.facts["kind"] = kind;
  made.facts["place"] = source;
  return made;
}

void AddPictureOptions(CLI::App& parser, PictureArguments& arguments) {
  AddValue(parser, "--figure", "NAME|N", arguments.figures,
           "only this one, by its name, or by the number (3 to 12) of the paper's figure "
           "that it repeats")
      ->take_all();
  // format and style
  AddChoice(parser, "--format", arguments.setting.format, "of the pictures");
  AddChoice(parser, "--style", arguments.setting.style, {"screen", "dark", "paper"},
            "screen: words of 10 points, 144 pixels an inch; dark: the same for dark screens; "
            "paper: 180 mm wide, words of 8 points, black, 300 pixels an inch");

  // size and resolution
  AddValue(parser, "--size", "WxH", arguments.size,
           "width x height of each picture in mm, as 88x60, or its width alone");
  AddNumber(parser, "--dpi", arguments.setting.dpi, {30, 1200, "30 to 1200"},
            "pixels an inch of PNG; the style's where it is not given");

  // titles
  const auto show = [&arguments](const std::string& choice) {
    arguments.setting.titled = choice == "shown";
  };
  AddChoice(parser, "--title", show, {"shown", "none"},
            "of the figures, which papers give in the caption")
      ->default_str("shown");
}

PictureSetting SettingOf(const PictureArguments& arguments) {
  PictureSetting setting = arguments.setting;
  // one number is the width, and the height follows
  if (!arguments.size.empty()) {
    const std::size_t cross = arguments.size.find('x');
    setting.width = Millimetres(arguments.size.substr(0, cross), arguments.size);
    if (cross != arguments.size.npos) {
      setting.height = Millimetres(arguments.size.substr(cross + 1), arguments.size);
    }
  }
  return setting;
}

}  // namespace warmjoint
