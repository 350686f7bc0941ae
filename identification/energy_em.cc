#include "identification/energy_em.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/block_descent.h"
#include "identification/convergence.h"
#include "identification/first_guess.h"
#include "identification/fit_data.h"
#include "identification/linear_laws.h"
#include "identification/report_thermal.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "energy-em";
constexpr double kSingular = 1e-6;  // of the joint Jacobian; short of it the intervals tell

/// Where the loop starts: from the options, from (25) corrected, or drawn at random.
FirstGuess Start(const IdentifierInput& input) {
  const std::string& start = input.options.Text("start");
  if (start == "guess") return GuessThermal(input.measurements, input.selection);
  if (start == "options") {
    return {
        Thermal{input.options.Number("start_gain"), input.options.Number("start_time_constant")},
        ""};
  }
  RandomStream random(input.random, Stream::start);
  const auto [least_gain, greatest_gain] = input.options.Range("gain_range");
  const auto [shortest, longest] = input.options.Range("time_range");
  const double gain = random.Uniform(least_gain, greatest_gain);
  return {Thermal{gain, random.Uniform(shortest, longest)}, ""};
}

/// Names and values of all parameters, continuous and discrete.
std::vector<std::pair<std::string, double>> Named(const Law& law, const DescentState& state,
                                                  double h) {
  std::vector<std::pair<std::string, double>> named;
  for (Eigen::Index i = 0; i < state.nominal.size(); ++i) {
    named.emplace_back(law.parameters[static_cast<size_t>(i)].name, state.nominal[i]);
  }
  const DiscreteThermal discrete = Discretise(state.thermal, h);
  named.emplace_back("thermal_gain", state.thermal.gain);
  named.emplace_back("thermal_time_constant", state.thermal.time_constant);
  named.emplace_back("thermal_gain_discrete", discrete.gain);
  named.emplace_back("thermal_pole", discrete.pole);
  return named;
}

/// (nominal, gain, ln tau): the parameters in which the covariance is known.
Eigen::VectorXd Vector(const DescentState& state) {
  const Eigen::Index d = state.nominal.size();
  Eigen::VectorXd x(d + 2);
  x << state.nominal, state.thermal.gain, std::log(state.thermal.time_constant);
  return x;
}

/// All iterations, the start included.
std::vector<DescentState> Iterate(const BlockDescent& descent, const Thermal& start,
                                  int iterations) {
  std::vector<DescentState> states{descent.Start(start)};
  for (int i = 0; i < iterations; ++i) {
    DescentState from = states.back();
    if (i == 0) from.thermal.time_constant = descent.ScanFrom(from);
    states.push_back(descent.Next(from));
  }
  return states;
}

/// Distance to the fixed point, each parameter relative to its value or, where that is smaller, to
/// its standard deviation; tau by its logarithm, which is relative already.
Convergence Judge(const std::vector<DescentState>& states, const Eigen::VectorXd& deviations) {
  Eigen::VectorXd scale = Vector(states.back()).cwiseAbs().cwiseMax(deviations);
  scale.tail(1).setOnes();
  std::vector<Eigen::VectorXd> iterates;
  for (const DescentState& state : states) {
    iterates.push_back(Vector(state).cwiseQuotient(scale));
  }
  return JudgeConvergence(iterates);
}

/// First kept sample whose fitted friction pushes instead of braking, or -1.
Eigen::Index FeedsItselfAt(const Measurements& m, const Eigen::VectorXd& fitted) {
  for (Eigen::Index i = 0; i < fitted.size(); ++i) {
    if (FeedsItself(m.velocity[i], fitted[i])) return i;
  }
  return -1;
}

/// Values, and standard deviations where `covariance` [d + 2 x d + 2] is known.
void ReportParameters(const Law& law, const DescentState& state,
                      const std::optional<Eigen::MatrixXd>& covariance, double freedom,
                      const Measurements& measurements, Estimate& estimate) {
  const Eigen::Index d = state.nominal.size();
  for (Eigen::Index i = 0; i < d; ++i) {
    const ParameterInfo& info = law.parameters[static_cast<size_t>(i)];
    const std::string unit = UnitFor(info, measurements);
    if (covariance) {
      estimate.parameters.push_back(WithInterval(std::string(info.name), state.nominal[i], unit,
                                                 std::sqrt((*covariance)(i, i)), freedom));
    } else {
      estimate.parameters.push_back({std::string(info.name), state.nominal[i], unit, {}, {}});
    }
  }
  std::optional<Eigen::Matrix2d> thermal;
  if (covariance) thermal = covariance->bottomRightCorner<2, 2>();
  ReportThermal(state.thermal, thermal, freedom, measurements, estimate);
}

