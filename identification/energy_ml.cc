#include "identification/energy_ml.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/fit_gravity.h"
#include "identification/least_squares.h"
#include "identification/linear_laws.h"
#include "identification/position_maps.h"
#include "identification/report_law.h"
#include "identification/report_thermal.h"
#include "identification/scan_time_constant.h"
#include "identification/uncertainty.h"
#include "identification/warm_fit.h"
#include "identification/warm_maps.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "energy-ml";

// the drop of |e|^2 / s^2 that warming must bring: by chance it exceeds 20 about once in 5000
// recordings, a chi-square of 2 freedoms at the best of about 5 independent time constants
constexpr double kVisible = 20;
constexpr double kVagueLogTau = 0.5;  // standard deviation of log(tau): 95 % within a factor of e

/// Why the warm-up cannot be told; nothing where it can. cofactor: of x; squares: of the fit
/// without warming and with it.
std::optional<std::string> UnseenWarming(const WarmFit& fit, const WarmStart& scanned,
                                         double variance, double nominal_squares,
                                         const Eigen::MatrixXd& cofactor) {
  const double visible = (nominal_squares - fit.solution.squares) / variance;
  if (!(visible > kVisible)) {
    return fmt::format(
        "no warm-up can be seen: thermal_gain and thermal_time_constant explain {:.3g} times the "
        "noise variance, below {:.3g}; record from cold until friction settles, or use nominal-ls",
        std::max(visible, 0.0), kVisible);
  }

  if (!fit.converged) return std::nullopt;
  const Eigen::Index i = fit.law_parameters + 1;
  const double vague = std::sqrt(variance * cofactor(i, i));
  const double tau = fit.thermal().time_constant;
  if (!(vague < kVagueLogTau) || tau < scanned.shortest / 4 || tau > scanned.longest * 4) {
    return fmt::format(
        "thermal_gain and thermal_time_constant cannot be told apart: tau is known to a factor of "
        "{:.3g} only; record longer, from cold until friction settles, or with rests",
        std::exp(1.96 * vague));
  }
  return std::nullopt;
}

std::vector<TraceEntry> Trace(const WarmFit& fit, const Law& law, double step, Eigen::Index n) {
  std::vector<TraceEntry> trace;
  for (const WarmIterate& iterate : fit.trace) {
    TraceEntry entry;
    entry.iteration = static_cast<int>(trace.size());
    entry.rmse = std::sqrt(iterate.squares / static_cast<double>(n));
    const Eigen::Index d = fit.law_parameters;
    for (Eigen::Index i = 0; i < d; ++i) {
      entry.parameters.emplace_back(law.parameters[i].name, iterate.x[i]);
    }
    const Thermal thermal{iterate.x[d], std::exp(iterate.x[d + 1])};
    const DiscreteThermal discrete = Discretise(thermal, step);
    entry.parameters.emplace_back("thermal_gain", thermal.gain);
    entry.parameters.emplace_back("thermal_time_constant", thermal.time_constant);
    entry.parameters.emplace_back("thermal_gain_discrete", discrete.gain);
    entry.parameters.emplace_back("thermal_pole", discrete.pole);
    trace.push_back(std::move(entry));
  }
  return trace;
}

/// d(F + G)/dx over all samples, [N x p].
Eigen::MatrixXd Jacobian(const ClosedLoop& loop, const GravityFit& gravity, const WarmFit& fit) {
  const Thermal thermal = fit.thermal();
  Eigen::MatrixXd jacobian = loop.Jacobian(fit.parameters(), thermal, fit.initial_energy())
                                 .leftCols(fit.solution.x.size() - fit.offsets);
  jacobian.col(fit.law_parameters + 1) *= thermal.time_constant;  // from tau to log(tau)
  return Beside(jacobian, gravity.columns);
}

/// The verdict on a fit, and its numbers where they can be trusted.
Estimate Conclude(const IdentifierInput& input, const Law& law, const GravityFit& gravity,
                  const ClosedLoop& loop, const WarmStart& scanned, const WarmFit& fit,
                  double nominal_squares) {
  const Measurements& m = input.measurements;
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const auto p = static_cast<int>(fit.solution.x.size());
  const Eigen::Index d = fit.law_parameters;
  const double variance = fit.solution.squares / static_cast<double>(torque.size() - p);
  const Eigen::MatrixXd cofactor = Cofactor(fit.normal);
  if (auto why = UnseenWarming(fit, scanned, variance, nominal_squares, cofactor)) {
    return Failed(kName, Status::not_identifiable, *why);
  }
  if (!fit.converged) {
    return Failed(
        kName, Status::not_converged,
        fmt::format("the fit still moves after {} iterations; does the torque column hold "
                    "friction?",
                    fit.trace.size() - 1));
  }
  const LoopResponse response =
      loop.Simulate(fit.parameters(), fit.thermal(), fit.initial_energy());
  if (response.feeds_itself) {
    return Failed(kName, Status::inadequate_model,
                  fmt::format("at {:.6g} s the fitted friction pushes instead of braking and would "
                              "feed itself; try another law",
                              m.time[*response.feeds_itself]));
  }

  Estimate estimate;
  estimate.identifier = kName;
  const Eigen::VectorXd fitted =
      Kept(response.force + gravity.columns * fit.offset_values(), input.selection);
  estimate.metrics = ComputeMetrics(torque, fitted, p, p);
  const Uncertainty known =
      JudgeUncertainty([&] { return Kept(Jacobian(loop, gravity, fit), input.selection); },
                       cofactor, torque - fitted, input.selection);
  if (!known.covariance.allFinite()) {
    return Failed(kName, Status::bad_data, "torque or velocity is too large to square");
  }
  ReportLaw(law, fit.parameters(), known, m, estimate);
  ReportThermal(fit.thermal(), known.covariance.block<2, 2>(d, d), known.freedom, m, estimate);
  if (fit.estimates_initial_energy()) {
    estimate.parameters.push_back(WithInterval("initial_energy", fit.initial_energy(),
                                               m.torque_unit, known.Deviation(d + 2),
                                               known.freedom));
  }
  ReportGravity(gravity, fit.solution.x, known, m, estimate);
  estimate.message = fmt::format("maximum likelihood on {} samples, refined in {} iterations{}",
                                 torque.size(), fit.trace.size() - 1, ColourOf(known.noise));
  DescribeFriction(law, m, estimate);
  if (estimate.friction) estimate.friction->thermal = fit.thermal();
  return estimate;
}

