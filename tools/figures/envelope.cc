// One recording as it warms: its level of friction and the guesses read off it.
#include <fmt/core.h>

#include <utility>

#include "identification/alternating/first_guess.h"
#include "identification/fit_parameters.h"
#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/fit_view.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

/// "gain −3.0 N·m/W, time constant 600 s"
std::string ThermalText(const Thermal& thermal, const Measurements& measurements) {
  const std::vector<FitParameter> rows = HeatParameters(thermal, measurements);
  return fmt::format("k = {} {}, τ = {} {}", SignificantText(thermal.gain), UnitText(rows[0].unit),
                     SignificantText(thermal.time_constant), UnitText(rows[1].unit));
}

/// The torque as logged, between the friction levels of both directions.
Plot TorquePanel(const FitView& view, const TorqueEnvelope& envelope) {
  const Eigen::VectorXd time = view.time / TimeUnit(view);
  const Eigen::VectorXd middle = envelope.time / TimeUnit(view);
  Plot plot;
  plot.series.push_back({"torque", Hue::grey, Line{time, view.torque, 0.8}});
  // the level with both signs encloses the torque
  plot.series.push_back({"level of friction", Hue::blue, Line{middle, envelope.level, 2}});
  plot.series.push_back({"", Hue::blue, Line{middle, -envelope.level, 2}});
  plot.x = TimeAxis(view);
  // accelerations may leave the picture
  const Eigen::VectorXd kept = KeptOf(view, view.torque);
  plot.y = LinearAxis(TorqueLabel(view, "torque"), {kept, envelope.level, -envelope.level});
  return plot;
}

/// The level alone, with the places where the guess reads it.
Plot LevelPanel(const FitView& view, const TorqueEnvelope& envelope) {
  // what the guess is read off: the settled last quarter, and 63 % of the way to it
  const double settled_from = 0.75 * envelope.time.tail(1)[0] / TimeUnit(view);
  const double at = envelope.time_to_63 / TimeUnit(view);
  const double reached = envelope.cold + 0.632 * (envelope.settled - envelope.cold);
  const Eigen::VectorXd middle = envelope.time / TimeUnit(view);
  Plot plot;
  plot.x = TimeAxis(view);
  plot.y = LinearAxis(TorqueLabel(view, "sign(v) · torque − k_{v} |v|"),
                      {envelope.level, Eigen::Vector2d(envelope.cold, envelope.settled)});
  // the level over time between its cold and its settled value
  plot.series.push_back({"level of friction", Hue::blue, Line{middle, envelope.level, 1.4}});
  plot.series.push_back({"", Hue::blue, Scatter{middle, envelope.level, 3}});
  plot.series.push_back({"cold", Hue::green, LevelLine{envelope.cold}});
  plot.series.push_back({"settled: mean of the last quarter", Hue::vermilion,
                         Line{Eigen::Vector2d(settled_from, plot.x.upper),
                              Eigen::Vector2d::Constant(envelope.settled), 2.5}});
  // across at 63 % of the way and down to the time that it takes
  plot.series.push_back({"63 % of the way", Hue::text,
                         Line{Eigen::Vector3d(0, at, at),
                              Eigen::Vector3d(reached, reached, plot.y.lower), 1.2, Dash::dashed}});
  return plot;
}

}  // namespace

std::optional<Figure> MakeEnvelope(const std::string& what, const LogSamples& measurements,
                                   const Selection& selection,
                                   const std::optional<Thermal>& truth) {
  // without a guess there is nothing to show
  if (selection.count() == 0) return std::nullopt;
  const FirstGuess guess = GuessThermal(measurements, selection);
  if (!guess.thermal) return std::nullopt;
  const FitView view = MakeFitView(measurements, selection, {});
  const TorqueEnvelope& envelope = *guess.envelope;

  // the guess stands below the title
  const std::string read = ThermalText(*guess.thermal, measurements);
  Figure figure{"envelope", "The level of friction and the first guess of its warming",
                fmt::format("{}; first guess (25): {}", what, read), ""};
  // in words: how far the level goes, how long it takes, what is guessed from that
  figure.finding = fmt::format(
      "The level of friction goes from {} to {} {}; 63 % of the way takes {} {}. Guess: {}",
      SignificantText(envelope.cold), SignificantText(envelope.settled), view.torque_unit,
      SignificantText(envelope.time_to_63 / TimeUnit(view)), TimeUnitName(view), read);
  // the truth beside the guess, where it is known
  if (truth) {
    const std::string known = ThermalText(*truth, measurements);
    figure.subtitle += fmt::format("; truth: {}", known);
    figure.finding += fmt::format("; truth: {}", known);
  }
  figure.finding += ".";
  // the recording at the left, what is read off it at the right
  return RowOfPlots(std::move(figure), 430,
                    {{"The recording and its level of friction", TorquePanel(view, envelope)},
                     {"What the guess is read off", LevelPanel(view, envelope)}});
}

}  // namespace warmjoint::figures
