// warmjoint._engine: what needs MuJoCo 4.0: simulation, suites and their leaderboards.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <warmjoint/design.h>
#include <warmjoint/identify_robot.h>
#include <warmjoint/simulation.h>
#include <warmjoint/suite.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identification/fields/field_set.h"
#include "identification/robot/robot_estimate.h"
#include "sim/model/engine_warnings.h"
#include "tools/compensate/robot/external_torque.h"
#include "tools/design/aim.h"
#include "tools/python/interrupt.h"
#include "tools/python/trees.h"
#include "tools/python/words.h"
#include "tools/robot/identify_logs.h"
#include "tools/shown/estimate_data.h"

namespace warmjoint::python {
namespace {

namespace nb = nanobind;

/// Does the work, during which MuJoCo neither prints nor writes a file: what it warns of becomes warnings of Python afterwards.
template <class Work>
auto WithWarnings(const Work& work) {
  std::vector<std::string> found;
  auto answer = [&] {
    const EngineWarnings taken([&](const std::string& warning) { found.push_back(warning); });
    return work();
  }();
  for (const std::string& warning : found) {
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw nb::python_error();
  }
  return answer;
}

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
  const Simulation simulation = WithWarnings([&] {
    return Interruptibly([=](const auto& stop) {
      return Simulate(scenario, {set, seed, realization, [&](double) { stop(); }});
    });
  });
  return nb::make_tuple(LogArguments(simulation.measurements), FieldsToPython(simulation.truth));
}

/// [time, position, velocity] of a motion's knots.
nb::list KnotsInPython(const Design& design) {
  nb::list columns;
  for (const auto member : {&MotionKnot::time, &MotionKnot::position, &MotionKnot::velocity}) {
    Eigen::VectorXd column(std::ssize(design.knots));
    std::ranges::transform(design.knots, column.begin(), std::mem_fn(member));
    columns.append(ToPython(column));
  }
  return columns;
}

nb::dict FilesInPython(const std::vector<std::pair<std::string, std::string>>& texts) {
  nb::dict files;
  for (const auto& [name, text] : texts) files[name.c_str()] = text;
  return files;
}

/// (design.json, its knots, {file: text}). settings: as DesignSettings has them
nb::object DesignInPython(nb::handle given, const std::string& joint) {
  const auto settings = FieldsFromPython<DesignSettings>(given, "design");
  const Design design = Interruptibly([=](const auto& stop) {
    return DesignMotion(settings, {}, [&](const std::string&) { stop(); });
  });
  return nb::make_tuple(FieldsToPython(design), KnotsInPython(design),
                        FilesInPython(FilesOf(design, joint)));
}

/// The same of a robot: (design.json, {joint: its design and knots}, {file: text}).
nb::object DesignRobotInPython(nb::handle given, const std::string& robot,
                               const std::vector<std::string>& joints,
                               const std::map<std::string, double>& at, double clearance,
                               const std::map<std::string, std::string>& priors) {
  const RobotDesignSettings settings{
      robot, joints, at, clearance, FieldsFromPython<DesignSettings>(given, "design"), priors};
  const RobotDesign design = Interruptibly([=](const auto& stop) {
    return DesignRobotMotion(settings, {}, [&](const std::string&) { stop(); });
  });
  nb::dict by_joint;
  for (const JointDesign& one : design.joints) {
    by_joint[one.name.c_str()] =
        nb::make_tuple(FieldsToPython(static_cast<const Design&>(one)), KnotsInPython(one),
                       FilesInPython(FilesOf(one, one.name)));
  }
  return nb::make_tuple(FieldsToPython(design), by_joint, FilesInPython(FilesOf(design)));
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
  const RunEnding ending = WithWarnings([&] {
    nb::gil_scoped_release released;
    return Run(arguments, [&](int finished, int total) {
      nb::gil_scoped_acquire held;
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      watch(finished, total);
    });
  });
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

/// (name, unit, [N] or None, why it holds no numbers) each.
FileContent ColumnsFromPython(const nb::list& columns) {
  FileContent content;
  for (const nb::handle one : columns) {
    const auto entry = nb::cast<nb::tuple>(one);
    FileColumn& column = content.columns.emplace_back();
    column.name = nb::cast<std::string>(entry[0]);
    column.unit = nb::cast<std::string>(entry[1]);
    column.refusal = nb::cast<std::string>(entry[3]);
    if (nb::handle(entry[2]).is_none()) continue;
    const auto values = nb::cast<GivenColumn>(entry[2]);
    column.values = Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  return content;
}

/// (name, columns or None, text or None) each: a file where there is neither.
std::vector<RobotLogSource> LogsFromPython(const nb::list& given) {
  std::vector<RobotLogSource> logs;
  for (const nb::handle one : given) {
    const auto entry = nb::cast<nb::tuple>(one);
    RobotLogSource& log = logs.emplace_back();
    log.name = nb::cast<std::string>(entry[0]);
    if (!nb::handle(entry[1]).is_none()) {
      log.columns = ColumnsFromPython(nb::cast<nb::list>(entry[1]));
    }
    if (!nb::handle(entry[2]).is_none()) log.text = nb::cast<std::string>(entry[2]);
  }
  return logs;
}

/// read: settings of a RecordingSource. Returns (robot.json, facts and arrays of its pictures).
nb::object IdentifyRobotInPython(const std::string& robot, const nb::list& logs, nb::handle read,
                                 nb::handle given) {
  const auto settings = FieldsFromPython<RobotSettings>(given, "identify_robot");
  const RobotSource source{LogsFromPython(logs),
                           FieldsFromPython<RecordingSource>(read, "log").read};
  const bool is_in_memory = std::ranges::all_of(
      source.logs, [](const RobotLogSource& log) { return log.columns || log.text; });
  const RobotEstimate answer = WithWarnings([&] {
    if (!is_in_memory) {
      // readers of HDF5 and MATLAB fork, which only the thread that calls may do
      nb::gil_scoped_release released;
      return IdentifyRobot(robot, source, settings, {});
    }
    return Interruptibly([=](const auto& stop) {
      return IdentifyRobot(robot, source, settings, [&](const std::string&) { stop(); });
    });
  });
  shown::ShownData data;
  data.facts = shown::RobotFacts(answer, data);
  nb::list arrays;
  for (const Eigen::VectorXd& array : data.arrays) arrays.append(ToPython(array));
  return nb::make_tuple(ToPython(RobotEstimateToTree(answer)), ToPython(data.facts), arrays);
}

/// [N x 3] as an array of NumPy.
nb::object MatrixToPython(const Eigen::MatrixXd& matrix) {
  nb::list columns;
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    columns.append(ToPython(Eigen::VectorXd(matrix.col(k))));
  }
  return nb::module_::import_("numpy").attr("column_stack")(columns);
}

/// answer: path of a robot.json. Returns what RobotExternal has, as dicts of arrays.
nb::object ExternalTorqueInPython(const std::string& robot, const std::string& answer,
                                  const nb::list& logs, nb::handle read, nb::handle given,
                                  nb::handle compensation) {
  const auto settings = FieldsFromPython<RobotSettings>(given, "external_torque");
  const auto how = FieldsFromPython<CompensatorSettings>(compensation, "external_torque");
  const RobotSource source{LogsFromPython(logs),
                           FieldsFromPython<RecordingSource>(read, "log").read};
  const RobotExternal found = WithWarnings([&] {
    nb::gil_scoped_release released;
    return FindExternal(robot, ReadRobotEstimate(answer), source, settings, how);
  });
  nb::dict joints;
  for (const JointExternal& one : found.joints) {
    nb::dict columns;
    const std::pair<const char*, const Eigen::VectorXd*> all[]{
        {"velocity", &one.velocity},     {"torque", &one.torque},  {"rigid", &one.rigid},
        {"friction", &one.friction},     {"energy", &one.energy},  {"external", &one.external},
        {"half_width", &one.half_width}, {"contact", &one.contact}};
    for (const auto& [name, values] : all) columns[name] = ToPython(Eigen::VectorXd(*values));
    joints[one.joint.c_str()] = columns;
  }
  nb::dict dict;
  dict["time"] = ToPython(Eigen::VectorXd(found.time));
  dict["joints"] = joints;
  dict["force"] = MatrixToPython(found.force);
  dict["force_half_width"] = MatrixToPython(found.force_half_width);
  nb::list notices;
  for (const std::string& notice : found.notices) notices.append(notice);
  dict["notices"] = notices;
  return dict;
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
  module.def("design", &python::DesignInPython,
             nb::sig("def design(settings: dict[str, object], joint: str) -> "
                     "tuple[dict[str, typing.Any], list[numpy.typing.NDArray[numpy.float64]], "
                     "dict[str, str]]"));
  module.def("design_robot", &python::DesignRobotInPython,
             nb::sig("def design_robot(settings: dict[str, object], robot: str, joints: list[str], "
                     "at: dict[str, float], clearance: float, priors: dict[str, str]) -> "
                     "tuple[dict[str, typing.Any], dict[str, tuple[dict[str, typing.Any], "
                     "list[numpy.typing.NDArray[numpy.float64]], dict[str, str]]], "
                     "dict[str, str]]"));
  module.def(
      "run", &python::RunInPython,
      nb::sig("def run(suite: str, output: str, options: dict[str, object], functions: dict[str, "
              "collections.abc.Callable[[dict[str, typing.Any]], str]], watch: "
              "collections.abc.Callable[[int, int], None]) -> dict[str, typing.Any]"));
  module.def("identify_robot", &python::IdentifyRobotInPython,
             nb::sig("def identify_robot(robot: str, logs: list[tuple[str, list[tuple[str, str, "
                     "numpy.typing.NDArray[numpy.float64] | None, str]] | None, str | None]], "
                     "read: dict[str, object], settings: dict[str, object]) -> "
                     "tuple[dict[str, typing.Any], list[dict[str, typing.Any]], "
                     "list[numpy.typing.NDArray[numpy.float64]]]"));
  module.def("external_torque", &python::ExternalTorqueInPython,
             nb::sig("def external_torque(robot: str, answer: str, logs: list[tuple[str, "
                     "list[tuple[str, str, numpy.typing.NDArray[numpy.float64] | None, str]] | "
                     "None, str | None]], read: dict[str, object], settings: dict[str, object], "
                     "compensation: dict[str, object]) -> dict[str, typing.Any]"));
  module.def("leaderboard", [](const std::string& directory, const std::string& format) {
    return FormatLeaderboard(directory, format);
  });
  python::WaitAtExit();
}
