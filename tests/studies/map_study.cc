// Whether maps hold what they say, and whether their default shape is a good one.
//
//   map_study SUITE.yaml [REALIZATIONS [VARIANT]]
//
// For each variant and identifier of a suite (tests/studies/maps.yaml, or one of scenarios/suites with maps): the numbers of kernels that
// were chosen; the rms error of the friction along a log that the fit has not seen, the same joint moved anew, over the noise of a sample;
// the same of a map with half the kernels, over that; and the bands: how often they hold the truth, with its standard error over the logs and an exact
// binomial test of one place of each log, the rms error over the standard deviation, and the median half width over the noise, apart for
// places with data and for holes. Maps count whose first axis is the position; the friction at a place is that without warming.
#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identification/answer/identify.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/holes.h"
#include "identification/uncertainty/tails.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tests/studies/for_each_variant.h"

namespace warmjoint {
namespace {

using Texts = std::map<std::string, std::string>;

/// What bands make of the truth at their places.
struct Cover {
  int held = 0;
  std::vector<double> z, widths;  // errors over deviations; half widths over the noise
  std::vector<double> shares;     // of the places of each log that are held
  int singles = 0;                // logs whose one place, each time the next one, is held

  /// The places that were counted since the last log, as one log's.
  void EndLog() {
    const size_t count = widths.size() - before_;
    if (count > 0) {
      singles += log_[shares.size() % count];
      shares.push_back((held - held_before_) / static_cast<double>(count));
    }
    before_ = widths.size();
    held_before_ = held;
    log_.clear();
  }

  /// Of the share that is held, since the errors at the places of one log go together.
  double StandardError() const {
    const auto n = static_cast<double>(shares.size());
    double mean = 0, squares = 0;
    for (const double one : shares) mean += one / n;
    for (const double one : shares) squares += (one - mean) * (one - mean);
    return n > 1 ? std::sqrt(squares / (n - 1) / n) : std::nan("");
  }

  /// Exact, of the single places under 95 %: logs are independent of each other, places of a log are not.
  double PValue() const {
    const boost::math::binomial counts(static_cast<double>(shares.size()), kIntervalLevel);
    const double below = cdf(counts, singles);
    const double above = singles > 0 ? cdf(complement(counts, singles - 1)) : 1;
    return std::min(1.0, 2 * std::min(below, above));
  }

  void Count(double truth, double value, double deviation, const std::array<double, 2>& interval,
             double noise) {
    log_.push_back(interval[0] <= truth && truth <= interval[1]);
    held += log_.back();
    if (deviation > 0) z.push_back((value - truth) / deviation);
    widths.push_back((interval[1] - interval[0]) / 2 / noise);
  }
  std::string Text() {
    if (widths.empty()) return "none";
    double squares = 0;
    for (const double one : z) squares += one * one;
    std::ranges::sort(widths);
    return fmt::format(
        "{:.1f} +- {:.1f} % of {}; one of each log {} of {}, p {:.2g}; rms z {:.2f}, half width "
        "{:.3f}, largest {:.3g}",
        100.0 * held / static_cast<double>(widths.size()), 100 * StandardError(), widths.size(),
        singles, shares.size(), PValue(), std::sqrt(squares / static_cast<double>(z.size())),
        widths[widths.size() / 2], widths.back());
  }

