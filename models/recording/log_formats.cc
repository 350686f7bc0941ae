#include "models/recording/log_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

constexpr std::string_view kHdf5 = "\x89HDF";
constexpr std::string_view kPickled =
    "a pickle can run any program when it is opened, and is not opened here. In Python give the "
    "data frame itself, or save it as .parquet or .csv";

}  // namespace

const std::vector<LogFormat>& LogFormats() {
  using enum ReadBy;
  static const std::vector<LogFormat> all{
      {".gz", "a compressed file", converter, "read_packed", "", "\x1f\x8b"},
      {".bz2", "a compressed file", converter, "read_packed", "", "BZh"},
      {".xz", "a compressed file", converter, "read_packed", "",
       "\xfd"
       "7zXZ"},
      {".zip", "an archive", converter, "read_packed", "", "PK\x03\x04"},
      {".csv", "a table of text"},
      {".h5", "HDF5", program, "read_arrays", "", kHdf5},
      {".hdf5", "HDF5", program, "read_arrays", "", kHdf5},
      {".mat", "a MATLAB file", program, "read_arrays", "", "MATLAB "},
      {".nc", "netCDF", converter, "read_arrays", "", "CDF"},
      {".db3", "a rosbag2", converter, "read_bag", "", "SQLite format 3"},
      {".mcap", "MCAP", converter, "read_bag", "", "\x89MCAP"},
      {".bag", "a rosbag", converter, "read_bag", "", "#ROSBAG"},
      {".parquet", "Parquet", converter, "read_parquet", "", "PAR1"},
      {".feather", "Feather", converter, "read_parquet", "", "ARROW1"},
      {".arrow", "Arrow", converter, "read_parquet", "", "ARROW1"},
      {".npz", "NumPy's", converter, "read_numpy"},
      {".npy", "NumPy's", converter, "read_numpy", "", "\x93NUMPY"},
      {".xlsx", "an Excel file", converter, "read_sheet"},
      {".xlsm", "an Excel file", converter, "read_sheet"},
      {".json", "JSON", converter, "read_json"},
      {".jsonl", "JSON", converter, "read_json"},
      {".ndjson", "JSON", converter, "read_json"},
      {".xls", "an Excel file of before 2007", nobody, "",
       "open it in a spreadsheet and save it as .xlsx or .csv", "\xd0\xcf\x11\xe0"},
      {".pkl", "a pickle", nobody, "", kPickled},
      {".pickle", "a pickle", nobody, "", kPickled},
  };
  return all;
}

const LogFormat& FormatOf(const std::string& path) {
  static const LogFormat text{"", "a table of text"};
  // a name with signs or strokes behind its ending is none of it
  std::string name = Lowercase(std::filesystem::path(path).filename().string());
  const auto found = std::ranges::find_if(LogFormats(), [&](const LogFormat& format) {
    return name.size() > format.ending.size() && name.ends_with(format.ending);
  });
  return found == LogFormats().end() ? text : *found;
}

const LogFormat* FormatOfBytes(std::string_view bytes) {
  const auto found = std::ranges::find_if(LogFormats(), [&](const LogFormat& format) {
    return !format.begins.empty() && bytes.starts_with(format.begins);
  });
  return found == LogFormats().end() ? nullptr : &*found;
}

bool IsOtherFormat(const std::string& path) {
  return FormatOf(path).by == ReadBy::converter || std::filesystem::is_directory(path);
}

bool MayHoldObjects(const std::string& path) {
  const LogFormat& format = FormatOf(path);
  return format.by == ReadBy::program && !format.reader.empty();
}

std::string EndingsOf(ReadBy by) {
  std::vector<std::string_view> endings;
  for (const LogFormat& format : LogFormats()) {
    if (format.by == by) endings.push_back(format.ending);
  }
  return fmt::format("{}", fmt::join(endings, ", "));
}

void RequireReadable(const std::string& path) {
  const LogFormat& format = FormatOf(path);
  const bool is_folder = std::filesystem::is_directory(path);
  if (format.by == ReadBy::nobody && !is_folder) {
    Refuse({path}, "is {} by its name, '{}', and is not read: {}", format.name, format.ending,
           format.remedy);
  }
  if (!IsOtherFormat(path)) return;
  Refuse({path}, "{} is not read here; first: warmjoint convert {} -o log.h5",
         is_folder ? "a folder" : format.ending, path);
}

}  // namespace warmjoint