/// The last state as an estimate, with its verdict.
Estimate Conclude(const IdentifierInput& input, const Law& law, const BlockDescent& descent,
                  const Selection& moving, const std::vector<DescentState>& states) {
  const Measurements& m = input.measurements;
  const DescentState& last = states.back();
  const auto d = static_cast<int>(last.nominal.size()) + 2;
  const auto fail = [](Status status, std::string message) {
    return Failed(kName, status, std::move(message));
  };

  // what no number should be given for
  const Eigen::VectorXd fitted = descent.Fitted(last);
  if (!last.inside) {
    return fail(Status::not_identifiable,
                fmt::format("thermal_time_constant runs to {:.3g} s, the end of what these samples "
                            "can tell; record until the friction settles, or with rests",
                            last.thermal.time_constant));
  }
  if (const Eigen::Index i = FeedsItselfAt(m, fitted); i >= 0) {
    return fail(Status::inadequate_model,
                fmt::format("at {:.6g} s the fitted friction pushes instead of braking and would "
                            "feed itself; try law asymmetric, or start nearer to the solution",
                            m.time[i]));
  }
  const Eigen::VectorXd torque = Kept(m.torque, moving);
  const LeastSquares joint =
      SolveLeastSquares(Kept(descent.Jacobian(last), moving), torque, kSingular);
  if (joint.rank < d) {
    return fail(Status::not_identifiable,
                "the motion cannot tell warming from the nominal friction; record from cold, with "
                "speeds that differ clearly, until the friction settles");
  }

  // what is known now, and how far from the end it is
  Estimate estimate;
  estimate.identifier = kName;
  const double freedom = static_cast<double>(torque.size()) - d;
  estimate.metrics = ComputeMetrics(torque, Kept(fitted, moving), d, d);
  const double variance = last.rmse * last.rmse * static_cast<double>(torque.size()) / freedom;
  const Eigen::MatrixXd covariance = variance * joint.cofactor;
  const Convergence distance = Judge(states, covariance.diagonal().cwiseSqrt());
  const double tolerance = input.options.Number("tolerance");
  if (!(distance.remaining <= tolerance)) {
    estimate.status = Status::not_converged;
    estimate.message = fmt::format(
        "stopped after {} iterations while the parameters still move: at the observed rate of "
        "{:.4f} an iteration they end up to {:.2g} % from here (tolerance {:.2g} %); give more "
        "iterations, or use energy-ml",
        states.size() - 1, distance.rate, 100 * distance.remaining, 100 * tolerance);
    ReportParameters(law, last, {}, freedom, m, estimate);
    return estimate;
  }
  estimate.message = fmt::format(
      "converged: after {} iterations, at a rate of {:.4f}, the parameters are within {:.2g} % of "
      "where they go",
      states.size() - 1, distance.rate, 100 * distance.remaining);
  ReportParameters(law, last, covariance, freedom, m, estimate);
  DescribeFriction(law, m, estimate);
  return estimate;
}

Estimate Identify(const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  const Law& law = *FindLaw(input.options.Text("law"));
  const auto d = static_cast<int>(law.parameters.size());
  if (auto why = Unusable(input, d + 2)) return Failed(kName, Status::bad_data, *why);

  // the columns of Fn must be distinct before any warming is thought of
  const Selection moving{input.selection.keep && m.velocity.array() != 0, {}};
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity);
  const LeastSquares nominal = SolveLeastSquares(Kept(columns, moving), Kept(m.torque, moving));
  if (nominal.rank < d) {
    std::vector<std::string> mixed;
    for (const Eigen::Index i : nominal.mixed) mixed.emplace_back(law.parameters[i].name);
    return Failed(kName, Status::not_identifiable, Indistinct(mixed, m, moving));
  }

  FirstGuess start = Start(input);
  if (!start.thermal) return Failed(kName, Status::not_identifiable, start.why);

  const BlockDescent descent(m, moving, columns, nominal);
  const double shortest = descent.output_error().shortest();
  start.thermal->time_constant = std::max(start.thermal->time_constant, shortest);
  const std::vector<DescentState> states =
      Iterate(descent, *start.thermal, input.options.Integer("iterations"));

  Estimate estimate = Conclude(input, law, descent, moving, states);
  const double h = descent.output_error().filter().mean_step();
  for (size_t i = 0; i < states.size(); ++i) {
    estimate.trace.push_back({static_cast<int>(i), Named(law, states[i], h), states[i].rmse});
  }
  return estimate;
}

}  // namespace

Identifier EnergyEm() {
  return {kName,
          "Algorithm 1: energy filter and nominal law fitted in turn, a trace per iteration",
          {
              {"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"},
              {"iterations", "50", "integer >= 0", "iterations of the loop"},
              {"start", "options", "options|guess|random",
               "start_gain and start_time_constant, the torque's envelope (25), or drawn evenly"},
              {"start_gain", "-0.1", "number", "first thermal gain, N.m/W or N/W"},
              {"start_time_constant", "600", "number > 0", "first time constant, s"},
              {"gain_range", "-9:0", "range", "where a random first gain is drawn, N.m/W or N/W"},
              {"time_range", "0:1800", "range", "where a random first time constant is drawn, s"},
              {"tolerance", "0.01", "number > 0",
               "largest distance from the fixed point that counts as converged, relative"},
          },
          &Identify};
}

}  // namespace warmjoint
