// What a recording takes from a file of columns (HDF5, MATLAB), before anything is made of it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "models/recording/csv.h"

namespace warmjoint::inline models {

/// A one-dimensional array of numbers with a name.
struct FileColumn {
  std::string name;
  std::string unit;        // as the file says; empty where it does not
  Eigen::VectorXd values;  // [N]; empty where the layout does not ask for it
};

struct FileContent {
  std::string joint;           // "rotary" or "linear"; empty where the file does not say
  std::optional<double> gear;  // the same
  std::vector<FileColumn> columns;
};

/// Most samples of a recording: 1.6 GB for each column.
inline constexpr unsigned long long kMostSamples = 200'000'000;

/// The layout, completed by what the file says of itself.
CsvLayout WithAttributes(CsvLayout layout, const FileContent& content);

/// The names of the columns, as FindColumns takes them.
std::vector<std::string> NamesOf(const FileContent& content);

/// The recording. Throws BadInput as ReadCsv does, and for columns of different lengths.
Measurements AssembleContent(const FileContent& content, const std::string& path,
                             const CsvLayout& layout);

}  // namespace warmjoint::inline models
