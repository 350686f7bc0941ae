#include "models/recording/read_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <type_traits>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/assemble.h"
#include "models/recording/log_formats.h"
#include "models/recording/table_format.h"

namespace warmjoint {
namespace {

/// How the files of an ending are read and written.
struct Format {
  std::string_view ending;
  FileFormat library;  // that reads it; text needs none
  // its bytes; none: it is not written
  std::string (*write)(const Measurements& measurements) = nullptr;
  std::string (*write_columns)(const FileContent& content) = nullptr;
};

constexpr Format kFormats[] = {
    {".csv", {}, RecordingToCsv, ColumnsToCsv},
    {".h5", {"HDF5", ReadHdf5Content}, RecordingToHdf5, ColumnsToHdf5},
    {".hdf5", {"HDF5", ReadHdf5Content}, RecordingToHdf5, ColumnsToHdf5},
    {".mat", {"a MATLAB file", ReadMatlabContent}},
};

/// By the ending; any other is read as a table of text, and not written.
Format HandlersOf(const std::string& path) {
  const auto found = std::ranges::find(kFormats, FormatOf(path).ending, &Format::ending);
  return found == std::end(kFormats) ? Format{} : *found;
}

/// Refuses bytes that are no text, whatever the name says.
void RequireText(std::string_view bytes, const std::string& path) {
  // names may begin as files of bytes do; texts in UTF-16 hold zeros
  constexpr std::size_t of_head = 512;
  const auto is_of_bytes = [](char c) { return (c >= 0 && c < '\t') || (c > '\r' && c < ' '); };
  if (FromUtf16(bytes.substr(0, of_head)) ||
      std::ranges::none_of(bytes.substr(0, of_head), is_of_bytes)) {
    return;
  }
  if (const LogFormat* const format = FormatOfBytes(bytes)) {
    Refuse({InputName(path)}, "is no table of text: it begins as {}; let its name end in {}",
           format->name, format->ending);
  }
  if (bytes.substr(0, of_head).find('\0') == std::string_view::npos) return;
  Refuse({InputName(path)},
         "is no table of text: its first bytes are none of characters; let its name end as its "
         "format asks, one of {}, {}",
         EndingsOf(ReadBy::program), EndingsOf(ReadBy::converter));
}

/// Makes torque of a current, by the motor's constant seen at the joint, where one is given.
void TakeTorqueConstant(double constant, Measurements& log) {
  if (constant == 0) return;
  const std::string_view unit = kTorqueUnit.For(log.joint);
  // what is a torque already needs no constant
  if (log.torque_unit != "A") {
    Refuse(
        {"--torque-constant"},
        "makes torque of a current, and the torque of {} is in {}; give --unit torque=A where it "
        "is in amperes",
        log.source, log.torque_unit);
  }
  // the motor's current becomes torque at the joint
  log.torque *= constant;
  log.torque_unit = unit;
  log.notes.push_back(fmt::format("torque: current times {:.6g} {}/A", constant, unit));
}

/// The recordings of a file: one, or one for each episode.
std::vector<Measurements> ReadFile(const std::string& path, const ReadSettings& layout,
                                   double patience = kPatience) {
  return AssembleContent(ReadColumns(path, layout, ColumnsOfJoint(layout), patience),
                         InputName(path), layout);
}

}  // namespace

template <typename T>
bool OfColumns<T>::Take(const std::string& column, const std::string& text) {
  std::optional<T> value;
  if constexpr (std::is_same_v<T, double>) {
    value = ParseFinite(text);
  } else {
    value = text;
  }
  if (value) (*this)[column] = *value;
  return value.has_value();
}

template <typename T>
std::vector<std::string> OfColumns<T>::Pairs() const {
  std::vector<std::string> pairs;
  for (const auto& [column, value] : *this) pairs.push_back(fmt::format("{}={}", column, value));
  return pairs;
}

template struct OfColumns<std::string>;
template struct OfColumns<double>;

void CheckReadSettings(const ReadSettings& settings) {
  for (const auto& [column, factor] : settings.scale) {
    if (std::isfinite(factor) && factor != 0) continue;
    Refuse({"--scale"}, "{}={}: the factor must be a finite number other than 0", Excerpt(column),
           factor);
  }
  const auto check = [](const char* option, double value, bool holds, const char* bound) {
    if (std::isfinite(value) && holds) return;
    Refuse({option}, "is {}; it must be a finite number{}", value, bound);
  };
  check("--gear", settings.gear, settings.gear != 0, " other than 0");
  check("--wrap", settings.wrap, settings.wrap >= 0, " above 0");
  check("--rate", settings.rate, settings.rate >= 0, " above 0, Hz");
  check("--torque-constant", settings.torque_constant, true, ", N.m/A or N/A at the joint");
}

Measurements ReadRecordingFile(const std::string& path, const ReadSettings& layout,
                               double patience) {
  return OnlyOne(ReadFile(path, layout, patience));
}

FileContent ReadColumns(const std::string& path, const ReadSettings& layout,
                        const WantedColumns& wanted, double patience) {
  RequireReadable(path);
  const FileFormat library = HandlersOf(path).library;
  if (library.read) return ReadApart(library, path, wanted, patience);
  const std::string text = ReadWholeFile(path);
  RequireText(text, path);
  return ParseColumns(text, InputName(path), layout, wanted);
}

void RequireWritable(const std::filesystem::path& path) {
  if (HandlersOf(path).write) return;
  Refuse({path}, "recordings are written as .csv or .h5, not '{}'; choose one of them",
         path.extension().string());
}

void WriteRecording(const Measurements& measurements, const std::filesystem::path& path) {
  RequireWritable(path);
  WriteWholeFile(path, HandlersOf(path).write(measurements));
}

void WriteColumns(const FileContent& content, const std::filesystem::path& path) {
  RequireWritable(path);
  WriteWholeFile(path, HandlersOf(path).write_columns(content));
}

std::vector<Measurements> ReadRecordings(const RecordingSource& source) {
  // numbers that cannot be meant are refused before anything is read
  CheckReadSettings(source.read);
  std::vector<Measurements> recordings;
  for (const std::string& path : source.files) {
    for (Measurements& one : ReadFile(path, source.read)) {
      TakeTorqueConstant(source.read.torque_constant, one);
      recordings.push_back(std::move(one));
    }
  }
  return recordings;
}

FileContent ContentOf(const std::map<std::string, std::vector<double>>& columns) {
  FileContent content;
  for (const auto& [column, values] : columns) {
    content.columns.push_back(
        {column, "", Eigen::VectorXd::Map(values.data(), std::ssize(values))});
  }
  return content;
}

Measurements MakeRecording(const std::map<std::string, std::vector<double>>& columns,
                           const ReadSettings& settings, const std::string& name) {
  // named columns go through the layout of a file
  return MakeRecording(ContentOf(columns), settings, name);
}

Measurements MakeRecording(FileContent content, const ReadSettings& settings,
                           const std::string& name) {
  return OnlyOne(MakeRecordings(std::move(content), settings, name));
}

std::vector<Measurements> MakeRecordings(FileContent content, const ReadSettings& settings,
                                         const std::string& name) {
  std::vector<Measurements> made = AssembleContent(std::move(content), name, settings);
  for (Measurements& one : made) TakeTorqueConstant(settings.torque_constant, one);
  return made;
}

std::vector<Measurements> MakeRecordings(std::string_view text, const ReadSettings& settings,
                                         const std::string& name) {
  std::vector<Measurements> made = ParseRecordings(text, name, settings);
  for (Measurements& one : made) TakeTorqueConstant(settings.torque_constant, one);
  return made;
}

}  // namespace warmjoint
