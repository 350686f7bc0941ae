#include "tools/store/export_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/atomic_file.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {
namespace {

/// Shortest text that reads back bit for bit; empty for NaN.
std::string Number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

const ParameterScore* Find(const Result& result, const std::string& name) {
  if (!result.score) return nullptr;
  for (const auto* family : {&result.score->continuous, &result.score->discrete}) {
    for (const ParameterScore& score : *family) {
      if (score.name == name) return &score;
    }
  }
  return nullptr;
}

/// Adds the names that the list lacks.
void AddNames(const std::vector<ParameterScore>& scores, std::vector<std::string>& names) {
  for (const ParameterScore& score : scores) {
    if (std::ranges::find(names, score.name) == names.end()) names.push_back(score.name);
  }
}

std::string MetricCells(const Result& result) {
  if (!result.metrics) return ",,,,,,,";  // seven empty cells
  const Metrics& m = *result.metrics;
  return fmt::format(",{},{},{},{},{},{},{}", m.n, m.parameters, Number(m.effective_parameters),
                     Number(m.rmse), Number(m.mae), Number(m.fit), Number(m.fpe));
}

std::string ScoreCells(const Result& result) {
  if (!result.score) return ",,,,";
  const Score& s = *result.score;
  return fmt::format(",{},{},{},{}", Number(s.npe_continuous), Number(s.npe_discrete),
                     Number(s.bound_npe_continuous), Number(s.bound_npe_discrete));
}

std::string ParameterCells(const ParameterScore* score) {
  if (!score) return ",,,,";
  const std::string covered = score->covered ? (*score->covered ? "1" : "0") : "";
  return fmt::format(",{},{},{},{}", score->estimated ? Number(score->estimate) : "",
                     Number(score->truth), Number(score->bound), covered);
}

}  // namespace

std::string CsvCell(const std::string& text) {
  // spreadsheets take what begins so for a formula, and an apostrophe for "this is text"
  const bool formula = text.find_first_of("=+-@\t\r") == 0 && !ParseNumber(text);
  const std::string shown = formula ? "'" + text : text;
  if (shown.find_first_of(",\"\n\r") == std::string::npos) return shown;
  // quotes within a cell are doubled
  std::string quoted = "\"";
  for (const char c : shown) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

void CsvColumns::Add(const Result& result) {
  for (const auto& [name, value] : result.measures) {
    if (std::ranges::find(measures_, name) == measures_.end()) measures_.push_back(name);
  }
  if (!result.score) return;
  AddNames(result.score->continuous, continuous_);
  AddNames(result.score->discrete, discrete_);
}

std::vector<std::string> CsvColumns::Names() const {
  // constants of the law stand in both parametrisations, and once in the table
  std::vector<std::string> names = continuous_;
  for (const std::string& name : discrete_) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string CsvHeader(const CsvColumns& columns, const Suite& suite) {
  // variants only where there are several, then the figures of every result
  std::string csv = suite.ladder ? "variant," : "";
  csv +=
      "realization,identifier,status,n,parameters,effective_parameters,rmse,mae,fit,fpe,"
      "npe_continuous,npe_discrete,bound_npe_continuous,bound_npe_discrete";

  // what compensators reach, and four columns for each parameter
  for (const std::string& name : columns.Measures()) csv += "," + name;
  for (const std::string& name : columns.Names()) {
    csv += fmt::format(",{0},{0}_truth,{0}_bound,{0}_covered", name);
  }
  return csv + ",message\n";
}

std::string CsvRow(const Result& result, const CsvColumns& columns, const Suite& suite) {
  const std::string& label = suite.identifiers[static_cast<size_t>(result.identifier)].label;
  std::string csv;
  // which run it was: variant, realization, identifier
  if (suite.ladder) {
    csv += CsvCell(suite.ladder->variants[static_cast<size_t>(result.variant)].name) + ",";
  }
  csv += fmt::format("{},{},{}", result.realization, CsvCell(label), result.status);
  csv += MetricCells(result) + ScoreCells(result);
  for (const std::string& name : columns.Measures()) {
    const auto named = [&](const auto& measure) { return measure.first == name; };
    const auto found = std::ranges::find_if(result.measures, named);
    csv += "," + (found == result.measures.end() ? "" : Number(found->second));
  }
  for (const std::string& name : columns.Names()) csv += ParameterCells(Find(result, name));
  return csv + fmt::format(",{}\n", CsvCell(result.message));
}

void ExportResults(const RunStore& store) {
  // a first pass tells which columns there are
  CsvColumns columns;
  store.ForEachResult([&](const Result& result) { columns.Add(result); });

  // a second one writes them block by block, so that large runs need little memory
  AtomicFile file(store.directory() / "results.csv");
  constexpr std::size_t block = 1 << 20;  // bytes
  std::string text = CsvHeader(columns, store.suite());
  store.ForEachResult([&](const Result& result) {
    text += CsvRow(result, columns, store.suite());
    if (text.size() < block) return;
    file.Write(text);
    text.clear();
  });
  file.Write(text);
  file.Commit();
}

}  // namespace warmjoint
