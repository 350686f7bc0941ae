#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/preparation/select.h"
#include "models/foundation/bad_input.h"
#include "models/recording/course_of.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/board/leaderboard.h"
#include "tools/report/draw/ticks.h"
#include "tools/report/figures/friction_spread.h"
#include "tools/report/run/run_view.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::report {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Eigen::Index;
using Eigen::VectorXd;

/// The results of one identifier, by realization.
using Own = std::vector<const Result*>;

template <typename Number>
VectorXd Column(const Own& results, const Number& number) {
  VectorXd column(results.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    column[static_cast<Index>(i)] = number(*results[i]);
  }
  return column;
}

template <typename Member>
VectorXd MetricColumn(const Own& results, Member member) {
  return Column(results, [member](const Result& result) {
    return result.metrics ? static_cast<double>((*result.metrics).*member) : kUnknown;
  });
}

ParameterColumn ReadParameter(const Own& results, std::size_t place, const std::string& unit) {
  const auto number = [&](auto pick) {
    return Column(results, [&](const Result& result) {
      return result.score ? pick(result.score->continuous.at(place)) : kUnknown;
    });
  };
  ParameterColumn column;
  column.unit = unit;
  column.truth = number([](const ParameterScore& score) { return score.truth; });
  column.bound = number([](const ParameterScore& score) { return score.bound; });
  column.estimate = number(
      [](const ParameterScore& score) { return score.estimated ? score.estimate : kUnknown; });
  for (const Result* result : results) {
    if (!result->score) continue;
    const ParameterScore& score = result->score->continuous.at(place);
    column.name = score.name;
    column.intervals += score.covered.has_value();
    column.covered += score.covered.value_or(false);
  }
  return column;
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
  for (Index k = 0; k < course.iteration.size(); ++k) {
    course.npe(row, k) = value(k, "npe_continuous");
    course.rmse(row, k) = value(k, "rmse");
    for (std::size_t i = 0; i < course.names.size(); ++i) {
      course.parameters[i](row, k) = value(k, course.names[i]);
    }
  }
}

Course ReadCourse(const RunStore& store, const Own& results) {
  std::vector<TraceTable> traces;
  const TraceTable* longest = nullptr;
  for (const Result* result : results) {
    traces.push_back(store.ReadTrace({result->variant, result->realization}, result->identifier));
  }
  for (const TraceTable& trace : traces) {
    if (trace.rows() > (longest ? longest->rows() : 0)) longest = &trace;
  }
  Course course;
  if (!longest) return course;

  const auto rows = static_cast<Index>(traces.size());
  const auto iterations = static_cast<Index>(longest->rows());
  course.iteration.resize(iterations);
  for (Index k = 0; k < iterations; ++k) {
    course.iteration[k] = longest->values[static_cast<std::size_t>(k) * longest->columns.size()];
  }
  for (const std::string& name : longest->columns) {
    const bool parameter = name != "iteration" && name != "rmse" && !name.starts_with("npe_");
    if (parameter) course.names.push_back(name);
  }
  const Eigen::MatrixXd unknown = Eigen::MatrixXd::Constant(rows, iterations, kUnknown);
  course.npe = course.rmse = unknown;
  course.parameters.assign(course.names.size(), unknown);
  for (Index row = 0; row < rows; ++row) {
    const TraceTable& trace = traces[static_cast<std::size_t>(row)];
    if (trace.rows() > 0) Fill(course, row, trace);
  }
  return course;
}

RunRow ReadRow(const RunStore& store, const Suite& suite, const SuiteIdentifier& identifier,
               const Own& results) {
  RunRow row;
  row.label = identifier.label;
  row.identifier = identifier.name;
  row.runs = static_cast<int>(results.size());
  for (const Result* result : results) {
    if (result->status != "ok") ++row.failures[result->status];
  }
  row.variant = Column(results, [](const Result& result) { return result.variant; }).cast<int>();
  row.npe = Column(results, [](const Result& result) {
    return result.score ? result.score->npe_continuous : kUnknown;
  });
  row.rmse = MetricColumn(results, &Metrics::rmse);
  row.fit = MetricColumn(results, &Metrics::fit);
  row.fpe = MetricColumn(results, &Metrics::fpe);
  row.mae = MetricColumn(results, &Metrics::mae);

  const auto scored = std::find_if(results.begin(), results.end(),
                                   [](const Result* result) { return result->score.has_value(); });
  if (scored != results.end()) {
    for (std::size_t i = 0; i < (*scored)->score->continuous.size(); ++i) {
      const std::string& name = (*scored)->score->continuous[i].name;
      row.parameters.push_back(ReadParameter(results, i, UnitOf(name, suite.scenario)));
    }
  }
  row.course = ReadCourse(store, results);
  return row;
}

