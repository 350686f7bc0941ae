#include "models/recording/csv.h"

#include <fmt/format.h>

#include "models/foundation/atomic_file.h"
#include "models/recording/assemble.h"
#include "models/recording/csv_text.h"

namespace warmjoint::inline models {

Measurements ReadCsv(const std::string& path, const CsvLayout& layout) {
  return ParseCsv(ReadWholeFile(path), InputName(path), layout);
}

Measurements ParseCsv(std::string_view text, const std::string& name, const CsvLayout& layout) {
  // the header tells where the columns are, and only those are read
  const CsvText csv(text, name);
  const std::vector<ColumnSource> sources = FindColumns(csv.names(), layout, csv.header_place());

  std::vector<std::size_t> indices;
  for (const ColumnSource& source : sources) indices.push_back(source.index);
  return AssembleMeasurements(csv.ReadColumns(indices), sources, layout);
}

std::string RecordingToCsv(const Measurements& measurements) {
  // the columns that are there
  std::vector<std::string> names;
  std::vector<const Eigen::VectorXd*> columns;
  for (const RecordingColumn& column : RecordingColumns()) {
    if (const Eigen::VectorXd* values = column.get(measurements)) {
      names.push_back(column.name);
      columns.push_back(values);
    }
  }

  // the shortest digits that read back as the same double
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(names, ","));
  for (Eigen::Index i = 0; i < measurements.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      fmt::format_to(std::back_inserter(text), "{}{}", k == 0 ? "" : ",", (*columns[k])[i]);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

void WriteCsv(const Measurements& measurements, const std::string& path) {
  WriteWholeFile(path, RecordingToCsv(measurements));
}

}  // namespace warmjoint::inline models
