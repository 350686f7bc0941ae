#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/linear/least_squares.h"
#include "identification/preparation/select.h"
#include "identification/score/cramer_rao.h"
#include "models/foundation/bad_input.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/figures/number_text.h"
#include "tools/figures/run/prime_distance.h"
#include "tools/figures/run/row_builder.h"
#include "tools/figures/run/run_view.h"

namespace warmjoint::figures {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Eigen::Index;
using Eigen::VectorXd;

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
    const Measurements m = Prepare(recording.measurements).taken().measurements;
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
  ListingBuilder listing(units * static_cast<std::int64_t>(suite.identifiers.size()));
  std::vector<RowBuilder> rows(suite.identifiers.size());
  // one pass over all that is stored
  store.ForEachResult([&](const Result& result) {
    RowBuilder& row = rows[static_cast<std::size_t>(result.identifier)];
    row.Count(result);
    listing.Add(result);
    if (result.realization % view.drawn_every == 0) row.Draw(result);
  });
  // a run without a finished realization has nothing to show
  view.board = ReadBoard(store);
  view.listing = std::move(listing).Finish();
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
    view.rows.push_back(rows[i].Row(store, suite, suite.identifiers[i]));
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
