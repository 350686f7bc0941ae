#include "models/recording/read_recording.h"

#include <filesystem>

#include "models/foundation/bad_input.h"
#include "models/recording/hdf5.h"
#include "models/recording/matlab.h"

namespace warmjoint::inline models {
namespace {

std::string Extension(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

bool IsHdf5(const std::string& path) {
  const std::string extension = Extension(path);
  return extension == ".h5" || extension == ".hdf5";
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
  return IsHdf5(path) ? ReadHdf5(path, layout) : ReadCsv(path, layout);
}

Measurements ReadForeignRecording(const std::string& path, const CsvLayout& layout) {
  RefuseUnreadable(path);
  if (IsHdf5(path)) return ReadHdf5Apart(path, layout);
  return Extension(path) == ".mat" ? ReadMatlabApart(path, layout) : ReadCsv(path, layout);
}

void WriteRecording(const Measurements& measurements, const std::string& path) {
  // the extension tells the format
  if (IsHdf5(path)) return WriteHdf5(measurements, path);
  if (Extension(path) == ".csv") return WriteCsv(measurements, path);
  Refuse({path}, "recordings are written as .csv or .h5, not '{}'; choose one of them",
         Extension(path));
}

}  // namespace warmjoint::inline models
