#include "tools/python/logs.h"

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <warmjoint/estimate.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "identification/preparation/check.h"
#include "models/foundation/excerpt.h"
#include "models/recording/log_formats.h"
#include "models/recording/read_recording.h"
#include "models/recording/recording_columns.h"
#include "models/recording/table_format.h"
#include "models/recording/units.h"
#include "tools/python/interrupt.h"
#include "tools/python/trees.h"
#include "tools/python/words.h"

namespace warmjoint::python {
namespace {

namespace nb = nanobind;
using Column = nb::ndarray<nb::numpy, const double, nb::ndim<1>>;
using Given = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// A column of a log as an array that shares its memory.
nb::object ViewOf(const Eigen::VectorXd& column, nb::handle log) {
  return nb::cast(Column(column.data(), {static_cast<std::size_t>(column.size())}, log));
}

Eigen::VectorXd ValuesOf(const Given& column) {
  return Eigen::VectorXd::Map(column.data(), static_cast<Eigen::Index>(column.size()));
}

/// A log of recordings that were read already.
Log Prepared(std::vector<std::shared_ptr<const LogPart>> parts,
             std::optional<RecordingSource> source = {}) {
  std::vector<PreparedLog> each;
  for (const auto& part : parts) each.push_back(Prepare(part->read, part->prepare));
  return {Join(std::move(each)), std::move(parts), std::move(source)};
}

std::vector<std::shared_ptr<const LogPart>> PartsOf(std::vector<Measurements> recordings,
                                                    const PrepareSettings& prepare) {
  std::vector<std::shared_ptr<const LogPart>> parts;
  for (Measurements& one : recordings) {
    parts.push_back(std::make_shared<const LogPart>(std::move(one), prepare));
  }
  return parts;
}

// Tables.

/// A table without its values.
FileContent ContentOf(nb::handle names, nb::handle units) {
  FileContent content;
  const Tree unit_of = ToTree(units, "unit");
  for (const Tree& name : ToTree(names, "names")) {
    const std::size_t i = content.columns.size();
    content.columns.push_back({name.get<std::string>(), unit_of.at(i).get<std::string>()});
  }
  return content;
}

/// Of our columns that a table has, the names and where they stand: those whose values LogOfTable needs.
std::vector<std::pair<std::string, std::size_t>> FindInTable(nb::handle names, nb::handle units,
                                                             nb::handle settings) {
  const auto source = FieldsFromPython<RecordingSource>(settings, "log");
  const FileContent content = ContentOf(names, units);
  std::vector<std::pair<std::string, std::size_t>> found;
  for (const ColumnSource& one : FindColumns(content.columns, source.read, {source.files.at(0)})) {
    found.emplace_back(one.column->name, one.index);
  }
  return found;
}

/// values: of columns by their places among the names. settings: of a RecordingSource.
Log LogOfTable(nb::handle names, nb::handle units, const std::map<std::size_t, Given>& values,
               nb::handle settings) {
  const auto source = FieldsFromPython<RecordingSource>(settings, "log");
  FileContent content = ContentOf(names, units);
  for (const auto& [i, column] : values) content.columns.at(i).values = ValuesOf(column);
  return Interruptibly([content = std::move(content), source](const auto&) {
    return Prepared(
        PartsOf(MakeRecordings(content, source.read, source.files.at(0)), source.prepare));
  });
}

/// Numbers of texts, and whether they are stamps in s: all of them or none. name: of the column in messages.
std::pair<nb::object, bool> ReadCells(const std::vector<std::string>& texts,
                                      const std::string& name, bool is_time) {
  Eigen::VectorXd numbers(std::ssize(texts));
  std::optional<bool> in_words;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    std::optional<double> value = ReadCell(texts[i], '.');
    if (is_time && !(value && std::isnan(*value))) {
      const bool is_stamp = !value;
      if (is_stamp) value = ReadStamp(texts[i]);
      if (in_words.value_or(is_stamp) != is_stamp) value.reset();
      if (value) in_words = is_stamp;
    }
    if (!value) {
      Refuse({name}, "sample {} is '{}', which is not a number{}", i + 1, Excerpt(texts[i]),
             is_time ? " nor a stamp as 2024-03-01T12:00:00.5" : "");
    }
    numbers[static_cast<Eigen::Index>(i)] = *value;
  }
  return {ToPython(std::move(numbers)), in_words.value_or(false)};
}

// Files.

/// [{ending, name, by, reader}] of all formats: by is program, converter or nobody.
nb::list FormatsInPython() {
  nb::list formats;
  for (const LogFormat& one : LogFormats()) {
    nb::dict format;
    format["ending"] = std::string(one.ending);
    format["name"] = std::string(one.name);
    format["by"] = one.by == ReadBy::program     ? "program"
                   : one.by == ReadBy::converter ? "converter"
                                                 : "nobody";
    format["reader"] = std::string(one.reader);
    formats.append(format);
  }
  return formats;
}

Log ReadLog(nb::handle settings) {
  const auto source = FieldsFromPython<RecordingSource>(settings, "read");
  // readers of HDF5 and MATLAB fork, which only the thread that calls may do
  nb::gil_scoped_release released;
  return Prepared(PartsOf(ReadRecordings(source), source.prepare), source);
}

/// A table of text, which a reader of another format made of a file. settings: of a RecordingSource.
Log ReadText(const std::string& text, nb::handle settings) {
  const auto source = FieldsFromPython<RecordingSource>(settings, "read");
  return Interruptibly([text, source](const auto&) {
    return Prepared(PartsOf(MakeRecordings(text, source.read, source.files.at(0)), source.prepare));
  });
}

/// Several logs of one joint, each from a cold start, as one.
Log JoinLogs(const std::vector<Log>& logs) {
  return Interruptibly([logs](const auto&) {
    std::vector<PreparedLog> recordings;
    std::vector<std::shared_ptr<const LogPart>> parts;
    for (const Log& log : logs) {
      recordings.push_back(log.prepared);
      parts.insert(parts.end(), log.parts.begin(), log.parts.end());
    }
    return Log{Join(std::move(recordings)), std::move(parts), {}};
  });
}

// Copies in other processes.

/// What LogOfState makes the same log of: {parts: [{columns, joint, gear, torque_unit, ...}], source}.
nb::dict StateOf(const Log& log) {
  nb::list parts;
  for (const auto& part : log.parts) {
    const Measurements& m = part->read;
    nb::dict columns, state;
    for (const RecordingColumn& column : RecordingColumns()) {
      if (const Eigen::VectorXd* values = column.get(m))
        columns[column.name.c_str()] = ToPython(*values);
    }
    if (m.position_integrated) columns["position"] = ToPython(m.position);
    state["columns"] = columns;
    state["joint"] = std::string(NameOf(m.joint));
    state["gear"] = m.gear;
    state["torque_unit"] = m.torque_unit;
    state["source"] = m.source;
    state["notes"] = m.notes;
    state["doubts"] = m.doubts;
    state["position_integrated"] = m.position_integrated;
    state["prepare"] = FieldsToPython(part->prepare);
    parts.append(state);
  }
  nb::dict state;
  state["parts"] = parts;
  state["source"] = log.source ? FieldsToPython(*log.source) : nb::none();
  return state;
}

template <typename T>
T Entry(const nb::dict& state, const char* name) {
  return nb::cast<T>(state[name]);
}

LogPart PartOf(const nb::dict& state) {
  Measurements m;
  m.joint = Entry<std::string>(state, "joint") == NameOf(JointKind::linear) ? JointKind::linear
                                                                            : JointKind::rotary;
  m.gear = Entry<double>(state, "gear");
  m.torque_unit = Entry<std::string>(state, "torque_unit");
  m.source = Entry<std::string>(state, "source");
  m.notes = Entry<std::vector<std::string>>(state, "notes");
  m.doubts = Entry<std::vector<std::string>>(state, "doubts");
  m.position_integrated = Entry<bool>(state, "position_integrated");
  const auto columns = Entry<std::map<std::string, Given>>(state, "columns");
  for (const RecordingColumn& column : RecordingColumns()) {
    const auto given = columns.find(column.name);
    if (given == columns.end()) continue;
    if (given->second.size() != columns.at("time").size()) {
      Refuse({"log"}, "the copy is damaged: {} has {} samples of {}", column.name,
             given->second.size(), columns.at("time").size());
    }
    column.set(m, ValuesOf(given->second));
  }
  return {std::move(m), FieldsFromPython<PrepareSettings>(state["prepare"], "log")};
}

Log LogOfState(const nb::dict& state) {
  std::vector<std::shared_ptr<const LogPart>> parts;
  for (const nb::handle part : state["parts"]) {
    parts.push_back(std::make_shared<const LogPart>(PartOf(nb::cast<nb::dict>(part))));
  }
  std::optional<RecordingSource> source;
  if (!nb::handle(state["source"]).is_none()) {
    source = FieldsFromPython<RecordingSource>(state["source"], "log");
  }
  return Interruptibly([parts, source](const auto&) { return Prepared(parts, source); });
}

/// The first recording's samples `first` to `last`, and the settings that it had.
Log Slice(const Log& log, std::size_t first, std::size_t last) {
  if (log.parts.size() != 1)
    Refuse({"log"}, "is of {} recordings; cut each before", log.parts.size());
  LogPart part = *log.parts.front();
  const auto begin = static_cast<Eigen::Index>(first);
  const Eigen::Index size = static_cast<Eigen::Index>(last) - begin;
  if (size < 3) Refuse({"log"}, "{} samples would be left; at least 3 are needed", size);
  for (const RecordingColumn& column : RecordingColumns()) {
    const Eigen::VectorXd* values = column.get(part.read);
    if (values) column.set(part.read, Eigen::VectorXd(values->segment(begin, size)));
  }
  if (part.read.position_integrated) {
    part.read.position = Eigen::VectorXd(part.read.position.segment(begin, size));
  }
  part.read.source += fmt::format("[{}:{}]", first, last);
  return Interruptibly([part = std::make_shared<const LogPart>(std::move(part))](const auto&) {
    return Prepared({part});
  });
}

constexpr const char* kColumn = "numpy.typing.NDArray[numpy.float64]";

std::string Property(const std::string& name, const std::string& type) {
  return "def " + name + "(self) -> " + type;
}

void AddLogClass(nb::module_& module) {
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
      .def_prop_ro("notes",
                   [](const Log& self) {
                     std::vector<std::string> notes = self.measurements().notes;
                     for (std::string& note : notes) note = InPython(note);
                     return notes;
                   })
      .def_prop_ro("files",
                   [](const Log& self) {
                     return self.source ? self.source->files : std::vector<std::string>{};
                   })
      .def_prop_ro("recordings", [](const Log& self) { return self.parts.size(); })
      .def("slice", &Slice)
      .def("state", &StateOf, nb::sig("def state(self) -> dict[str, typing.Any]"))
      .def("save", [](const Log& self, const std::string& file) {
        WriteRecording(self.measurements(), file);
      });
}

}  // namespace

