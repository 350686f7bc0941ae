// warmjoint._core: recordings, their check, identification and friction. No engine.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>
#include <warmjoint/design.h>
#include <warmjoint/errors.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/identify.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/score.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identification/estimate.h"
#include "models/foundation/atomic_file.h"
#include "models/friction/friction_json.h"
#include "tools/export/engine_text.h"
#include "tools/identify/catalogue.h"
#include "tools/identify/identify_recording.h"
#include "tools/identify/predict_recording.h"
#include "tools/python/compensators.h"
#include "tools/python/interrupt.h"
#include "tools/python/logs.h"
#include "tools/python/trees.h"
#include "tools/python/words.h"
#include "tools/shown/estimate_data.h"

namespace warmjoint::python {
namespace {

// The signatures are what type checkers read (_core.pyi is made of them).
namespace nb = nanobind;
using Eigen::Index;
using Given = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Identification.

/// What a fit tries, told by one thread and read by another.
class Told {
 public:
  void Set(const std::string& words) {
    const std::lock_guard held(mutex_);
    words_ = words;
  }
  std::string Get() {
    const std::lock_guard held(mutex_);
    return words_;
  }

 private:
  std::mutex mutex_;
  std::string words_;
};

/// watch: is told what is being tried, some times a second.
nb::object IdentifyInPython(const Log& log, nb::handle given, double share,
                            const std::optional<Log>& other,
                            const std::optional<std::function<void(const std::string&)>>& watch) {
  const auto settings = FieldsFromPython<IdentifySettings>(given, "identify");
  HoldOutSource holdout = HoldOutShare(share);
  if (other) holdout = {0, other->prepared};
  const auto told = std::make_shared<Told>();
  const auto fit = [=](const auto& stop) {
    Estimate answer = Identify(log.prepared, settings, holdout, {}, [&](const std::string& words) {
      told->Set(words);
      stop();
    });
    answer.recording = log.source;
    return answer;
  };
  const Estimate estimate = Interruptibly(fit, [&] {
    if (watch) (*watch)(told->Get());
  });
  return ToPython(EstimateToTree(estimate));
}

/// aim: as `--until` takes it.
nb::object EnoughInPython(const Log& log, const std::string& aim, nb::handle given) {
  const auto settings = FieldsFromPython<IdentifySettings>(given, "enough");
  const DesignAim wanted = GoalFrom(aim, "goal");
  return FieldsToPython(
      Interruptibly([=](const auto&) { return LookWhether(log.prepared, wanted, settings); }));
}

Estimate EstimateOf(nb::handle given) {
  return EstimateFrom(Node(ToTree(given, "estimate"), "estimate"));
}

/// energies: E1 and E2 at the first sample, N.m or N; empty: cold.
nb::dict PredictInPython(nb::handle estimate, const Log& log, const std::vector<double>& energies) {
  const StoredModel stored = StoredModelOf(EstimateOf(estimate), "estimate");
  ThermalStart start;
  if (!energies.empty()) start.energy = energies[0];
  if (energies.size() > 1) start.second_energy = energies[1];
  const Predicted predicted =
      Interruptibly([=](const auto&) { return PredictLog(stored, log.prepared, start); });

  // a row for each sample of the log
  const std::vector<Eigen::Index> logged = predicted.measurements.Logged();
  const auto column = [&](const Eigen::VectorXd& all) {
    return ToPython(Eigen::VectorXd(all(logged)));
  };
  nb::dict dict;
  dict["time"] = column(predicted.measurements.time);
  dict["torque"] = column(predicted.torque.torque);
  dict["energy"] = column(predicted.torque.friction.energy);
  dict["compared"] = column(predicted.torque.covered.keep.cast<double>().matrix());
  dict["metrics"] = FieldsToPython(predicted.metrics);
  return dict;
}

/// {continuous{name: {truth, estimate, ...}}, discrete{...}, npe_continuous, ...}
nb::object ScoreInPython(nb::handle estimate, const Log& log, nb::handle truth) {
  return FieldsToPython(
      ScoreEstimate(EstimateOf(estimate), log.prepared, FieldsFromPython<Truth>(truth, "truth")));
}

// What is shown, as data.

/// (facts, arrays), as tools/shown/shown_data.h has them.
nb::object ShownToPython(const shown::ShownData& data) {
  nb::list arrays;
  for (const Eigen::VectorXd& array : data.arrays) arrays.append(ToPython(array));
  return nb::make_tuple(ToPython(data.facts), arrays);
}

/// Of an estimate with its log, or without.
nb::object ShownOfEstimate(nb::handle given, const std::optional<Log>& log) {
  const Estimate estimate = EstimateOf(given);
  return ShownToPython(Interruptibly([estimate, log](const auto&) {
    const shown::EstimateView view =
        log ? shown::ViewOwnRecording(estimate, log->prepared) : shown::EstimateView{estimate};
    shown::ShownData data;
    data.facts = shown::EstimateFacts(view, data);
    return data;
  }));
}

/// Of a log alone.
nb::object ShownOfLog(const Log& log) {
  shown::ShownData data;
  data.facts = shown::FitFacts(shown::MakeFitView(log.prepared, {}), data);
  return ShownToPython(data);
}

/// Settings of ReadLog for the recording that an estimate remembers; None where it remembers none. Whether the files are there is for
/// the caller to see.
nb::object RecordingInPython(nb::handle given) {
  const Estimate estimate = EstimateOf(given);
  return estimate.recording ? FieldsToPython(*estimate.recording) : nb::none();
}

/// Times (s), and torque less fit (N.m or N), of the samples that the fit takes, [n] each; nothing without a friction.
nb::object ResidualsInPython(nb::handle given, const Log& log) {
  const shown::FitView view = shown::MakeFitView(log.prepared, EstimateOf(given));
  if (!view.has_fit) return nb::none();
  const Eigen::VectorXd time = view.time.array() + log.measurements().time[0];
  return nb::make_tuple(ToPython(shown::KeptOf(view, time)), ToPython(shown::Residuals(view)));
}

/// What the page of a log and its estimate shows.
nb::object ShownOnPage(nb::handle given, const Log& log) {
  const Estimate estimate = shown::WithFitAgain(EstimateOf(given), log.prepared);
  shown::ShownData data;
  data.facts = shown::PageFacts(shown::MakeFitView(log.prepared, estimate),
                                CheckRecording(log.prepared), {}, data);
  return ShownToPython(data);
}

// Friction.

Friction FrictionOf(nb::handle given) {
  return Completed(FieldsFromPython<Friction>(given, "friction"), {"friction"});
}

/// F of steady sliding at n places, N.m or N. places: speed, position, energy, load, each [n].
nb::object ForceAt(nb::handle given, const std::map<std::string, Given>& places) {
  const FrictionModel model(FrictionOf(given));
  Eigen::VectorXd forces(static_cast<Index>(places.at("speed").size()));
  for (Index i = 0; i < forces.size(); ++i) {
    const JointPlace place{.position = places.at("position").data()[i],
                           .energy = places.at("energy").data()[i],
                           .load = places.at("load").data()[i]};
    forces[i] = model.Force(places.at("speed").data()[i], place);
  }
  return ToPython(std::move(forces));
}

/// E1 and, with a second stage, E2 after n steps at steady speeds, [n] N.m or N each, by Eq. (22). places: speed, position, load, step (s),
/// first (E1) and second (E2), each [n].
std::pair<nb::object, nb::object> StepHeat(nb::handle given,
                                           const std::map<std::string, Given>& places) {
  const FrictionModel model(FrictionOf(given));
  const auto at = [&](const char* name, Index i) { return places.at(name).data()[i]; };
  Eigen::VectorXd first(static_cast<Index>(places.at("speed").size())), second = first;
  for (Index i = 0; i < first.size(); ++i) {
    const auto twice = [](double value) { return Eigen::VectorXd::Constant(2, value).eval(); };
    const JointTrajectory motion{.time = Eigen::Vector2d(0, at("step", i)),
                                 .velocity = twice(at("speed", i)),
                                 .position = twice(at("position", i)),
                                 .load = twice(at("load", i))};
    const FrictionState end = model.Along(motion, {at("first", i), at("second", i)}).end;
    first[i] = end.energy;
    second[i] = end.second_energy;
  }
  return {ToPython(std::move(first)), ToPython(std::move(second))};
}

void AddIdentification(nb::module_& module) {
  module.def("enough", &EnoughInPython,
             nb::sig("def enough(log: Log, aim: str, settings: dict[str, object]) -> "
                     "dict[str, typing.Any]"));
  module.def("identify", &IdentifyInPython, nb::arg("log"), nb::arg("settings"), nb::arg("share"),
             nb::arg("other").none(), nb::arg("watch").none(),
             nb::sig("def identify(log: Log, settings: dict[str, object], share: float, other: Log "
                     "| None, watch: collections.abc.Callable[[str], None] | None) -> dict[str, "
                     "typing.Any]"));
  module.def("predict", &PredictInPython,
             nb::sig("def predict(estimate: dict[str, typing.Any], log: Log, energies: "
                     "list[float]) -> dict[str, typing.Any]"));
  module.def(
      "read_estimate",
      [](const std::string& file) { return ToPython(EstimateToTree(ReadEstimate(file))); },
      nb::sig("def read_estimate(file: str) -> dict[str, typing.Any]"));
  module.def(
      "estimate_to_json", [](nb::handle estimate) { return EstimateToJson(EstimateOf(estimate)); },
      nb::sig("def estimate_to_json(estimate: dict[str, typing.Any]) -> str"));
  module.def(
      "write_estimate",
      [](nb::handle estimate, const std::string& file) {
        WriteEstimate(EstimateOf(estimate), file);
      },
      nb::sig("def write_estimate(estimate: dict[str, typing.Any], file: str) -> None"));
  module.def("shown_of_estimate", &ShownOfEstimate, nb::arg("estimate"), nb::arg("log").none(),
             nb::sig("def shown_of_estimate(estimate: dict[str, typing.Any], log: Log | None) -> "
                     "tuple[dict[str, typing.Any], list[numpy.typing.NDArray[numpy.float64]]]"));
  module.def("shown_of_log", &ShownOfLog,
             nb::sig("def shown_of_log(log: Log) -> tuple[dict[str, typing.Any], "
                     "list[numpy.typing.NDArray[numpy.float64]]]"));
  module.def("shown_on_page", &ShownOnPage,
             nb::sig("def shown_on_page(estimate: dict[str, typing.Any], log: Log) -> "
                     "tuple[dict[str, typing.Any], list[numpy.typing.NDArray[numpy.float64]]]"));
  module.def("residuals", &ResidualsInPython,
             nb::sig("def residuals(estimate: dict[str, typing.Any], log: Log) -> "
                     "tuple[numpy.typing.NDArray[numpy.float64], "
                     "numpy.typing.NDArray[numpy.float64]] | None"));
  module.def("recording", &RecordingInPython,
             nb::sig("def recording(estimate: dict[str, typing.Any]) -> dict[str, typing.Any] | "
                     "None"));
  module.def("score", &ScoreInPython,
             nb::sig("def score(estimate: dict[str, typing.Any], log: Log, truth: dict[str, "
                     "typing.Any]) -> dict[str, typing.Any]"));
  module.def(
      "identifiers", [] { return ToPython(IdentifiersJson()); },
      nb::sig("def identifiers() -> list[dict[str, typing.Any]]"));
}

void AddFriction(nb::module_& module) {
  module.def(
      "export_frictions",
      [](nb::handle given, nb::handle request) {
        const Node file(ToTree(given, "estimate"), "estimate");
        const auto asked = FieldsFromPython<ExportRequest>(request, "export");
        return ToPython(EngineJson(ExportFrictions(file, asked)));
      },
      nb::sig("def export_frictions(given: dict[str, typing.Any], request: dict[str, typing.Any]) "
              "-> dict[str, typing.Any]"));
  module.def(
      "complete_friction", [](nb::handle given) { return FieldsToPython(FrictionOf(given)); },
      nb::sig("def complete_friction(given: dict[str, typing.Any]) -> dict[str, typing.Any]"));
  module.def(
      "read_friction", [](const std::string& file) { return FieldsToPython(ReadFriction(file)); },
      nb::sig("def read_friction(file: str) -> dict[str, typing.Any]"));
  module.def(
      "read_json", [](const std::string& file) { return ToPython(ReadJsonFile(file)); },
      nb::sig("def read_json(file: str) -> typing.Any"));
  module.def(
      "library", [] { return ToPython(LibraryJson()); },
      nb::sig("def library() -> list[dict[str, typing.Any]]"));
  module.def(
      "friction_to_json", [](nb::handle given) { return FrictionToJson(FrictionOf(given)); },
      nb::sig("def friction_to_json(given: dict[str, typing.Any]) -> str"));
  module.def(
      "force", &ForceAt,
      nb::sig("def force(given: dict[str, typing.Any], places: dict[str, "
              "numpy.typing.NDArray[numpy.float64]]) -> numpy.typing.NDArray[numpy.float64]"));
  module.def("step_heat", &StepHeat,
             nb::sig("def step_heat(given: dict[str, typing.Any], places: dict[str, "
                     "numpy.typing.NDArray[numpy.float64]]) -> "
                     "tuple[numpy.typing.NDArray[numpy.float64], "
                     "numpy.typing.NDArray[numpy.float64]]"));
  module.def(
      "settled_energy",
      [](nb::handle given, double speed) { return SettledEnergy(FrictionOf(given), speed); },
      nb::sig(
          "def settled_energy(given: dict[str, typing.Any], speed: float) -> list[float] | None"));
  module.def(
      "laws", [] { return ToPython(LawsJson()); },
      nb::sig("def laws() -> list[dict[str, typing.Any]]"));
}

/// JSON has no numbers that are not finite.
void RefuseNotFinite(const Tree& tree, const std::string& name) {
  if (tree.is_number_float() && !std::isfinite(tree.get<double>())) {
    Refuse({name}, "is {}; it must be a finite number", tree.get<double>());
  }
  if (!tree.is_structured()) return;
  for (const auto& [key, entry] : tree.items()) {
    RefuseNotFinite(entry, tree.is_object() ? name + "." + key : name);
  }
}

void AddWords(nb::module_& module) {
  module.def("in_python", &InPython);
  module.def(
      "calls_in",
      [](const std::string& text) {
        nb::list calls;
        for (const Tree& call : CallsIn(text)) calls.append(ToPython(call));
        return calls;
      },
      nb::sig("def calls_in(text: str) -> list[dict[str, typing.Any]]"));
  module.def(
      "to_json",
      [](nb::handle value, const std::string& name) {
        const Tree tree = ToTree(value, name);
        RefuseNotFinite(tree, name);
        return tree.dump();
      },
      nb::arg("value").none(), nb::arg("name"),
      nb::sig("def to_json(value: object, name: str) -> str"));
  module.def("write_text",
             [](const std::string& file, const std::string& text) { WriteWholeFile(file, text); });
}

}  // namespace
}  // namespace warmjoint::python

NB_MODULE(_core, module) {
  namespace nb = nanobind;
  using namespace warmjoint;
  // refusals keep the program's text, with arguments in place of options
  const nb::exception<BadInput> refusal(module, "BadInput", PyExc_ValueError);
  // also of what Python raises, whose text holds names and sentences of other libraries
  nb::setattr(refusal, "__str__", nb::cpp_function(python::PrintableText, nb::is_method()));
  nb::exception<OutputFailed>(module, "OutputFailed", PyExc_OSError);
  python::SpeakPython(module);
  module.attr("version") = Version();
  python::AddLogs(module);
  python::AddIdentification(module);
  python::AddFriction(module);
  python::AddCompensators(module);
  python::AddWords(module);
  python::WaitAtExit();
}
