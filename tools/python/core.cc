// warmjoint._core: recordings, their check, identification and friction. No engine.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <warmjoint/errors.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/identify.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/score.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identification/estimate.h"
#include "identification/preparation/check.h"
#include "models/friction/friction_json.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_view.h"
#include "tools/figures/log_page.h"
#include "tools/identify/catalogue.h"
#include "tools/identify/identify_recording.h"
#include "tools/identify/predict_recording.h"
#include "tools/python/interrupt.h"
#include "tools/python/trees.h"

namespace warmjoint::python {
namespace {

// The signatures are what type checkers read (_core.pyi is made of them).
namespace nb = nanobind;
using Eigen::Index;
using Column = nb::ndarray<nb::numpy, const double, nb::ndim<1>>;
using Given = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// A recording that is prepared, and the files that it was read from.
struct Log {
  PreparedLog prepared;
  std::optional<RecordingSource> source;

  const Measurements& measurements() const { return prepared.raw().measurements; }
};

// Logs.

/// A column of a log as an array that shares its memory.
nb::object ViewOf(const Eigen::VectorXd& column, nb::handle log) {
  return nb::cast(Column(column.data(), {static_cast<std::size_t>(column.size())}, log));
}

/// Columns by their names in the header that a file would have. settings: of a RecordingSource.
Log LogOfColumns(const std::map<std::string, Given>& columns, nb::handle settings) {
  const auto source = FieldsFromPython<RecordingSource>(settings, "log");
  std::map<std::string, std::vector<double>> values;
  for (const auto& [name, column] : columns) {
    values[name].assign(column.data(), column.data() + column.size());
  }
  return Interruptibly([values = std::move(values), source](const auto&) {
    return Log{Prepare(MakeRecording(values, source.read, source.files.at(0)), source.prepare), {}};
  });
}

Log ReadLog(nb::handle settings) {
  const auto source = FieldsFromPython<RecordingSource>(settings, "read");
  // readers of HDF5 and MATLAB fork, which only the thread that calls may do
  nb::gil_scoped_release released;
  return {Prepare(ReadRecordings(source), source.prepare), source};
}

/// Several logs of one joint, each from a cold start, as one.
Log JoinLogs(const std::vector<Log>& logs) {
  std::vector<PreparedLog> recordings;
  for (const Log& log : logs) recordings.push_back(log.prepared);
  return Interruptibly([recordings = std::move(recordings)](const auto&) {
    return Log{Join(recordings), {}};
  });
}

// Identification.

nb::object IdentifyInPython(const Log& log, nb::handle given, double share,
                            const std::optional<Log>& other) {
  const auto settings = FieldsFromPython<IdentifySettings>(given, "identify");
  HoldOutSource holdout = HoldOutShare(share);
  if (other) holdout = {0, other->prepared};
  const Estimate estimate = Interruptibly([=](const auto& stop) {
    Estimate answer =
        Identify(log.prepared, settings, holdout, {}, [&](const std::string&) { stop(); });
    answer.recording = log.source;
    return answer;
  });
  return ToPython(EstimateToTree(estimate));
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
  dict["compared"] = column(predicted.torque.known.keep.cast<double>().matrix());
  dict["metrics"] = FieldsToPython(predicted.metrics);
  return dict;
}

/// {continuous{name: {truth, estimate, ...}}, discrete{...}, npe_continuous, ...}
nb::object ScoreInPython(nb::handle estimate, const Log& log, nb::handle truth) {
  return FieldsToPython(
      ScoreEstimate(EstimateOf(estimate), log.prepared, FieldsFromPython<Truth>(truth, "truth")));
}

// Figures and pages as data.

/// {name: figure}, as tools/figures/figure.h describes them: what an estimate gives with its log, or without.
nb::object FiguresInPython(nb::handle given, const std::optional<Log>& log) {
  const Estimate estimate = EstimateOf(given);
  const figures::EstimateView view =
      log ? figures::ViewOwnRecording(estimate, log->prepared) : figures::EstimateView{estimate};
  Tree all = Tree::object();
  for (const figures::EstimateFigure& one : figures::EstimateFigures()) {
    if (auto made = one.make(view)) all[one.name] = figures::FigureJson(*std::move(made));
  }
  return ToPython(all);
}

/// What the page of a log and its estimate shows.
nb::object LogPageInPython(nb::handle given, const Log& log) {
  const Estimate shown = figures::WithFitAgain(EstimateOf(given), log.prepared);
  return ToPython(figures::LogPageData(
      {figures::MakeFitView(log.prepared, shown), CheckRecording(log.prepared), {}}));
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

constexpr const char* kColumn = "numpy.typing.NDArray[numpy.float64]";

std::string Property(const std::string& name, const std::string& type) {
  return "def " + name + "(self) -> " + type;
}

void AddLog(nb::module_& module) {
  nb::class_<Log> log(module, "Log");
  for (const auto& [name, member] :
       {std::pair("time", &Measurements::time), std::pair("position", &Measurements::position),
        std::pair("velocity", &Measurements::velocity),
        std::pair("torque", &Measurements::torque)}) {
    log.def_prop_ro(
        name,
        [column = member](nb::handle self) {
          return ViewOf(nb::cast<const Log&>(self).measurements().*column, self);
        },
        nb::sig(Property(name, kColumn).c_str()));
  }
  for (const auto& [name, member] : {std::pair("motor_position", &Measurements::motor_position),
                                     std::pair("load", &Measurements::load),
                                     std::pair("temperature", &Measurements::temperature)}) {
    log.def_prop_ro(
        name,
        [column = member](nb::handle self) {
          const auto& given = nb::cast<const Log&>(self).measurements().*column;
          return given ? ViewOf(*given, self) : nb::object(nb::none());
        },
        nb::sig(Property(name, std::string(kColumn) + " | None").c_str()));
  }
  log.def_prop_ro("size", [](const Log& self) { return self.measurements().size(); })
      .def_prop_ro(
          "joint", [](const Log& self) { return std::string(NameOf(self.measurements().joint)); },
          nb::sig("def joint(self) -> typing.Literal['rotary', 'linear']"))
      .def_prop_ro("gear", [](const Log& self) { return self.measurements().gear; })
      .def_prop_ro("torque_unit", [](const Log& self) { return self.measurements().torque_unit; })
      .def_prop_ro("source", [](const Log& self) { return self.measurements().source; })
      .def_prop_ro("notes", [](const Log& self) { return self.measurements().notes; })
      .def_prop_ro("files",
                   [](const Log& self) {
                     return self.source ? self.source->files : std::vector<std::string>{};
                   })
      .def("save", [](const Log& self, const std::string& file) {
        WriteRecording(self.measurements(), file);
      });
  module.def("log_of_columns", &LogOfColumns,
             nb::sig("def log_of_columns(columns: dict[str, numpy.typing.NDArray[numpy.float64]], "
                     "settings: dict[str, object]) -> Log"));
  module.def("read_log", &ReadLog, nb::sig("def read_log(settings: dict[str, object]) -> Log"));
  module.def("join_logs", &JoinLogs);
  module.def(
      "check",
      [](const Log& self) {
        const RecordingCheck check = CheckRecording(self.prepared);
        return std::pair(ToPython(Tree(CheckToJson(check))), CheckToText(check));
      },
      nb::sig("def check(log: Log) -> tuple[dict[str, typing.Any], str]"));
}

void AddIdentification(nb::module_& module) {
  module.def("identify", &IdentifyInPython, nb::arg("log"), nb::arg("settings"), nb::arg("share"),
             nb::arg("other").none(),
             nb::sig("def identify(log: Log, settings: dict[str, object], share: float, other: Log "
                     "| None) -> dict[str, typing.Any]"));
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
  module.def("figures", &FiguresInPython, nb::arg("estimate"), nb::arg("log").none(),
             nb::sig("def figures(estimate: dict[str, typing.Any], log: Log | None) -> dict[str, "
                     "dict[str, typing.Any]]"));
  module.def(
      "log_page", &LogPageInPython,
      nb::sig("def log_page(estimate: dict[str, typing.Any], log: Log) -> dict[str, typing.Any]"));
  module.def("score", &ScoreInPython,
             nb::sig("def score(estimate: dict[str, typing.Any], log: Log, truth: dict[str, "
                     "typing.Any]) -> dict[str, typing.Any]"));
  module.def(
      "identifiers", [] { return ToPython(IdentifiersJson()); },
      nb::sig("def identifiers() -> list[dict[str, typing.Any]]"));
}

void AddFriction(nb::module_& module) {
  module.def(
      "complete_friction", [](nb::handle given) { return FieldsToPython(FrictionOf(given)); },
      nb::sig("def complete_friction(given: dict[str, typing.Any]) -> dict[str, typing.Any]"));
  module.def(
      "read_friction", [](const std::string& file) { return FieldsToPython(ReadFriction(file)); },
      nb::sig("def read_friction(file: str) -> dict[str, typing.Any]"));
  module.def(
      "friction_to_json", [](nb::handle given) { return FrictionToJson(FrictionOf(given)); },
      nb::sig("def friction_to_json(given: dict[str, typing.Any]) -> str"));
  module.def(
      "force", &ForceAt,
      nb::sig("def force(given: dict[str, typing.Any], places: dict[str, "
              "numpy.typing.NDArray[numpy.float64]]) -> numpy.typing.NDArray[numpy.float64]"));
  module.def(
      "settled_energy",
      [](nb::handle given, double speed) { return SettledEnergy(FrictionOf(given), speed); },
      nb::sig(
          "def settled_energy(given: dict[str, typing.Any], speed: float) -> list[float] | None"));
  module.def(
      "laws", [] { return ToPython(LawsJson()); },
      nb::sig("def laws() -> list[dict[str, typing.Any]]"));
}

}  // namespace
}  // namespace warmjoint::python

NB_MODULE(_core, module) {
  namespace nb = nanobind;
  using namespace warmjoint;
  // refusals keep the program's text
  nb::exception<BadInput>(module, "BadInput", PyExc_ValueError);
  nb::exception<OutputFailed>(module, "OutputFailed", PyExc_OSError);
  module.attr("version") = Version();
  python::AddLog(module);
  python::AddIdentification(module);
  python::AddFriction(module);
  python::WaitAtExit();
}
