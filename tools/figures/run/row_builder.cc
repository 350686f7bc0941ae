#include "tools/figures/run/row_builder.h"

#include <warmjoint/friction.h>

#include <algorithm>
#include <limits>

#include "tools/figures/number_text.h"

namespace warmjoint::figures {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Realizations whose course is drawn, one thin line each, and summed up by iteration: of more the
/// first ones, since a course has hundreds of numbers for each.
constexpr std::size_t kMostCourses = 2000;

using Eigen::Index;
using Eigen::VectorXd;

Eigen::VectorXi Places(const std::vector<int>& numbers) {
  return Eigen::Map<const Eigen::VectorXi>(numbers.data(), static_cast<Index>(numbers.size()));
}

VectorXd Column(const std::vector<double>& numbers) {
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}

std::string UnitOf(const std::string& name, const Scenario& scenario) {
  for (const ParameterInfo& info : FindLaw(scenario.friction.law)->parameters) {
    if (info.name == name) return UnitText(info.unit.For(scenario.joint_kind));
  }
  for (const ParameterInfo& info : Thermal::parameters) {
    if (info.name == name) return UnitText(info.unit.For(scenario.joint_kind));
  }
  return "";
}

/// Adds realization `row` to the course. traces: all of the identifier.
void Fill(Course& course, Index row, const TraceTable& trace) {
  const std::size_t columns = trace.columns.size();
  const auto value = [&](Index iteration, const std::string& name) {
    const auto found = std::find(trace.columns.begin(), trace.columns.end(), name);
    if (found == trace.columns.end()) return kUnknown;
    // one that stopped keeps its last values
    const std::size_t last = trace.rows() - 1;
    const std::size_t at = std::min(static_cast<std::size_t>(iteration), last);
    const auto column = static_cast<std::size_t>(found - trace.columns.begin());
    return static_cast<double>(trace.values[at * columns + column]);
  };
  // errors and parameters after each iteration
  for (Index k = 0; k < course.iteration.size(); ++k) {
    course.npe(row, k) = value(k, "npe_continuous");
    course.rmse(row, k) = value(k, "rmse");
    for (std::size_t i = 0; i < course.names.size(); ++i) {
      course.parameters[i](row, k) = value(k, course.names[i]);
    }
  }
}

Course ReadCourse(const RunStore& store, const std::vector<RunUnit>& units, int identifier) {
  std::vector<TraceTable> traces;
  const TraceTable* longest = nullptr;
  // the longest trace says how many iterations there are
  for (const RunUnit& unit : units) traces.push_back(store.ReadTrace(unit, identifier));
  for (const TraceTable& trace : traces) {
    if (trace.rows() > (longest ? longest->rows() : 0)) longest = &trace;
  }
  Course course;
  if (!longest) return course;

  const auto rows = static_cast<Index>(traces.size());
  const auto iterations = static_cast<Index>(longest->rows());
  course.iteration.resize(iterations);
  // the first column holds the number of the iteration
  for (Index k = 0; k < iterations; ++k) {
    course.iteration[k] = longest->values[static_cast<std::size_t>(k) * longest->columns.size()];
  }
  // columns that are neither the iteration nor an error are parameters
  for (const std::string& name : longest->columns) {
    const bool parameter = name != "iteration" && name != "rmse" && !name.starts_with("npe_");
    if (parameter) course.names.push_back(name);
  }
  const Eigen::MatrixXd unknown = Eigen::MatrixXd::Constant(rows, iterations, kUnknown);
  course.npe = course.rmse = unknown;
  course.parameters.assign(course.names.size(), unknown);
  // a realization without a trace stays unknown
  for (Index row = 0; row < rows; ++row) {
    const TraceTable& trace = traces[static_cast<std::size_t>(row)];
    if (trace.rows() > 0) Fill(course, row, trace);
  }
  return course;
}

}  // namespace

void RowBuilder::Count(const Result& result) {
  ++runs_;
  identifier_ = result.identifier;
  if (result.status != "ok") ++failures_[result.status];
  if (!result.score) return;
  // how many intervals of each parameter there are, and how many hold the truth
  parameters_.resize(result.score->continuous.size());
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const ParameterScore& from = result.score->continuous[i];
    parameters_[i].name = from.name;
    parameters_[i].intervals += from.covered.has_value();
    parameters_[i].covered += from.covered.value_or(false);
  }
}

void RowBuilder::Draw(const Result& result) {
  if (units_.size() < kMostCourses) units_.push_back({result.variant, result.realization});
  variant_.push_back(result.variant);
  realization_.push_back(result.realization);
  npe_.push_back(result.score ? result.score->npe_continuous : kUnknown);
  // an answer without figures of fit counts as unknown
  const auto metric = [&](double Metrics::*member) {
    return result.metrics ? (*result.metrics).*member : kUnknown;
  };
  rmse_.push_back(metric(&Metrics::rmse));
  fit_.push_back(metric(&Metrics::fit));
  fpe_.push_back(metric(&Metrics::fpe));
  mae_.push_back(metric(&Metrics::mae));
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    ParameterNumbers& one = parameters_[i];
    // those drawn before the first score have none
    for (Numbers* numbers : {&one.truth, &one.bound, &one.estimate}) {
      numbers->resize(npe_.size(), kUnknown);
    }
    if (!result.score) continue;
    const ParameterScore& from = result.score->continuous.at(i);
    one.truth.back() = from.truth;
    one.bound.back() = from.bound;
    if (from.estimated) one.estimate.back() = from.estimate;
  }
}

RunRow RowBuilder::Row(const RunStore& store, const Suite& suite,
                       const SuiteIdentifier& identifier) const {
  RunRow row;
  row.label = identifier.label;
  row.identifier = identifier.name;
  row.runs = runs_;
  row.failures = failures_;
  // numbers of the realizations that are drawn, in one order
  row.variant = Places(variant_);
  row.realization = Places(realization_);
  row.npe = Column(npe_);
  row.rmse = Column(rmse_);
  row.fit = Column(fit_);
  row.fpe = Column(fpe_);
  row.mae = Column(mae_);
  // estimates, truths and bounds of each parameter
  for (const ParameterNumbers& one : parameters_) {
    row.parameters.push_back({one.name, UnitOf(one.name, suite.scenario), Column(one.estimate),
                              Column(one.truth), Column(one.bound), one.intervals, one.covered});
  }
  // courses of as many realizations as a picture bears
  row.course = ReadCourse(store, units_, identifier_);
  return row;
}

}  // namespace warmjoint::figures
