// warmjoint plot SOURCE... -o DIR: pictures of runs, estimates and simulated recordings.
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/actions/outputs.h"
#include "tools/cli/command.h"
#include "tools/cli/pictures.h"
#include "tools/cli/recording_options.h"
#include "tools/report/draw/draw_figure.h"
#include "tools/report/draw/figure_data.h"
#include "tools/report/draw/layout.h"
#include "tools/report/estimate/overlay.h"
#include "tools/terminal/progress_line.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::vector<std::string> sources;
  RecordingSource recording;
  PictureArguments pictures;
  bool data = false;
  std::string output;
};

/// Draws figures into files and prints what each shows.
class Album {
 public:
  Album(const report::PageSetting& setting, Activity& activity)
      : setting_(setting), activity_(activity) {}

  /// recordings: that must not be written over by the numbers of --data.
  void Draw(const report::Figure& figure, const fs::path& folder, bool with_data,
            const std::vector<fs::path>& recordings) {
    // the file is called as the figure
    const fs::path path =
        folder / fmt::format("{}.{}", figure.name, report::NameOf(setting_.format));
    activity_.Is("drawing " + path.string());
    const report::PictureFile file = report::EncodeFigure(figure, setting_);
    WriteWholeFile(path, file.bytes);
    Print(path, file.caption);

    // the numbers that it shows
    if (!with_data) return;
    const fs::path data = folder / (figure.name + ".csv");
    KeepApart({data}, recordings);
    WriteWholeFile(data, report::FigureCsv(figure));
    Print(data, "the series of " + figure.name);
  }

 private:
  void Print(const fs::path& path, const std::string& finding) {
    activity_.Aside([&] { Say(stdout, "{}: {}\n", path.string(), finding); });
  }

  const report::PageSetting& setting_;
  Activity& activity_;
};

/// The folder of each source: DIR for one, DIR/NAME for several.
std::vector<fs::path> FoldersOf(const PlotArguments& arguments) {
  // each by its own name, without what stands before and behind it
  if (arguments.sources.size() == 1) return {arguments.output};
  std::vector<fs::path> folders;
  std::set<fs::path> taken;
  for (const std::string& source : arguments.sources) {
    const fs::path name = fs::path(source).lexically_normal();
    folders.push_back(arguments.output / (name.has_filename() ? name : name.parent_path()).stem());
    // two of one name would draw over each other
    if (!taken.insert(folders.back()).second) {
      Refuse({source}, "two sources would fill {}: draw them one at a time",
             folders.back().string());
    }
  }
  return folders;
}

/// Says which figures of its family a source does not give, and why.
void TellLeftOut(const std::string& source, const SourcePictures& pictures) {
  // figures that need the same are told together
  std::map<std::string, std::vector<std::string>> by_need;
  for (const auto& [name, need] : pictures.left_out) by_need[need].push_back(name);
  std::vector<std::string> clauses;
  for (const auto& [need, names] : by_need) {
    clauses.push_back(fmt::format("{} ({} {})", fmt::join(names, ", "),
                                  names.size() == 1 ? "needs" : "need", need));
  }
  if (!clauses.empty()) SayNotice("{}: left out: {}\n", source, fmt::join(clauses, "; "));
}

ExitStatus PlotSources(const PlotArguments& arguments) {
  const std::vector<fs::path> folders = FoldersOf(arguments);
  // refused before the pictures are drawn
  const report::PageSetting setting = SettingOf(arguments.pictures);
  Activity activity("preparing to draw");
  Album album(setting, activity);
  std::vector<report::NamedEstimate> estimates;
  std::vector<fs::path> recordings;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    activity.Is("reading " + arguments.sources[i]);
    SourcePictures pictures = PicturesOf(arguments.sources[i], arguments.recording);
    // without --figure the whole family, and word of what it lacks
    const bool all = arguments.pictures.figures.empty();
    if (all) activity.Aside([&] { TellLeftOut(arguments.sources[i], pictures); });
    const std::vector<report::Figure> figures =
        Chosen(arguments.pictures, arguments.sources[i], pictures);

    // their folder, made where it is absent
    std::error_code error;
    fs::create_directories(folders[i], error);
    if (error || !fs::is_directory(folders[i])) {
      Refuse({folders[i].string()}, "cannot be made ({}); give a directory",
             error ? error.message() : "it is a file");
    }
    for (const report::Figure& figure : figures) {
      try {
        album.Draw(figure, folders[i], arguments.data, pictures.recordings);
      } catch (const report::TooSmall& refusal) {
        // one that was not asked for by name is no reason to lose the others
        if (!all) throw;
        activity.Aside(
            [&] { SayNotice("{}: left out: {}\n", arguments.sources[i], refusal.what()); });
      }
    }
    recordings.insert(recordings.end(), pictures.recordings.begin(), pictures.recordings.end());
    if (pictures.estimate) {
      const std::string name = fs::path(arguments.sources[i]).stem().string();
      estimates.emplace_back(name, *std::move(pictures.estimate));
    }
  }

  // several estimates in one figure
  const bool all_figures = arguments.pictures.figures.empty();
  if (const auto overlay = report::MakeOverlay(estimates); overlay && all_figures) {
    album.Draw(*overlay, arguments.output, arguments.data, recordings);
  }
  return ExitStatus::done;
}

}  // namespace

Command AddPlotCommand(CLI::App& program) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* parser = program.add_subcommand("plot", "Pictures as PNG, SVG or PDF files");
  // what is drawn, and where to
  parser
      ->add_option("SOURCE", arguments->sources,
                   "directory of `run` or `simulate`, estimate file, or `kernels` (normalised and "
                   "plain kernels); several fill folders of their own")
      ->type_name("SOURCE")
      ->required();
  parser->add_option("-o,--output", arguments->output, "directory for the pictures; made if absent")
      ->type_name("DIR")
      ->required();

  // whose data is shown
  parser
      ->add_option("--recording", arguments->recording.files,
                   "data of an estimate, instead of the files that it remembers")
      ->type_name("RECORDING");
  AddLayoutOptions(*parser, arguments->recording.read);

  // how it looks
  AddPictureOptions(*parser, arguments->pictures);
  parser->add_flag("--data", arguments->data,
                   "also the series of each picture, before thinning, as NAME.csv");
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return PlotSources(*arguments);
          }};
}

}  // namespace warmjoint
