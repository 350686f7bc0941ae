#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/preparation/prepared_log.h"
#include "identification/preparation/select.h"
#include "models/foundation/bad_input.h"
#include "models/recording/course_of.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/board/board_builder.h"
#include "tools/report/draw/ticks.h"
#include "tools/report/figures/friction_spread.h"
#include "tools/report/run/run_view.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::report {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Eigen::Index;
using Eigen::VectorXd;

/// Realizations whose course is drawn, one thin line each, and summed up by iteration: of more the
/// first ones, since a course has hundreds of numbers for each.
constexpr std::size_t kMostCourses = 2000;

/// A column that grows.
using Numbers = std::vector<double>;

VectorXd Column(const Numbers& numbers) {
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}

/// One parameter of the truth, as results come.
struct ParameterNumbers {
  std::string name;
  Numbers estimate, truth, bound;
  int intervals = 0, covered = 0;
};

/// The results of one identifier, as they come, in the order of units.
class RowBuilder {
 public:
  void Add(const Result& result) {
    if (units_.size() < kMostCourses) units_.push_back({result.variant, result.realization});
    identifier_ = result.identifier;
    if (result.status != "ok") ++failures_[result.status];
    variant_.push_back(result.variant);
    npe_.push_back(result.score ? result.score->npe_continuous : kUnknown);
    const auto metric = [&](double Metrics::*member) {
      return result.metrics ? (*result.metrics).*member : kUnknown;
    };
    rmse_.push_back(metric(&Metrics::rmse));
    fit_.push_back(metric(&Metrics::fit));
    fpe_.push_back(metric(&Metrics::fpe));
    mae_.push_back(metric(&Metrics::mae));
    if (result.score) AddParameters(*result.score);
    for (ParameterNumbers& one : parameters_) {
      if (one.truth.size() == npe_.size()) continue;
      for (Numbers* numbers : {&one.truth, &one.bound, &one.estimate}) {
        numbers->resize(npe_.size(), kUnknown);
      }
    }
  }

  RunRow Row(const RunStore& store, const Suite& suite, const SuiteIdentifier& identifier) const;

 private:
  void AddParameters(const Score& score) {
    if (parameters_.empty()) parameters_.resize(score.continuous.size());
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      const ParameterScore& from = score.continuous.at(i);
      ParameterNumbers& one = parameters_[i];
      one.name = from.name;
      // those before the first score have none
      for (Numbers* numbers : {&one.truth, &one.bound, &one.estimate}) {
        numbers->resize(npe_.size() - 1, kUnknown);
      }
      one.truth.push_back(from.truth);
      one.bound.push_back(from.bound);
      one.estimate.push_back(from.estimated ? from.estimate : kUnknown);
      one.intervals += from.covered.has_value();
      one.covered += from.covered.value_or(false);
    }
  }

  std::vector<Unit> units_;  // the first ones, for courses
  int identifier_ = 0;
  std::map<std::string, int> failures_;
  std::vector<int> variant_;
  Numbers npe_, rmse_, fit_, fpe_, mae_;
  std::vector<ParameterNumbers> parameters_;
};

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

Course ReadCourse(const RunStore& store, const std::vector<Unit>& units, int identifier) {
  std::vector<TraceTable> traces;
  const TraceTable* longest = nullptr;
  for (const Unit& unit : units) traces.push_back(store.ReadTrace(unit, identifier));
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

RunRow RowBuilder::Row(const RunStore& store, const Suite& suite,
                       const SuiteIdentifier& identifier) const {
  RunRow row;
  row.label = identifier.label;
  row.identifier = identifier.name;
  row.runs = static_cast<int>(npe_.size());
  row.failures = failures_;
  row.variant =
      Eigen::Map<const Eigen::VectorXi>(variant_.data(), static_cast<Index>(variant_.size()));
  row.npe = Column(npe_);
  row.rmse = Column(rmse_);
  row.fit = Column(fit_);
  row.fpe = Column(fpe_);
  row.mae = Column(mae_);
  for (const ParameterNumbers& one : parameters_) {
    row.parameters.push_back({one.name, UnitOf(one.name, suite.scenario), Column(one.estimate),
                              Column(one.truth), Column(one.bound), one.intervals, one.covered});
  }
  row.course = ReadCourse(store, units_, identifier_);
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
    const Measurements m = Prepare(recording.measurements).taken().measurements;
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

RunView ReadRunView(const RunStore& store) {
  const Suite suite = StoredSuite(store);
  BoardBuilder board(suite);
  std::vector<RowBuilder> rows(suite.identifiers.size());
  store.ForEachUnit([&](const std::vector<Result>& unit) {
    board.Add(unit);
    for (const Result& result : unit) rows[static_cast<std::size_t>(result.identifier)].Add(result);
  });
  RunView view;
  view.board = board.Finish();
  if (view.board.finished == 0) {
    Refuse({store.directory().string()},
           "no realization is finished yet; run the suite again to go on");
  }

  view.suite = suite.name;
  view.question = suite.question;
  view.realizations = view.board.finished;
  view.rungs = ReadRungs(suite);
  view.torque_unit = UnitText(kTorqueUnit.For(suite.scenario.joint_kind));
  view.bound_npe = view.board.bound_npe_continuous;
  view.noise = NoiseOf(suite);
  for (std::size_t i = 0; i < suite.identifiers.size(); ++i) {
    view.rows.push_back(rows[i].Row(store, suite, suite.identifiers[i]));
  }
  for (const RunRow& row : view.rows) {
    if (view.bound_covariance.size() == 0 && !row.parameters.empty()) {
      view.bound_covariance = BoundCovariance(suite, row);
    }
  }
  return view;
}

}  // namespace warmjoint::report
