#include "tools/cli/plot_sources.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "identification/estimate_from_json.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/read_json.h"
#include "tools/report/estimate/estimate_figures.h"
#include "tools/report/figures/kernels.h"
#include "tools/report/run/run_figures.h"
#include "tools/report/simulation/simulation_figures.h"
#include "tools/report/simulation/warm_robot.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

constexpr int kFilmFrames = 24;

/// All members of a family that have something to show, and what the others lack.
template <typename View>
SourcePictures Make(const std::vector<report::NamedFigure<View>>& family, const View& view) {
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
RecordingArguments OwnRecording(const nlohmann::json& file, const fs::path& path) {
  // a recording that is not named, or has gone, is no reason for no pictures
  if (!file.contains("recording")) {
    SayNotice("{}: names no recording; give --recording for the pictures that need it\n",
              path.string());
    return {};
  }
  RecordingArguments remembered = RecordingFromJson(file["recording"], {path});
  for (const std::string& recording : remembered.recordings) {
    if (fs::exists(recording)) continue;
    // a warning, which --quiet leaves: it was there when the estimate was made
    Say(stderr,
        "{}: its recording {} is not there; give --recording for the pictures that need it\n",
        path.string(), recording);
    return {};
  }
  return remembered;
}

/// The estimate beside the recording that is given, else beside its own, else alone.
report::EstimateView ViewOf(Estimate estimate, const RecordingArguments& given,
                            const RecordingArguments& own) {
  if (!given.recordings.empty()) {
    return report::MakeEstimateView(std::move(estimate), ReadAndPrepare(given));
  }
  if (own.recordings.empty()) return report::MakeEstimateView(std::move(estimate));
  return report::ViewOwnRecording(std::move(estimate), ReadAndPrepare(own));
}

SourcePictures PicturesOfEstimate(const fs::path& path, const RecordingArguments& given) {
  const nlohmann::json file = ReadJsonFile(path);
  // the estimate with the data that it is shown beside
  Estimate estimate = EstimateFromJson(file, {path});
  RecordingArguments own;
  if (given.recordings.empty()) own = OwnRecording(file, path);
  report::EstimateView view = ViewOf(std::move(estimate), given, own);

  // what it gives, and itself for the figure of several
  SourcePictures pictures = Make(report::EstimateFigures(), view);
  pictures.estimate = std::move(view);
  const RecordingArguments& shown = given.recordings.empty() ? own : given;
  pictures.recordings.assign(shown.recordings.begin(), shown.recordings.end());
  return pictures;
}

SourcePictures PicturesOfSimulation(const fs::path& directory) {
  const report::SimulationView view = report::ReadSimulationView(directory);
  // a robot that warms needs OpenGL for its pictures
  SourcePictures pictures = Make(report::SimulationFigures(), view);
  pictures.recordings = {directory / "recording.csv"};
  if (!report::HasWarmRobot(view)) return pictures;
  const std::unique_ptr<report::GlContext> context = report::MakeGlContext();
  pictures.figures.push_back(*report::MakeWarmRobot(view, *context));
  pictures.film = report::MakeWarmRobotFilm(view, *context, kFilmFrames);
  return pictures;
}

}  // namespace

SourcePictures PicturesOf(const std::string& source, const RecordingArguments& recording) {
  // by what stands there, of a file by its kind, of a directory by what it holds
  if (source == kKernelsSource && !fs::exists(source))
    return {{report::MakeKernels()}, {}, {}, {}, {}};
  if (fs::is_regular_file(source)) return PicturesOfEstimate(source, recording);
  if (report::IsSimulation(source)) return PicturesOfSimulation(source);
  return Make(report::RunFigures(), report::ReadRunView(RunStore::OpenToRead(source)));
}

}  // namespace warmjoint::inline tools
