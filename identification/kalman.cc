#include "identification/kalman.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/closed_loop.h"
#include "identification/fit_data.h"
#include "identification/kalman_step.h"
#include "identification/least_squares.h"
#include "identification/linear_laws.h"
#include "identification/report_law.h"
#include "identification/report_thermal.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "kalman";
constexpr Eigen::Index kMoments = 50;  // of the trace
constexpr double kSingular = 1e-6;
constexpr double kVague = 0.5;  // standard deviation of ln tau beyond which nothing is known of it

/// The recording as the filter reads it.
struct Track {
  const ClosedLoop& loop;
  const Measurements& measurements;
  const Selection& selection;

  KalmanSample At(Eigen::Index i) const {
    const Intervals& intervals = loop.intervals();
    return {loop.levels().row(i).transpose(), loop.speed()[i],
            loop.direction()[i] * measurements.torque[i], selection.keep[i] && loop.speed()[i] > 0,
            intervals.length[intervals.which[i]]};
  }
};

/// Wide, but no wider than the data can overcome. torque: rms, N.m or N.
Eigen::MatrixXd Ignorance(const Eigen::VectorXd& mean, double torque, double top_speed) {
  const Eigen::Index d = mean.size() - 3;
  Eigen::VectorXd deviation(d + 3);
  deviation.head(d).setConstant(3 * torque * std::max(1.0, 1 / top_speed));
  deviation.tail(3) << 3 * std::max(std::abs(mean[d]), 1.0), 1.0, 0.0;
  return deviation.cwiseAbs2().asDiagonal();
}

TraceEntry Note(const Law& law, const KalmanState& state, Eigen::Index sample, double rmse) {
  TraceEntry entry;
  entry.iteration = static_cast<int>(sample);
  const Eigen::Index d = state.mean.size() - 3;
  for (Eigen::Index i = 0; i < d; ++i) {
    entry.parameters.emplace_back(law.parameters[static_cast<size_t>(i)].name, state.mean[i]);
  }
  entry.parameters.emplace_back("thermal_gain", state.mean[d]);
  entry.parameters.emplace_back("thermal_time_constant", std::exp(state.mean[d + 1]));
  entry.rmse = rmse;
  return entry;
}

/// One pass; returns the state at the end and, in `trace`, moments on the way.
KalmanState Pass(const Track& track, const Law& law, KalmanState state, const KalmanNoise& noise,
                 std::vector<TraceEntry>& trace) {
  trace.clear();
  const Eigen::Index n = track.loop.size();
  double squares = 0, count = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const KalmanSample sample = track.At(i);
    if (sample.measured) {
      const Eigen::Index d = sample.levels.size();
      const double innovation =
          sample.level - sample.levels.dot(state.mean.head(d)) - state.mean[d + 2];
      squares += innovation * innovation;
      count += 1;
    }
    state = KalmanStep(state, sample, noise);
    if ((i + 1) % std::max<Eigen::Index>(n / kMoments, 1) == 0) {
      trace.push_back(Note(law, state, i + 1, std::sqrt(squares / std::max(count, 1.0))));
    }
  }
  return state;
}

