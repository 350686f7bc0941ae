// warmjoint plot SOURCE... -o DIR: pictures of runs, estimates and simulated recordings.
#include <fmt/format.h>

#include <memory>
#include <set>

#include "models/foundation/bad_input.h"
#include "tools/actions/outputs.h"
#include "tools/cli/backend.h"
#include "tools/cli/command.h"
#include "tools/cli/pictures.h"
#include "tools/cli/recording_options.h"
#include "tools/cli/typed_options.h"
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

/// Writes each picture and its numbers where they are wanted, none over an input, and prints what each shows.
void WriteAll(Drawn drawn, const std::vector<fs::path>& folders, std::vector<fs::path> inputs,
              const fs::path& output, Activity& activity) {
  Outputs outputs({}, std::move(inputs));
  std::string words;
  for (DrawnFile& file : drawn.files) {
    const fs::path folder = file.source < folders.size() ? folders[file.source] : output;
    const fs::path path = folder / file.name;
    outputs.Add(path, std::move(file.bytes));
    words += fmt::format("{}: {}\n", path.string(), file.finding);
  }
  outputs.Write();
  activity.Aside([&] { SayLines(stdout, words); });
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
  DrawRequest request{.figures = arguments.pictures.figures, .with_data = arguments.data};
  std::vector<fs::path> inputs = InputsOf(arguments.recording);
  std::vector<PictureSource> sources;
  for (const std::string& source : arguments.sources) {
    activity.Is("reading " + source);
    sources.push_back(SourceOf(source, arguments.recording, request.data));
    request.sources.push_back(sources.back().facts);
    inputs.insert(inputs.end(), sources.back().recordings.begin(), sources.back().recordings.end());
    if (fs::is_regular_file(source)) inputs.emplace_back(source);
  }

  // all of them at once; nothing is written where one that was asked for by name could not be drawn
  activity.Is("drawing");
  Drawn drawn = backend.Draw(std::move(request), setting);
  activity.Aside([&] {
    for (const std::string& line : drawn.left_out) SayNotice("{}\n", line);
  });
  for (const fs::path& folder : folders) MakeFolder(folder);
  WriteAll(std::move(drawn), folders, std::move(inputs), arguments.output, activity);
  return ExitStatus::done;
}

}  // namespace

Command AddPlotCommand(CLI::App& program) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* parser = program.add_subcommand("plot", "Pictures as PNG, SVG or PDF files");
  GiveExample(*parser, "warmjoint plot estimate.json --figure fit -o pictures");
  // what is drawn, and where to
  AddValue(*parser, "SOURCE", "SOURCE", arguments->sources,
           "directory of `run`, `simulate` or `design`, estimate file, or `kernels` (normalised "
           "and plain kernels); several fill folders of their own")
      ->required();
  AddValue(*parser, "-o,--output", "DIR", arguments->output,
           "directory for the pictures; made if absent")
      ->required();

  // whose data is shown
  AddValue(*parser, "--recording", "RECORDING", arguments->recording.files,
           "data of an estimate, instead of the files that it remembers");

  // how it looks
  AddPictureOptions(*parser, arguments->pictures);
  parser->add_flag("--data", arguments->data, "also what each picture shows, as NAME.csv");
  AddLayoutOptions(*parser, arguments->recording.read);
  return {parser, [arguments, parser] {
            TakeProject(*parser, arguments->recording);
            return PlotSources(*arguments);
          }};
}

}  // namespace warmjoint