/// Sizes are the root mean squares of the bounds of all realizations; correlations come from
/// simulating the first once more. Empty where its plant cannot be made on this machine.
Eigen::MatrixXd BoundCovariance(const Suite& suite, const RunRow& row) {
  const auto d = static_cast<Index>(row.parameters.size());
  Estimate bound;
  VectorXd relative(d);  // per cent a unit
  for (Index i = 0; i < d; ++i) {
    const ParameterColumn& column = row.parameters[static_cast<std::size_t>(i)];
    const double size = std::sqrt(column.bound.array().square().mean());
    if (!std::isfinite(size) || !(column.truth.array().abs() > 0).all()) return {};
    bound.parameters.push_back({column.name, column.truth[0], column.unit, size, {}});
    relative[i] = 100 / std::sqrt(column.truth.array().square().mean());
  }
  FrictionSpread spread;
  try {
    const Recording recording = MakePlant(suite.scenario)->Run(0);
    const Measurements& m = recording.measurements;
    bound.friction = recording.truth.friction;
    spread = SpreadOf(
        bound, CourseOf(m), {recording.truth.initial_energy},
        suite.scenario.plant == PlantKind::ideal ? SelectMoving(m) : SelectConstantSpeed(m));
  } catch (const BadInput&) {
    return {};
  }
  if (spread.names.size() != row.parameters.size()) return {};

  // from the spread's order to the truth's
  Eigen::MatrixXd covariance(d, d);
  const auto place = [&](Index i) {
    const std::string& name = row.parameters[static_cast<std::size_t>(i)].name;
    return std::find(spread.names.begin(), spread.names.end(), name) - spread.names.begin();
  };
  for (Index i = 0; i < d; ++i) {
    for (Index j = 0; j < d; ++j) {
      covariance(i, j) = spread.covariance(place(i), place(j)) * relative[i] * relative[j];
    }
  }
  return covariance;
}

Rungs ReadRungs(const Suite& suite) {
  Rungs rungs;
  if (!suite.ladder) return rungs;
  const auto& variants = suite.ladder->variants;
  rungs.variable = suite.ladder->variable;
  rungs.unit = suite.ladder->unit;
  rungs.values.resize(static_cast<Index>(variants.size()));
  for (std::size_t i = 0; i < variants.size(); ++i) {
    rungs.values[static_cast<Index>(i)] = variants[i].value.value_or(static_cast<double>(i));
    if (!variants[i].value) rungs.names.push_back(variants[i].name);
  }
  return rungs;
}

/// The noise that all variants have; NaN where they differ, or a filter leaves only some of it.
double NoiseOf(const Suite& suite) {
  const double noise = VariantScenario(suite, 0).noise.torque;
  for (int variant = 0; variant < suite.variants(); ++variant) {
    const Scenario scenario = VariantScenario(suite, variant);
    if (scenario.sampling.cutoff > 0 || scenario.noise.torque != noise) return kUnknown;
  }
  return noise;
}

}  // namespace

int RunRow::failed() const {
  int count = 0;
  for (const auto& [status, runs_of_it] : failures) count += runs_of_it;
  return count;
}

RunView ReadRunView(const std::filesystem::path& directory) {
  const RunStore store = RunStore::OpenToRead(directory);
  const Suite suite = StoredSuite(store);
  const std::vector<Result> results = store.ReadResults();
  if (results.empty()) {
    Refuse({directory}, "no realization is finished yet; run the suite again to go on");
  }
  const Leaderboard board = MakeLeaderboard(suite, results);

  RunView view;
  view.suite = suite.name;
  view.question = suite.question;
  view.realizations = board.finished;
  view.rungs = ReadRungs(suite);
  view.torque_unit = UnitText(kTorqueUnit.For(suite.scenario.joint_kind));
  view.bound_npe = board.bound_npe_continuous;
  view.noise = NoiseOf(suite);
  for (std::size_t i = 0; i < suite.identifiers.size(); ++i) {
    Own own;
    for (const Result& result : results) {
      if (result.identifier == static_cast<int>(i)) own.push_back(&result);
    }
    view.rows.push_back(ReadRow(store, suite, suite.identifiers[i], own));
  }
  for (const RunRow& row : view.rows) {
    if (view.bound_covariance.size() == 0 && !row.parameters.empty()) {
      view.bound_covariance = BoundCovariance(suite, row);
    }
  }
  return view;
}

}  // namespace warmjoint::report