/// A start for all linear parameters, law before gravity, and the warming: the scan over tau once
/// gravity is out of the loss. nominal: the fit without warming.
WarmStart Scan(const Measurements& m, const GravityFit& gravity, const ClosedLoop& loop,
               const Eigen::MatrixXd& columns, const LeastSquares& nominal,
               const Eigen::VectorXd& level, const Eigen::VectorXd& kept) {
  if (gravity.count() == 0) return ScanTimeConstant(loop, level, kept);
  const ClosedLoop together(m.time, m.velocity, columns, m.starts);
  const Eigen::VectorXd weight = nominal.solution.tail(gravity.count());
  const Eigen::VectorXd pull = gravity.columns * weight;
  WarmStart start = ScanTimeConstant(together, level - loop.direction().cwiseProduct(pull), kept);
  start.parameters.tail(gravity.count()) += weight;
  return start;
}

/// Law, warming and a map over position together.
Estimate IdentifyWithMap(const IdentifierInput& input) {
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  if (auto refusal = RefuseForMaps(input, kName, *FindLaw(task.settings.law))) return *refusal;
  for (const char* option : {"gravity", "initial_energy"}) {
    const std::string& value = input.options.Text(option);
    if (value == "none" || value == "zero") continue;
    return Failed(kName, Status::bad_data,
                  fmt::format("position=map cannot be had together with {}={}; leave one of them "
                              "out (basis=position takes gravity up into the map)",
                              option, value));
  }
  const MapPoints points = Kept(PointsOf(input.measurements), input.selection);
  if (auto why = CannotCarry(MapQuantity::position, points)) {
    return Failed(kName, Status::bad_data, *why);
  }
  task.candidates = PositionMaps(input.options, task.settings, points);
  const std::optional<WarmMaps> warm = FitWarmMaps(input, task);
  return warm ? ReportWarmMaps(input, *warm) : Unsolvable(kName);
}

Estimate Identify(const IdentifierInput& given) {
  if (given.options.Text("position") == "map") return IdentifyWithMap(given);
  const Measurements& m = given.measurements;
  const Law& law = *FindLaw(given.options.Text("law"));
  const GravityFit gravity = PrepareGravity(given);
  if (gravity.why) return Failed(kName, gravity.status, *gravity.why);
  const IdentifierInput input = gravity.Of(given);
  const auto d = static_cast<int>(law.parameters.size() + gravity.count());
  if (auto why = Unusable(input, d + 3)) return Failed(kName, Status::bad_data, *why);

  // the columns of law and gravity must be distinct before any warming is thought of
  const Eigen::MatrixXd law_columns = LawColumns(law, m.velocity);
  const Eigen::MatrixXd columns = Beside(law_columns, gravity.columns);
  const Eigen::MatrixXd kept_columns = Kept(columns, input.selection);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const LeastSquares nominal = SolveLeastSquares(kept_columns, torque);
  if (!nominal.mixed.empty()) {
    return Failed(kName, Status::not_identifiable,
                  IndistinctColumns(nominal.mixed, law, gravity, input));
  }
  const double nominal_squares = (torque - kept_columns * nominal.solution).squaredNorm();

  // scan tau, then refine everything over the closed loop
  const ClosedLoop loop(m.time, m.velocity, law_columns, m.starts);
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
  const Eigen::VectorXd kept = (input.selection.keep && m.velocity.array() != 0).cast<double>();
  const WarmStart start = Scan(m, gravity, loop, columns, nominal, level, kept);
  const auto initial = input.options.Text("initial_energy") == "estimated"
                           ? InitialEnergy::estimated
                           : InitialEnergy::zero;
  const double scale = std::sqrt(nominal_squares / static_cast<double>(torque.size()));
  const Eigen::MatrixXd offsets = loop.direction().asDiagonal() * gravity.columns;
  const WarmFit fit = FitWarmFriction(loop, level, offsets, kept, start, initial, scale);

  Estimate estimate = Conclude(input, law, gravity, loop, start, fit, nominal_squares);
  estimate.trace = Trace(fit, law, loop.intervals().typical, torque.size());
  return estimate;
}

}  // namespace

Identifier EnergyMl() {
  std::vector<OptionInfo> options = PositionPartOptions();
  options.insert(options.begin() + 1,
                 {{"initial_energy", "zero", "zero|estimated",
                   "E(0): 0 for a cold joint, or estimated at a cost of accuracy"},
                  GravityOption()});
  return {kName,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          options, &Identify};
}

}  // namespace warmjoint
