// Reads the view of a run from its store.
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "identification/linear/least_squares.h"
#include "identification/preparation/select.h"
#include "identification/score/cramer_rao.h"
#include "models/foundation/bad_input.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/figures/axes.h"
#include "tools/figures/run/run_view.h"
#include "tools/figures/symbols.h"
#include "tools/store/run_store.h"

namespace warmjoint::figures {
namespace {

/// The results of one identifier, in the order of units: all are counted, and the numbers of those that
/// are drawn are kept.
class RowBuilder {
 public:
  void Count(const Result& result);
  void Draw(const Result& result);

  /// identifier: its position in the suite's list.
  RunRow Row(const RunStore& store, int identifier) const;

 private:
  using Numbers = std::vector<double>;

  /// One parameter of the truth.
  struct ParameterNumbers {
    std::string name;
    int intervals = 0, covered = 0;
    Numbers estimate, truth, bound;
  };

  /// Those of that name, in the order in which names come up.
  ParameterNumbers& NumbersOf(const std::string& name);

  RunRow counted_;  // runs and failures alone
  std::vector<int> variant_, realization_;
  Numbers npe_, rmse_, fit_, fpe_, mae_;
  std::vector<ParameterNumbers> parameters_;  // of all truths
};

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Realizations whose trace is drawn, one thin line each, and summed up by iteration: of more the
/// first ones, since a trace has hundreds of numbers for each.
constexpr Eigen::Index kMostTraces = 2000;

// of the answers that a page lists, which it holds without becoming slow to open: some 200 bytes each
constexpr std::int64_t kMostListed = 2000;
constexpr int kMostFailures = 500;

using Eigen::Index;
using Eigen::VectorXd;

/// The smallest distance, 1 or a prime, at which at most about `most` of `all` are taken: realizations at
/// such a distance share no period that a run may have.
int PrimeDistance(std::int64_t all, std::int64_t most) {
  const auto divided = [](std::int64_t n) {
    for (std::int64_t d = 2; d * d <= n; ++d) {
      if (n % d == 0) return true;
    }
    return false;
  };
  std::int64_t distance = (all + most - 1) / most;
  while (divided(distance)) ++distance;
  return static_cast<int>(distance > 1 ? distance : 1);
}

/// Lists a result where its turn is, or where it is one of the first failures out of turn, which are counted.
void List(const Result& result, Listing& listing, int& failures) {
  const bool in_turn = result.realization % listing.every == 0;
  if (!in_turn && (result.status == "ok" || ++failures > kMostFailures)) return;
  listing.answers.push_back({{result.variant, result.realization},
                             result.identifier,
                             result.status,
                             result.score ? result.score->npe_continuous : kUnknown,
                             result.metrics ? result.metrics->rmse : kUnknown,
                             result.metrics ? result.metrics->fit : kUnknown});
}

std::string UnitOf(const std::string& name, const Scenario& scenario) {
  const std::span<const ParameterInfo> law = FindLaw(scenario.friction.law)->parameters;
  for (const auto& table : {law, std::span<const ParameterInfo>(Thermal::parameters)}) {
    const auto info = std::ranges::find(table, name, &ParameterInfo::name);
    if (info != table.end()) return UnitText(info->unit.For(scenario.joint_kind));
  }
  return "";
}

/// Adds realization `row` to the trace. table: what was stored of it.
void Fill(ParameterTrace& trace, Index row, const TraceTable& table) {
  const std::size_t columns = table.columns.size();
  const auto value = [&](Index iteration, const std::string& name) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    if (found == table.columns.end()) return kUnknown;
    // one that stopped keeps its last values
    const std::size_t last = table.rows() - 1;
    const std::size_t at = std::min(static_cast<std::size_t>(iteration), last);
    const auto column = static_cast<std::size_t>(found - table.columns.begin());
    return static_cast<double>(table.values[at * columns + column]);
  };
  // errors and parameters after each iteration
  for (Index k = 0; k < trace.iteration.size(); ++k) {
    trace.npe(row, k) = value(k, "npe_continuous");
    trace.rmse(row, k) = value(k, "rmse");
    for (std::size_t i = 0; i < trace.names.size(); ++i) {
      trace.parameters[i](row, k) = value(k, trace.names[i]);
    }
  }
}

/// The traces of the first realizations of a row.
ParameterTrace ReadTrace(const RunStore& store, const RunRow& row, int identifier) {
  std::vector<TraceTable> tables;
  const TraceTable* longest = nullptr;
  // the longest trace says how many iterations there are
  for (Index i = 0; i < std::min(row.variant.size(), kMostTraces); ++i) {
    tables.push_back(store.ReadTrace({row.variant[i], row.realization[i]}, identifier));
  }
  for (const TraceTable& table : tables) {
    if (table.rows() > (longest ? longest->rows() : 0)) longest = &table;
  }
  ParameterTrace trace;
  if (!longest) return trace;

  const auto count = static_cast<Index>(tables.size());
  const auto iterations = static_cast<Index>(longest->rows());
  trace.iteration.resize(iterations);
  // the first column holds the number of the iteration
  for (Index k = 0; k < iterations; ++k) {
    trace.iteration[k] = longest->values[static_cast<std::size_t>(k) * longest->columns.size()];
  }
  // columns that are neither the iteration nor an error are parameters
  for (const std::string& name : longest->columns) {
    const bool parameter = name != "iteration" && name != "rmse" && !name.starts_with("npe_");
    if (parameter) trace.names.push_back(name);
  }
  const Eigen::MatrixXd unknown = Eigen::MatrixXd::Constant(count, iterations, kUnknown);
  trace.npe = trace.rmse = unknown;
  trace.parameters.assign(trace.names.size(), unknown);
  // a realization without a trace stays unknown
  for (Index i = 0; i < count; ++i) {
    const TraceTable& table = tables[static_cast<std::size_t>(i)];
    if (table.rows() > 0) Fill(trace, i, table);
  }
  return trace;
}

void RowBuilder::Count(const Result& result) {
  ++counted_.runs;
  if (result.status != "ok") ++counted_.failures[result.status];
  if (!result.score) return;
  // how many intervals of each parameter there are, and how many hold the truth
  for (const ParameterScore& from : result.score->continuous) {
    ParameterNumbers& one = NumbersOf(from.name);
    one.intervals += from.covered.has_value();
    one.covered += from.covered.value_or(false);
  }
}

RowBuilder::ParameterNumbers& RowBuilder::NumbersOf(const std::string& name) {
  const auto found = std::ranges::find(parameters_, name, &ParameterNumbers::name);
  if (found != parameters_.end()) return *found;
  ParameterNumbers& added = parameters_.emplace_back();
  added.name = name;
  return added;
}

void RowBuilder::Draw(const Result& result) {
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
  // unknown where there is no score, or the truth has no such parameter
  for (ParameterNumbers& one : parameters_) {
    for (Numbers* numbers : {&one.truth, &one.bound, &one.estimate}) {
      numbers->resize(npe_.size(), kUnknown);
    }
  }
  if (!result.score) return;
  for (const ParameterScore& from : result.score->continuous) {
    ParameterNumbers& one = NumbersOf(from.name);
    one.truth.back() = from.truth;
    one.bound.back() = from.bound;
    if (from.estimated) one.estimate.back() = from.estimate;
  }
}

RunRow RowBuilder::Row(const RunStore& store, int identifier) const {
  const Suite& suite = store.suite();
  RunRow row = counted_;
  row.label = suite.identifiers[static_cast<std::size_t>(identifier)].label;
  row.identifier = suite.identifiers[static_cast<std::size_t>(identifier)].name;
  // numbers of the realizations that are drawn, in one order
  row.variant = VectorOf(variant_);
  row.realization = VectorOf(realization_);
  row.npe = VectorOf(npe_);
  row.rmse = VectorOf(rmse_);
  row.fit = VectorOf(fit_);
  row.fpe = VectorOf(fpe_);
  row.mae = VectorOf(mae_);
  // estimates, truths and bounds of each parameter
  for (const ParameterNumbers& one : parameters_) {
    row.parameters.push_back({one.name, UnitOf(one.name, suite.scenario), VectorOf(one.estimate),
                              VectorOf(one.truth), VectorOf(one.bound), one.intervals,
                              one.covered});
  }
  // traces of as many realizations as a picture bears
  row.trace = ReadTrace(store, row, identifier);
  return row;
}

/// Sizes are the root mean squares of the bounds of all realizations; correlations come from
/// simulating the first once more. Empty where its plant cannot be made on this machine.
Eigen::MatrixXd BoundCovariance(const Suite& suite, const RunRow& row) {
  const auto d = static_cast<Index>(row.parameters.size());
  VectorXd relative(d);  // per cent of the truth
  // the bound of each parameter over the realizations, and its share of the truth
  for (Index i = 0; i < d; ++i) {
    const ParameterColumn& column = row.parameters[static_cast<std::size_t>(i)];
    relative[i] = 100 * std::sqrt(column.bound.array().square().mean() /
                                  column.truth.array().square().mean());
    if (!std::isfinite(relative[i]) || !(column.truth.array().abs() > 0).all()) return {};
  }
  // one simulation tells how the errors of parameters go together
  Eigen::MatrixXd covariance;
  try {
    const Simulation recording = MakePlant(suite.scenario)->Run(0);
    const LogSamples m = Prepare(recording.measurements).raw().measurements;
    const Selection selection =
        suite.scenario.plant == PlantKind::ideal ? SelectMoving(m) : SelectConstantSpeed(m);
    const double step = 1 / suite.scenario.sampling.rate;
    covariance = Cofactor(
        CramerRaoBound(m, selection, recording.truth, KnownInitialEnergy::yes, step).information);
  } catch (const BadInput&) {
    return {};
  }
  // some parameters may not be told apart
  if (covariance.rows() != d || !covariance.allFinite()) return {};
  const VectorXd scale = relative.cwiseQuotient(covariance.diagonal().cwiseSqrt());
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

Rungs ReadRungs(const Suite& suite) {
  Rungs rungs;
  if (!suite.ladder) return rungs;
  const auto& variants = suite.ladder->variants;
  rungs.variable = suite.ladder->variable;
  rungs.unit = suite.ladder->unit;
  rungs.values.resize(static_cast<Index>(variants.size()));
  // a variant without a value counts by its place and goes by its name
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

RunView ReadRunView(const RunStore& store, std::int64_t most_drawn) {
  const Suite& suite = store.suite();
  RunView view;
  const std::int64_t units = std::int64_t{suite.realizations} * suite.variants();
  // pictures of large runs draw a part of the realizations
  view.drawn_every = PrimeDistance(units, most_drawn);
  view.listing.every =
      PrimeDistance(units * static_cast<std::int64_t>(suite.identifiers.size()), kMostListed);
  std::vector<RowBuilder> rows(suite.identifiers.size());
  int failures = 0;  // listed out of turn
  // one pass over all that is stored
  store.ForEachResult([&](const Result& result) {
    RowBuilder& row = rows[static_cast<std::size_t>(result.identifier)];
    row.Count(result);
    List(result, view.listing, failures);
    if (result.realization % view.drawn_every == 0) row.Draw(result);
  });
  // a run without a finished realization has nothing to show
  view.board = ReadBoard(store);
  if (view.board.finished == 0) {
    Refuse({store.directory().string()},
           "no realization is finished yet; run the suite again to go on");
  }

  // what all figures say of the run
  view.suite = suite.name;
  view.question = suite.question;
  view.realizations = view.board.finished;
  view.rungs = ReadRungs(suite);
  view.torque_unit = UnitText(kTorqueUnit.For(suite.scenario.joint_kind));
  view.bound_npe = view.board.bound_npe_continuous;
  view.noise = NoiseOf(suite);
  // a row for each identifier
  for (std::size_t i = 0; i < suite.identifiers.size(); ++i) {
    view.rows.push_back(rows[i].Row(store, static_cast<int>(i)));
  }
  // the first row that knows all bounds says how errors at the bound go together
  for (const RunRow& row : view.rows) {
    if (view.bound_covariance.size() == 0 && !row.parameters.empty()) {
      view.bound_covariance = BoundCovariance(suite, row);
    }
  }
  return view;
}

}  // namespace warmjoint::figures
