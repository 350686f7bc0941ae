// What a recording takes from an HDF5 file, before anything is made of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/recording/csv.h"

namespace warmjoint::inline models {

/// A one-dimensional dataset of numbers at the root of a file.
struct Hdf5Column {
  std::string name;
  std::string unit;        // its attribute; empty where it has none
  Eigen::VectorXd values;  // [N]; empty where the layout does not ask for it
};

struct Hdf5Content {
  std::string joint;           // attribute of the root; empty where there is none
  std::optional<double> gear;  // the same
  std::vector<Hdf5Column> columns;
};

/// Most samples of a recording: 1.6 GB for each column.
inline constexpr unsigned long long kMostSamples = 200'000'000;

/// Reads the file with the HDF5 library, which crashes and hangs on some damaged files: within this
/// process for files of one's own. Throws BadInput, also where the layout's columns are not there or
/// have more than kMostSamples. One thread at a time.
Hdf5Content ReadHdf5Content(const std::string& path, const CsvLayout& layout);

/// The same in a child process with limits on memory (8 GiB besides what this process has) and time
/// (patience, s, and 1 s for each 10 MB of the file): crash and hang become BadInput.
Hdf5Content ReadHdf5ContentApart(const std::string& path, const CsvLayout& layout, double patience);

/// The layout, completed by what the file says of itself.
CsvLayout WithAttributes(CsvLayout layout, const Hdf5Content& content);

/// The names of the columns, as FindColumns takes them.
std::vector<std::string> NamesOf(const Hdf5Content& content);

}  // namespace warmjoint::inline models
