// warmjoint plot SOURCE... -o DIR: pictures of runs, estimates and simulated recordings.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/cli/command.h"
#include "tools/cli/plot_sources.h"
#include "tools/cli/take_project.h"
#include "tools/report/draw/draw_figure.h"
#include "tools/report/gl/film.h"
#include "tools/report/page/contact_sheet.h"
#include "tools/terminal/activity.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

constexpr double kFrameSeconds = 0.125;
constexpr int kSheetColumn = 200;    // points
constexpr double kSheetShape = 1.6;  // columns for each row

struct PlotArguments {
  std::vector<std::string> sources;
  RecordingArguments recording;
  std::string output;
  std::string sheet;
};

/// Draws figures into files and remembers the first of each kind for the contact sheet.
class Album {
 public:
  Album(report::Canvas& canvas, Activity& activity) : canvas_(canvas), activity_(activity) {}

  void Draw(const report::Figure& figure, const fs::path& folder) {
    const fs::path path = folder / (figure.name + ".png");
    activity_.Is("drawing " + path.string());
    report::Image image = report::DrawFigure(canvas_, figure).image;
    report::WritePng(image, figure.finding, path);
    Tell(path, figure.finding);
    const bool is_new = std::none_of(pages_.begin(), pages_.end(),
                                     [&](const auto& page) { return page.first == figure.name; });
    if (is_new) pages_.emplace_back(figure.name, std::move(image));
  }

  void DrawFilm(const std::vector<report::Figure>& film, const fs::path& folder) {
    if (film.empty()) return;
    std::vector<report::Image> frames;
    for (const report::Figure& frame : film) {
      activity_.Is(fmt::format("drawing frame {} of {}", frames.size() + 1, film.size()));
      frames.push_back(report::Shrink(report::DrawFigure(canvas_, frame).image,
                                      report::Canvas::kPixelsPerPoint));
    }
    const fs::path path = folder / (film.front().name + ".png");
    WriteWholeFile(path, report::EncodeFilm(frames, kFrameSeconds, film.front().title));
    Tell(path, fmt::format("{}, {} frames", film.front().title, frames.size()));
  }

  void WriteSheet(const fs::path& path) {
    if (pages_.empty()) return;
    // wider than high
    const double count = static_cast<double>(pages_.size());
    const int columns = static_cast<int>(std::ceil(std::sqrt(kSheetShape * count)));
    const report::Figure sheet =
        report::MakeContactSheet(pages_, columns, std::max(2, columns) * kSheetColumn);
    report::WritePng(report::DrawFigure(canvas_, sheet).image, sheet.finding, path);
    Tell(path, sheet.finding);
  }

 private:
  void Tell(const fs::path& path, const std::string& finding) {
    activity_.Aside([&] { Say(stdout, "{}: {}\n", path.string(), finding); });
  }

  report::Canvas& canvas_;
  Activity& activity_;
  std::vector<std::pair<std::string, report::Image>> pages_;
};

/// The folder of each source: DIR for one, DIR/NAME for several.
std::vector<fs::path> FoldersOf(const PlotArguments& arguments) {
  if (arguments.sources.size() == 1) return {arguments.output};
  std::vector<fs::path> folders;
  std::set<fs::path> taken;
  for (const std::string& source : arguments.sources) {
    const fs::path name = fs::path(source).lexically_normal();
    folders.push_back(arguments.output / (name.has_filename() ? name : name.parent_path()).stem());
    if (!taken.insert(folders.back()).second) {
      Refuse({source}, "two sources would fill {}: draw them one at a time",
             folders.back().string());
    }
  }
  return folders;
}

ExitStatus PlotSources(const PlotArguments& arguments) {
  const std::vector<fs::path> folders = FoldersOf(arguments);
  // refused before the pictures are drawn; it is made anew when they are
  if (!arguments.sheet.empty()) AtomicFile(arguments.sheet);
  Activity activity("preparing to draw");
  report::Canvas canvas;
  Album album(canvas, activity);
  for (std::size_t i = 0; i < folders.size(); ++i) {
    activity.Is("reading " + arguments.sources[i]);
    const SourcePictures pictures = PicturesOf(arguments.sources[i], arguments.recording, canvas);
    std::error_code error;
    fs::create_directories(folders[i], error);
    if (error || !fs::is_directory(folders[i])) {
      Refuse({folders[i].string()}, "cannot be made ({}); give a directory",
             error ? error.message() : "it is a file");
    }
    for (const report::Figure& figure : pictures.figures) album.Draw(figure, folders[i]);
    album.DrawFilm(pictures.film, folders[i]);
  }
  if (!arguments.sheet.empty()) album.WriteSheet(arguments.sheet);
  return ExitStatus::done;
}

}  // namespace

Command AddPlotCommand(CLI::App& program) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* parser = program.add_subcommand("plot", "Pictures as PNG files");
  parser
      ->add_option("SOURCE", arguments->sources,
                   "directory of `run` or `simulate`, estimate file, or `kernels` (normalised and "
                   "plain kernels); several fill folders of their own")
      ->type_name("SOURCE")
      ->required();
  parser->add_option("-o,--output", arguments->output, "directory for the pictures; made if absent")
      ->type_name("DIR")
      ->required();
  parser
      ->add_option("--recording", arguments->recording.recordings,
                   "data of an estimate, instead of the files that it remembers")
      ->type_name("RECORDING");
  AddLayoutOptions(*parser, arguments->recording);
  parser
      ->add_option("--sheet", arguments->sheet,
                   "contact sheet (PNG): the first picture of each kind")
      ->type_name("FILE");
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return PlotSources(*arguments);
          }};
}

}  // namespace warmjoint::inline tools
