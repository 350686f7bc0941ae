#include "models/recording/file_content.h"

#include <algorithm>

#include "models/recording/assemble.h"
#include "models/recording/recording_columns.h"

namespace warmjoint::inline models {

std::vector<std::string> NamesOf(const FileContent& content) {
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  return names;
}

CsvLayout WithAttributes(CsvLayout layout, const FileContent& content) {
  // what the file says of itself, where nobody says otherwise
  if (content.joint == "linear") layout.joint = JointKind::linear;
  if (layout.gear == 1 && content.gear) layout.gear = *content.gear;
  for (const RecordingColumn& column : RecordingColumns()) {
    const auto mapped = layout.column.find(column.name);
    const std::string theirs = mapped == layout.column.end() ? column.name : mapped->second;
    const auto found = std::find_if(content.columns.begin(), content.columns.end(),
                                    [&](const FileColumn& one) { return one.name == theirs; });
    if (found != content.columns.end() && !found->unit.empty()) {
      layout.unit.emplace(column.name, found->unit);
    }
  }
  return layout;
}

Measurements AssembleContent(const FileContent& content, const std::string& path,
                             const CsvLayout& given) {
  const CsvLayout layout = WithAttributes(given, content);
  const std::vector<ColumnSource> sources = FindColumns(NamesOf(content), layout, {path});
  // the columns that are asked for, all of one length
  RawColumns raw{path, {}, {}};
  for (const ColumnSource& source : sources) {
    raw.values.push_back(content.columns[source.index].values);
    if (raw.values.back().size() == raw.values.front().size()) continue;
    Refuse({path}, "{} has {} samples where {} has {}; all columns must be of one length",
           content.columns[source.index].name, raw.values.back().size(),
           content.columns[sources.front().index].name, raw.values.front().size());
  }
  return AssembleMeasurements(std::move(raw), sources, layout);
}

}  // namespace warmjoint::inline models
