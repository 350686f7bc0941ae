#include "tools/cli/pictures.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "identification/estimate.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/parse_number.h"
#include "tools/cli/typed_options.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/run/simulation_figures.h"
#include "tools/figures/run/warm_robot.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// All members of a family that have something to show, and what the others lack.
template <typename View>
SourcePictures Make(const std::vector<figures::NamedFigure<View>>& family, const View& view) {
  SourcePictures pictures;
  // who has nothing to draw says what is needed for it
  for (const auto& one : family) {
    if (auto figure = one.make(view)) {
      pictures.figures.push_back(*std::move(figure));
    } else {
      pictures.left_out.emplace_back(one.name, one.needs);
    }
  }
  return pictures;
}

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
    fmt::print(
        stderr,
        "{}: its recording {} is not there; give --recording for the pictures that need it\n", file,
        recording);
    return {};
  }
  return *remembered;
}

SourcePictures PicturesOfEstimate(const fs::path& path, const RecordingSource& given) {
  // the estimate beside the recording that is given, else beside its own, else alone
  Estimate estimate = ReadEstimate(path);
  const bool is_own = given.files.empty();
  const RecordingSource shown = is_own ? OwnRecording(estimate, path) : given;
  figures::EstimateView view =
      shown.files.empty() ? figures::EstimateView{std::move(estimate)}
      : is_own            ? figures::ViewOwnRecording(std::move(estimate), ReadAndPrepare(shown))
                          : figures::MakeEstimateView(std::move(estimate), ReadAndPrepare(shown));

  // what it gives, and itself for the figure of several
  SourcePictures pictures = Make(figures::EstimateFigures(), view);
  pictures.estimate = std::move(view);
  pictures.recordings.assign(shown.files.begin(), shown.files.end());
  return pictures;
}

SourcePictures PicturesOfSimulation(const fs::path& directory) {
  const figures::SimulationView view = figures::ReadSimulationView(directory);
  // a robot that warms needs OpenGL for its pictures
  SourcePictures pictures = Make(figures::SimulationFigures(), view);
  pictures.recordings = {directory / "recording.csv"};
  if (!figures::HasWarmRobot(view)) return pictures;
  const std::unique_ptr<scene::GlContext> context = scene::MakeGlContext();
  pictures.figures.push_back(*figures::MakeWarmRobot(view, *context));
  return pictures;
}

using Names = std::vector<std::string>;

constexpr double kSmallest = 20, kLargest = 2000;  // mm

/// A figure of the paper: ours that repeat it, and what they are drawn of.
struct PaperFigure {
  Names names;
  const char* sources;
};

const std::map<std::string, PaperFigure>& PaperFigures() {
  static const std::map<std::string, PaperFigure> figures{
      {"3", {{"kernels"}, "`kernels`"}},
      {"4", {{"envelope"}, "an estimate or a simulation of a log that warms"}},
      {"5", {{"parameters_by_iteration"}, "a run of an identifier that iterates"}},
      {"6", {{"error_by_iteration"}, "a run of an identifier that iterates"}},
      {"7", {{"motor_angle"}, "an estimate of a log with a motor angle or a gear"}},
      {"8", {{"parameters_by_iteration", "trace"}, "a run, or an estimate, that iterates"}},
      {"9", {{"motor_fit"}, "an estimate with a map over the motor's angle"}},
      {"10", {{"motor_map"}, "an estimate with a map over the motor's angle"}},
      {"11", {{"agreement"}, "a run"}},
      {"12", {{"agreement"}, "a run"}},
  };
  return figures;
}

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

Names NamesOf(const std::vector<figures::Figure>& figures) {
  Names names;
  for (const figures::Figure& figure : figures) names.push_back(figure.name);
  return names;
}

/// Why a source has no figure of that name.
std::string Lacking(const std::string& figure, const SourcePictures& pictures) {
  // a figure of the family that the source cannot give, or none of the family at all
  for (const auto& [name, need] : pictures.left_out) {
    if (name == figure) return fmt::format("{} needs {}", figure, need);
  }
  return fmt::format("there is no figure '{}'", figure);
}

}  // namespace

SourcePictures PicturesOf(const std::string& source, const RecordingSource& recording) {
  // by what stands there, of a file by its kind, of a directory by what it holds
  if (source == kKernelsSource && !fs::exists(source))
    return {{figures::MakeKernels()}, {}, {}, {}};
  if (fs::is_regular_file(source)) return PicturesOfEstimate(source, recording);
  if (figures::IsSimulation(source)) return PicturesOfSimulation(source);
  return Make(figures::RunFigures(), figures::ReadRunView(RunStore::OpenToRead(source)));
}

void AddPictureOptions(CLI::App& parser, PictureArguments& arguments) {
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

  // titles, and which figures
  const auto show = [&arguments](const std::string& choice) {
    arguments.setting.titled = choice == "shown";
  };
  AddChoice(parser, "--title", show, {"shown", "none"},
            "of the figures, which papers give in the caption")
      ->default_str("shown");
  AddValue(parser, "--figure", "NAME|N", arguments.figures,
           "only this one, by its name, or by the number (3 to 12) of the paper's figure "
           "that it repeats")
      ->take_all();
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

std::vector<figures::Figure> Chosen(const PictureArguments& arguments, const std::string& source,
                                    const SourcePictures& pictures) {
  std::vector<figures::Figure> figures = pictures.figures;
  if (arguments.figures.empty()) return figures;
  Names wanted;
  // each by the name of the figure, or by the paper's number for it
  for (const std::string& figure : arguments.figures) {
    const auto paper = PaperFigures().find(figure);
    const Names names = paper == PaperFigures().end() ? Names{figure} : paper->second.names;
    const Names there = NamesOf(figures);
    // what cannot be had is refused with what there is
    if (std::ranges::find_first_of(there, names) == there.end()) {
      const std::string what = paper == PaperFigures().end()
                                   ? Lacking(figure, pictures)
                                   : fmt::format("figure {} of the paper ({}) needs {}", figure,
                                                 fmt::join(names, " or "), paper->second.sources);
      Refuse({source}, "{}; this source gives: {}", what,
             there.empty() ? "none" : fmt::format("{}", fmt::join(there, ", ")));
    }
    wanted.insert(wanted.end(), names.begin(), names.end());
  }

  // in the family's own order, each once
  std::erase_if(figures, [&](const figures::Figure& figure) {
    return std::ranges::find(wanted, figure.name) == wanted.end();
  });
  return figures;
}

}  // namespace warmjoint
