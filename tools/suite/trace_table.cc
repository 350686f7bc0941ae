#include "tools/suite/trace_table.h"

#include <warmjoint/score.h>

#include <limits>
#include <map>

#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

using Values = std::map<std::string, double>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The entry's parameters, with both thermal pairs where it has one.
Values AllParameters(const TraceEntry& entry, double step) {
  Values values(entry.parameters.begin(), entry.parameters.end());
  const std::string gain(kGainName), tau(kTimeConstantName), discrete_gain(kDiscreteGainName),
      pole(kPoleName);
  // each pair of the warming follows from the other and the step
  const bool continuous = values.count(gain) && values.count(tau);
  const bool discrete = values.count(discrete_gain) && values.count(pole);
  if (continuous && !discrete) {
    const DiscreteThermal pair = Discretise({values[gain], values[tau]}, step);
    values[discrete_gain] = pair.gain;
    values[pole] = pair.pole;
  }
  if (discrete && !continuous) {
    const Thermal pair = Continuous({values[discrete_gain], values[pole]}, step);
    values[gain] = pair.gain;
    values[tau] = pair.time_constant;
  }
  return values;
}

/// NPE over the parameters of `truth`; one that is missing counts as 0, one whose truth is 0 not.
double Npe(const std::vector<ParameterScore>& truth, const Values& values) {
  std::vector<double> estimated, true_values;
  for (const ParameterScore& score : truth) {
    // an error relative to a truth of 0 has no size
    if (score.truth == 0) continue;
    // what is not estimated counts as 0
    const auto found = values.find(score.name);
    estimated.push_back(found == values.end() ? 0.0 : found->second);
    true_values.push_back(score.truth);
  }
  const auto size = static_cast<Eigen::Index>(estimated.size());
  return NormalisedParameterError(Eigen::Map<const Eigen::VectorXd>(estimated.data(), size),
                                  Eigen::Map<const Eigen::VectorXd>(true_values.data(), size));
}

}  // namespace

TraceTable MakeTraceTable(const std::vector<TraceEntry>& trace, const Score& score, double step) {
  TraceTable table;
  if (trace.empty()) return table;

  // the parameters of the first iteration are those of all
  table.columns = {"iteration", "rmse", "npe_continuous", "npe_discrete"};
  for (const auto& [name, value] : trace.front().parameters) table.columns.push_back(name);
  // a row for each iteration, with its errors against the truth
  for (const TraceEntry& entry : trace) {
    const Values values = AllParameters(entry, step);
    std::vector<double> row{static_cast<double>(entry.iteration), entry.rmse,
                            Npe(score.continuous, values), Npe(score.discrete, values)};
    // the parameters that this iteration has
    for (size_t i = row.size(); i < table.columns.size(); ++i) {
      const auto found = values.find(table.columns[i]);
      row.push_back(found == values.end() ? kUnknown : found->second);
    }
    for (const double value : row) table.values.push_back(static_cast<float>(value));
  }
  return table;
}

}  // namespace warmjoint
