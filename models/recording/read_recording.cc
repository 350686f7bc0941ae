#include "models/recording/read_recording.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/recording/hdf5.h"
#include "models/recording/matlab.h"
#include "models/recording/read_apart.h"

namespace warmjoint {
namespace {

/// A format of recordings.
struct Format {
  std::string_view extension;
  FileFormat library;                                      // that reads it; CSV needs none
  std::string (*write)(const Measurements& measurements);  // its bytes; none: it is not written
};

constexpr Format kFormats[] = {
    {".csv", {}, RecordingToCsv},
    {".h5", {"HDF5", ReadHdf5Content}, RecordingToHdf5},
    {".hdf5", {"HDF5", ReadHdf5Content}, RecordingToHdf5},
    {".mat", {"a MATLAB file", ReadMatlabContent}, nullptr},
};

std::string Extension(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

/// By the extension; any other is read as CSV, and not written.
Format FormatOf(const std::string& path) {
  const auto found = std::ranges::find(kFormats, Extension(path), &Format::extension);
  return found == std::end(kFormats) ? Format{} : *found;
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

Measurements ReadRecordingFile(const std::string& path, const ReadSettings& layout,
                               double patience) {
  RefuseUnreadable(path);
  const FileFormat library = FormatOf(path).library;
  if (!library.read) return ReadCsv(path, layout);
  return AssembleContent(ReadApart(library, path, layout, patience), path, layout);
}

void WriteRecording(const Measurements& measurements, const std::filesystem::path& path) {
  if (const auto write = FormatOf(path).write) return WriteWholeFile(path, write(measurements));
  Refuse({path}, "recordings are written as .csv or .h5, not '{}'; choose one of them",
         Extension(path));
}

}  // namespace warmjoint