/// The estimate that the state's parameters make, with its verdict. moved: what the last pass
/// changed; empty after a single one.
Estimate Conclude(const IdentifierInput& input, const Law& law, const ClosedLoop& loop,
                  const KalmanState& state, const Eigen::VectorXd& moved) {
  const Measurements& m = input.measurements;
  const Eigen::Index d = state.mean.size() - 3;
  const Eigen::VectorXd x = state.mean.head(d);
  const Thermal thermal{state.mean[d], std::exp(state.mean[d + 1])};
  if (!state.mean.allFinite() || !(thermal.time_constant > 0)) {
    return Failed(kName, Status::not_converged,
                  "the filter ran away; start nearer, or use energy-ml");
  }
  const LoopResponse response = loop.Simulate(x, thermal);
  if (response.feeds_itself) {
    return Failed(kName, Status::inadequate_model,
                  fmt::format("at {:.6g} s the estimated friction pushes instead of braking and "
                              "would feed itself; start nearer, or use energy-ml",
                              m.time[*response.feeds_itself]));
  }

  // what the whole recording knows of these parameters
  Eigen::MatrixXd jacobian = Kept(loop.Jacobian(x, thermal), input.selection).leftCols(d + 2);
  jacobian.col(d + 1) *= thermal.time_constant;  // by ln tau
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::VectorXd fitted = Kept(response.force, input.selection);
  const LeastSquares joint = SolveLeastSquares(jacobian, torque, kSingular);
  const bool distinct = joint.rank == d + 2;
  Uncertainty known;
  if (distinct)
    known = JudgeUncertainty(jacobian, joint.cofactor, torque - fitted, input.selection);
  if (!distinct || !(known.Deviation(d + 1) < kVague)) {
    return Failed(kName, Status::not_identifiable,
                  "thermal_gain and thermal_time_constant cannot be told: no warming shows in this "
                  "recording; record from cold until friction settles, or use nominal-ls");
  }

  Estimate estimate;
  estimate.identifier = kName;
  ReportLaw(law, x, known, m, estimate);
  const Eigen::Matrix2d covariance = known.covariance.bottomRightCorner<2, 2>();
  ReportThermal(thermal, covariance, known.freedom, m, estimate);
  const auto parameters = static_cast<int>(d) + 2;
  estimate.metrics = ComputeMetrics(torque, fitted, parameters, parameters);
  estimate.message = "filtered over the whole recording" + ColourOf(known.noise);
  DescribeFriction(law, m, estimate);
  if (estimate.friction) estimate.friction->thermal = thermal;

  const Eigen::VectorXd deviation = known.covariance.diagonal().cwiseSqrt();
  if (moved.size() > 0 && (moved.head(d + 2).cwiseAbs().array() > deviation.array()).any()) {
    Void(Status::not_converged,
         "the last pass still moves parameters by more than their standard deviation; give more "
         "passes, start nearer, or use energy-ml",
         estimate);
  }
  return estimate;
}

Estimate Identify(const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  const Law& law = *FindLaw(input.options.Text("law"));
  const auto d = static_cast<int>(law.parameters.size());
  if (auto why = Unusable(input, d + 2)) return Failed(kName, Status::bad_data, *why);

  // the law's columns must be distinct before any warming is thought of
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::MatrixXd kept = Kept(columns, input.selection);
  const LeastSquares nominal = SolveLeastSquares(kept, torque);
  if (nominal.rank < d) {
    std::vector<std::string> mixed;
    for (const Eigen::Index i : nominal.mixed) mixed.emplace_back(law.parameters[i].name);
    return Failed(kName, Status::not_identifiable, Indistinct(mixed, m, input.selection));
  }

  // pass by pass, each as ignorant as the first
  const ClosedLoop loop(m.time, m.velocity, columns);
  const Track track{loop, m, input.selection};
  const auto n = static_cast<double>(torque.size());
  const double rms = torque.norm() / std::sqrt(n);
  KalmanNoise noise{(torque - kept * nominal.solution).squaredNorm() / n,
                    Eigen::VectorXd::Zero(d + 3)};
  noise.drift.head(d + 2).setConstant(input.options.Number("drift"));
  KalmanState state;
  state.mean.resize(d + 3);
  state.mean << nominal.solution, input.options.Number("start_gain"),
      std::log(input.options.Number("start_time_constant")), 0;
  Eigen::VectorXd moved;
  std::vector<TraceEntry> trace;
  for (int pass = 0; pass < input.options.Integer("passes"); ++pass) {
    const Eigen::VectorXd before = state.mean;
    state.mean[d + 2] = 0;
    state.covariance = Ignorance(state.mean, rms, loop.speed().maxCoeff());
    state = Pass(track, law, state, noise, trace);
    if (pass > 0) moved = state.mean - before;
    if (!state.mean.allFinite() || trace.empty()) break;
    noise.torque = std::max(std::pow(trace.back().rmse, 2), 1e-12 * rms * rms);
  }

  Estimate estimate = Conclude(input, law, loop, state, moved);
  if (state.mean.allFinite()) estimate.trace = std::move(trace);
  return estimate;
}

}  // namespace

Identifier Kalman() {
  return {kName,
          "law, warming and energy online, by an extended Kalman filter",
          {{"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"},
           {"passes", "5", "integer >= 1", "passes over the recording; 1: as online"},
           {"start_gain", "-0.1", "number", "first thermal gain, N.m/W or N/W"},
           {"start_time_constant", "600", "number > 0", "first time constant, s"},
           {"drift", "0", "number >= 0", "variance that each parameter gains in a second"}},
          &Identify};
}

}  // namespace warmjoint