 private:
  std::vector<bool> log_;  // of the log that is being counted
  size_t before_ = 0;
  int held_before_ = 0;
};

/// One identifier over the realizations of one variant.
struct Outcomes {
  std::map<std::string, int> statuses;
  std::map<std::string, int> shapes;
  std::vector<double> errors, ratios;
  Cover seen, holes;
};

Fit FitTo(const Identifier& identifier, const PreparedLog& log, const Texts& given) {
  const IdentifierInput input{log, identifier.options.Read(given), {}};
  return identifier.fit(SelectSamples(identifier, input));
}

/// rms of the friction's error along a log; nothing where the fit predicts nothing.
std::optional<double> ErrorOn(const PreparedLog& log, const Truth& truth, const Fit& fit) {
  if (fit.refusal) return std::nullopt;
  const LogView& view = log.constant_speed();
  const TorquePrediction predicted =
      PredictTorque(fit.model, view.measurements, view.selection, fit.Start());
  // a view has samples of its own at reversals, which the truth does not know
  const Eigen::VectorXd force =
      PredictFriction(truth.friction, view.measurements, {truth.initial_energy}).force;
  const Eigen::VectorXd off = Kept(predicted.friction.force - force, view.selection);
  return off.norm() / std::sqrt(static_cast<double>(off.size()));
}

/// The map over position, which stands last beside one over the motor's angle; nullptr where there is none.
const FrictionMap* PositionMapOf(const Fit& fit) {
  if (fit.model.friction.maps.empty()) return nullptr;
  const FrictionMap& map = fit.model.friction.maps.back();
  return map.axes[0].quantity == MapQuantity::position ? &map : nullptr;
}

/// Width of its kernels in spacings.
double WidthOf(const FrictionMap& map) {
  const GaussianAxis& axis = map.axes[0].kernels;
  return axis.width / (axis.centres[1] - axis.centres[0]);
}

/// Law and maps of a friction at places of a band, without warming.
Eigen::VectorXd ForceAt(Friction friction, const MapBand& band, Measurements at) {
  const auto size = static_cast<Eigen::Index>(band.points.size());
  friction.thermal.reset();
  friction.second_thermal.reset();
  at.time = Eigen::VectorXd::LinSpaced(size, 0, 1);
  at.position.resize(size);
  at.velocity.resize(size);
  at.torque = Eigen::VectorXd::Zero(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    at.position[i] = band.points[static_cast<size_t>(i)][0];
    at.velocity[i] = band.points[static_cast<size_t>(i)][1];
  }
  return PredictFriction(friction, LogSamples(at)).force;
}

void CountBands(const Fit& fit, const Simulation& recording, const LogView& view,
                Outcomes& outcomes) {
  const FrictionMap* map = PositionMapOf(fit);
  if (!map || fit.figures.bands.empty() || map->axes.size() < 2) return;
  const MapBand& band = fit.figures.bands.back();
  const Eigen::VectorXd truth = ForceAt(recording.truth.friction, band, recording.measurements);
  const std::vector<bool> unseen =
      UnseenKernels({*map}, Kept(PointsOf(view.measurements), view.selection));
  for (size_t i = 0; i < band.points.size(); ++i) {
    (unseen[i] ? outcomes.holes : outcomes.seen)
        .Count(truth[static_cast<Eigen::Index>(i)], band.value[i], band.std[i], band.interval95[i],
               recording.truth.torque_noise);
  }
  outcomes.seen.EndLog();
  outcomes.holes.EndLog();
}

void Count(const Identifier& identifier, Texts given, const Simulation& recording,
           const Simulation& unseen, Outcomes& outcomes) {
  const PreparedLog log = Prepare(recording.measurements), other = Prepare(unseen.measurements);
  const Fit fit = FitTo(identifier, log, given);
  ++outcomes.statuses[fit.refusal ? std::string(StatusName(fit.refusal->status)) : "fitted"];
  const auto error = ErrorOn(other, unseen.truth, fit);
  if (!error) return;
  outcomes.errors.push_back(*error / recording.truth.torque_noise);
  const FrictionMap* map = PositionMapOf(fit);
  if (!map) return;
  const size_t kernels = map->axes[0].kernels.centres.size();
  ++outcomes.shapes[fmt::format("{} x {:.2g}", kernels, WidthOf(*map))];
  CountBands(fit, recording, log.constant_speed(), outcomes);

  // half as many, as wide in spacings
  given["kernels"] = fmt::format("{}", kernels / 2);
  given["width"] = fmt::format("{}", WidthOf(*map));
  const auto half = ErrorOn(other, unseen.truth, FitTo(identifier, log, given));
  if (half) outcomes.ratios.push_back(*half / *error);
}

/// Median, or 0 of nothing.
double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void Print(const std::string& label, Outcomes& outcomes) {
  fmt::print("  {}:", label);
  for (const auto& [status, count] : outcomes.statuses) fmt::print(" {} {}", status, count);
  fmt::print("; kernels");
  for (const auto& [shape, count] : outcomes.shapes) fmt::print(" {} ({})", shape, count);
  fmt::print(
      "\n    error elsewhere {:.3f} of the noise; with half the kernels {:.2f} times that "
      "(lowest {:.2f})\n",
      Median(outcomes.errors), Median(outcomes.ratios),
      outcomes.ratios.empty() ? 0 : *std::ranges::min_element(outcomes.ratios));
  fmt::print("    bands with data {}\n    bands in holes {}\n", outcomes.seen.Text(),
             outcomes.holes.Text());
  std::fflush(stdout);
}

void Study(const Suite& suite, int variant, int realizations) {
  const Scenario scenario = VariantScenario(suite, variant);
  const std::unique_ptr<Plant> plant = MakePlant(scenario);
  fmt::print("{}\n",
             suite.ladder ? suite.ladder->variants[static_cast<size_t>(variant)].name : suite.name);
  for (const SuiteIdentifier& choice : suite.identifiers) {
    const Identifier& identifier = FindIdentifier(choice.name);
    Outcomes outcomes;
    for (int r = 0; r < realizations; ++r) {
      const Simulation recording = plant->Run(static_cast<std::uint64_t>(r));
      const Simulation unseen = MovedAnew(scenario, recording.truth, realizations + r);
      Count(identifier, choice.options, recording, unseen, outcomes);
    }
    Print(choice.label.empty() ? choice.name : choice.label, outcomes);
  }
}

}  // namespace
}  // namespace warmjoint

int main(int count, char** arguments) {
  return warmjoint::StudyVariants("map_study", count, arguments, warmjoint::Study);
}
