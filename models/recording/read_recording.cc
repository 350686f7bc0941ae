#include "models/recording/read_recording.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "models/foundation/bad_input.h"
#include "models/recording/hdf5.h"
#include "models/recording/matlab.h"

namespace warmjoint::inline models {
namespace {

std::string Extension(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

using Reader = Measurements (*)(const std::string& path, const CsvLayout& layout);

/// A format of recordings.
struct Format {
  std::string_view extension;
  Reader read;        // of files that this program wrote
  Reader read_apart;  // of anybody's: in a process of its own where a library reads it
  void (*write)(const Measurements& measurements, const std::string& path);  // or none
};

constexpr Reader kHdf5Apart = [](const std::string& path, const CsvLayout& layout) {
  return ReadHdf5Apart(path, layout);
};
constexpr Reader kMatlabApart = [](const std::string& path, const CsvLayout& layout) {
  return ReadMatlabApart(path, layout);
};

constexpr Format kFormats[] = {
    {".csv", ReadCsv, ReadCsv, WriteCsv},
    {".h5", ReadHdf5, kHdf5Apart, WriteHdf5},
    {".hdf5", ReadHdf5, kHdf5Apart, WriteHdf5},
    {".mat", kMatlabApart, kMatlabApart, nullptr},
};

/// By the extension; any other is read as CSV, and not written.
Format FormatOf(const std::string& path) {
  const auto found = std::ranges::find(kFormats, Extension(path), &Format::extension);
  return found == std::end(kFormats) ? Format{"", ReadCsv, ReadCsv, nullptr} : *found;
}

/// Refuses what tools/convert makes readable.
void RefuseUnreadable(const std::string& path) {
  const std::string extension = Extension(path);
  // formats of other tools, by their extension
  for (const char* other : {".db3", ".mcap", ".bag", ".parquet", ".npz", ".npy"}) {
    if (extension != other) continue;
    Refuse({path}, "{} is not read here; first: tools/convert {} -o log.h5", other, path);
  }
}

}  // namespace

Measurements ReadRecording(const std::string& path, const CsvLayout& layout) {
  return FormatOf(path).read(path, layout);
}

Measurements ReadForeignRecording(const std::string& path, const CsvLayout& layout) {
  RefuseUnreadable(path);
  return FormatOf(path).read_apart(path, layout);
}

void WriteRecording(const Measurements& measurements, const std::string& path) {
  if (const auto write = FormatOf(path).write) return write(measurements, path);
  Refuse({path}, "recordings are written as .csv or .h5, not '{}'; choose one of them",
         Extension(path));
}

}  // namespace warmjoint::inline models
