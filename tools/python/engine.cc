// warmjoint._engine: what needs MuJoCo 4.0: simulation, suites and their leaderboards.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <warmjoint/identify_robot.h>
#include <warmjoint/simulation.h>
#include <warmjoint/suite.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identification/robot/robot_estimate.h"
#include "tools/python/interrupt.h"
#include "tools/python/trees.h"
#include "tools/python/words.h"
#include "tools/shown/estimate_data.h"

namespace warmjoint::python {
namespace {

namespace nb = nanobind;

/// The columns of a log and what a reader of its file is told, as arguments of Python's Log.
nb::dict LogArguments(const Measurements& m) {
  nb::dict log;
  for (const auto& [name, column] :
       {std::pair("time", &m.time), std::pair("position", &m.position),
        std::pair("velocity", &m.velocity), std::pair("torque", &m.torque)}) {
    log[name] = ToPython(*column);
  }
  for (const auto& [name, column] :
       {std::pair("motor_position", &m.motor_position), std::pair("load", &m.load),
        std::pair("temperature", &m.temperature)}) {
    if (*column) log[name] = ToPython(**column);
  }
  log["joint"] = std::string(NameOf(m.joint));
  log["gear"] = m.gear;
  return log;
}

/// (arguments of Log, truth)
nb::object SimulateInPython(const std::string& scenario,
                            const std::vector<std::pair<std::string, std::string>>& set,
                            std::optional<std::uint64_t> seed, std::uint64_t realization) {
  const Simulation simulation = Interruptibly([=](const auto& stop) {
    return Simulate(scenario, {set, seed, realization, [&](double) { stop(); }});
  });
  return nb::make_tuple(LogArguments(simulation.measurements), FieldsToPython(simulation.truth));
}

/// functions: label -> (arguments of Log -> text of estimate.json). watch: (finished, total). Returns {results, refused, ...}.
nb::dict RunInPython(const std::string& suite, const std::string& output, nb::handle options,
                     const std::map<std::string, nb::callable>& functions,
                     const std::function<void(int, int)>& watch) {
  auto arguments = FieldsFromPython<RunArguments>(options, "run");
  arguments.suite = suite;
  arguments.output = output;
  for (const auto& [label, function] : functions) {
    arguments.functions[label] = [call = function.ptr()](const Measurements& measurements) {
      nb::gil_scoped_acquire held;
      return nb::cast<std::string>(nb::handle(call)(LogArguments(measurements)));
    };
  }
  // the functions live as long as this call, which waits for the run
  const RunEnding ending = [&] {
    nb::gil_scoped_release released;
    return Run(arguments, [&](int finished, int total) {
      nb::gil_scoped_acquire held;
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      watch(finished, total);
    });
  }();
  nb::dict dict;
  dict["results"] = ending.results;
  dict["rejected"] = ending.refused;
  dict["unanswered"] = ending.unanswered;
  dict["not_simulated"] = ending.not_simulated;
  dict["silent"] = ending.silent;
  dict["notice"] = ending.not_following;
  return dict;
}

using GivenColumn = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// columns: of one log in memory; none: the files of `source`. Returns (robot.json, facts and arrays of its pictures).
nb::object IdentifyRobotInPython(const std::string& robot, nb::handle source,
                                 const std::map<std::string, GivenColumn>& columns,
                                 nb::handle given) {
  const auto read = FieldsFromPython<RecordingSource>(source, "log");
  const auto settings = FieldsFromPython<RobotSettings>(given, "identify_robot");
  std::map<std::string, std::vector<double>> values;
  for (const auto& [name, column] : columns) {
    values[name].assign(column.data(), column.data() + column.size());
  }
  RobotEstimate answer;
  if (columns.empty()) {
    // readers of HDF5 and MATLAB fork, which only the thread that calls may do
    nb::gil_scoped_release released;
    answer = IdentifyRobot(robot, read, settings);
  } else {
    answer = Interruptibly([=](const auto& stop) {
      return IdentifyRobot(robot, values, read.read, settings, [&](const std::string&) { stop(); });
    });
  }
  shown::ShownData data;
  data.facts = shown::RobotFacts(answer, data);
  nb::list arrays;
  for (const Eigen::VectorXd& array : data.arrays) arrays.append(ToPython(array));
  return nb::make_tuple(ToPython(RobotEstimateToTree(answer)), ToPython(data.facts), arrays);
}

}  // namespace
}  // namespace warmjoint::python

NB_MODULE(_engine, module) {
  namespace nb = nanobind;
  using namespace warmjoint;
  // refusals are those of the module beside this one, in the package or where its stub is made
  auto beside = nb::cast<std::string>(module.attr("__name__"));
  beside.replace(beside.rfind('_'), std::string::npos, "_core");
  python::SpeakPython(nb::module_::import_(beside.c_str()));
  module.def("simulate", &python::SimulateInPython, nb::arg("scenario"), nb::arg("set"),
             nb::arg("seed").none(), nb::arg("realization"),
             nb::sig("def simulate(scenario: str, set: list[tuple[str, str]], seed: int | None, "
                     "realization: int) -> tuple[dict[str, typing.Any], dict[str, typing.Any]]"));
  module.def(
      "run", &python::RunInPython,
      nb::sig("def run(suite: str, output: str, options: dict[str, object], functions: dict[str, "
              "collections.abc.Callable[[dict[str, typing.Any]], str]], watch: "
              "collections.abc.Callable[[int, int], None]) -> dict[str, typing.Any]"));
  module.def("identify_robot", &python::IdentifyRobotInPython,
             nb::sig("def identify_robot(robot: str, source: dict[str, object], columns: dict[str, "
                     "numpy.typing.NDArray[numpy.float64]], settings: dict[str, object]) -> "
                     "tuple[dict[str, typing.Any], list[dict[str, typing.Any]], "
                     "list[numpy.typing.NDArray[numpy.float64]]]"));
  module.def("leaderboard", [](const std::string& directory, const std::string& format) {
    return FormatLeaderboard(directory, format);
  });
  python::WaitAtExit();
}