void AddLogs(nb::module_& module) {
  AddLogClass(module);
  module.def("find_in_table", &FindInTable,
             nb::sig("def find_in_table(names: list[str], units: list[str], settings: dict[str, "
                     "object]) -> list[tuple[str, int]]"));
  module.def("log_of_table", &LogOfTable,
             nb::sig("def log_of_table(names: list[str], units: list[str], values: dict[int, "
                     "numpy.typing.NDArray[numpy.float64]], settings: dict[str, object]) -> Log"));
  module.def("read_cells", &ReadCells,
             nb::sig("def read_cells(texts: list[str], name: str, is_time: bool) -> "
                     "tuple[numpy.typing.NDArray[numpy.float64], bool]"));
  module.def("read_log", &ReadLog, nb::sig("def read_log(settings: dict[str, object]) -> Log"));
  module.def("read_text", &ReadText,
             nb::sig("def read_text(text: str, settings: dict[str, object]) -> Log"));
  module.def("log_formats", &FormatsInPython, nb::sig("def log_formats() -> list[dict[str, str]]"));
  module.def("is_other_format", [](const std::string& path) { return IsOtherFormat(path); });
  module.def("may_hold_objects", [](const std::string& path) { return MayHoldObjects(path); });
  module.def("join_logs", &JoinLogs);
  module.def("log_of_state", &LogOfState,
             nb::sig("def log_of_state(state: dict[str, typing.Any]) -> Log"));
  module.def(
      "check",
      [](const Log& self) {
        const RecordingCheck check = CheckRecording(self.prepared);
        return std::pair(ToPython(Tree(CheckToJson(check))), InPython(CheckToText(check)));
      },
      nb::sig("def check(log: Log) -> tuple[dict[str, typing.Any], str]"));
}

}  // namespace warmjoint::python
