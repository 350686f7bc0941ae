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

/// A format of recordings; any other extension is CSV.
struct Format {
  std::string_view extension;
  Reader read;        // of files that this program wrote
  Reader read_apart;  // of anybody's: in a process of its own where a library reads it
};

constexpr Reader kHdf5Apart = [](const std::string& path, const CsvLayout& layout) {
  return ReadHdf5Apart(path, layout);
};
constexpr Reader kMatlabApart = [](const std::string& path, const CsvLayout& layout) {
  return ReadMatlabApart(path, layout);
};

constexpr Format kFormats[] = {
    {".h5", ReadHdf5, kHdf5Apart},
    {".hdf5", ReadHdf5, kHdf5Apart},
    {".mat", kMatlabApart, kMatlabApart},
};

Format FormatOf(const std::string& path) {
  const auto found = std::ranges::find(kFormats, Extension(path), &Format::extension);
  return found == std::end(kFormats) ? Format{".csv", ReadCsv, ReadCsv} : *found;
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
  // the extension tells the format
  const std::string extension = Extension(path);
  if (extension == ".h5" || extension == ".hdf5") return WriteHdf5(measurements, path);
  if (extension == ".csv") return WriteCsv(measurements, path);
  Refuse({path}, "recordings are written as .csv or .h5, not '{}'; choose one of them", extension);
}

}  // namespace warmjoint::inline models
