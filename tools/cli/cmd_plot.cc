// warmjoint plot SOURCE... -o DIR: pictures of runs, estimates and simulated recordings.
#include <fmt/ranges.h>

#include <map>
#include <memory>
#include <set>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/pictures.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
#include "tools/figures/estimate_figures.h"
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

/// A figure with the folder of its picture.
struct Wanted {
  fs::path folder;
  figures::Figure figure;
  std::string source;
};

/// Writes the picture and, where wanted, the numbers of each figure, and prints what each shows.
void WriteAll(const std::vector<Wanted>& wanted, const std::vector<DrawnFigure>& drawn,
              const PlotArguments& arguments, const std::vector<fs::path>& recordings,
              Activity& activity) {
  const auto print = [&](const fs::path& path, const std::string& finding) {
    activity.Aside([&] { fmt::print(stdout, "{}: {}\n", path.string(), finding); });
  };
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const figures::Figure& figure = wanted[i].figure;
    // one that was not asked for by name is no reason to lose the others
    if (!drawn[i].refusal.empty()) {
      activity.Aside([&] { SayNotice("{}: left out: {}\n", wanted[i].source, drawn[i].refusal); });
      continue;
    }
    // the file is called as the figure
    const auto format = NameOf(arguments.pictures.setting.format);
    const fs::path path = wanted[i].folder / fmt::format("{}.{}", figure.name, format);
    WriteWholeFile(path, drawn[i].bytes);
    print(path, figure.finding);

    // the numbers that it shows
    if (!arguments.data) continue;
    const fs::path data = wanted[i].folder / (figure.name + ".csv");
    KeepApart({data}, recordings);
    WriteWholeFile(data, figures::FigureCsv(figure));
    print(data, "the series of " + figure.name);
  }
}

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

/// Throws BadInput for what is there and no folder.
void RefuseFile(const fs::path& folder) {
  std::error_code absent;
  if (!fs::exists(folder, absent) || fs::is_directory(folder, absent)) return;
  Refuse({folder.string()}, "cannot be made (it is a file); give a directory");
}

/// Throws BadInput where it cannot be made.
void MakeFolder(const fs::path& folder) {
  RefuseFile(folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  Refuse({folder.string()}, "cannot be made ({}); give a directory", error.message());
}

ExitStatus PlotSources(const PlotArguments& arguments) {
  const std::vector<fs::path> folders = FoldersOf(arguments);
  // refused before anything is read
  const PictureSetting setting = SettingOf(arguments.pictures);
  for (const fs::path& folder : folders) RefuseFile(folder);
  const Backend backend;
  Activity activity("preparing to draw");
  std::vector<Wanted> wanted;
  std::vector<figures::NamedEstimate> estimates;
  std::vector<fs::path> recordings;
  // without --figure the whole family, and word of what it lacks
  const bool all = arguments.pictures.figures.empty();
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::string& source = arguments.sources[i];
    activity.Is("reading " + source);
    SourcePictures pictures = PicturesOf(source, arguments.recording);
    if (all) activity.Aside([&] { TellLeftOut(source, pictures); });
    for (figures::Figure& figure : Chosen(arguments.pictures, source, pictures)) {
      wanted.push_back({folders[i], std::move(figure), source});
    }
    recordings.insert(recordings.end(), pictures.recordings.begin(), pictures.recordings.end());
    if (pictures.estimate) {
      estimates.emplace_back(fs::path(source).stem().string(), *std::move(pictures.estimate));
    }
  }
  // several estimates in one figure
  if (auto overlay = figures::MakeOverlay(estimates); overlay && all) {
    wanted.push_back({arguments.output, *std::move(overlay), arguments.output});
  }

  // all of them at once
  activity.Is(fmt::format("drawing {} pictures", wanted.size()));
  std::vector<figures::Figure> figures;
  for (const Wanted& one : wanted) figures.push_back(one.figure);
  const auto drawn = backend.Draw(figures, setting);
  // nothing is written where a figure that was asked for by name could not be drawn
  for (const DrawnFigure& one : drawn) {
    if (!all && !one.refusal.empty()) Refuse({}, "{}", one.refusal);
  }
  for (const fs::path& folder : folders) MakeFolder(folder);
  WriteAll(wanted, drawn, arguments, recordings, activity);
  return ExitStatus::done;
}

}  // namespace

Command AddPlotCommand(CLI::App& program) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* parser = program.add_subcommand("plot", "Pictures as PNG, SVG or PDF files");
  // what is drawn, and where to
  AddValue(*parser, "SOURCE", "SOURCE", arguments->sources,
           "directory of `run` or `simulate`, estimate file, or `kernels` (normalised and "
           "plain kernels); several fill folders of their own")
      ->required();
  AddValue(*parser, "-o,--output", "DIR", arguments->output,
           "directory for the pictures; made if absent")
      ->required();

  // whose data is shown
  AddValue(*parser, "--recording", "RECORDING", arguments->recording.files,
           "data of an estimate, instead of the files that it remembers");
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
