#include "identification/identifiers/kalman.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/report_law.h"
#include "identification/online/kalman_passes.h"
#include "identification/warming/report_thermal.h"
#include "identification/warming/unsettled.h"
#include "identification/warming/warming_verdict.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "kalman";
constexpr double kSingular = 1e-6;  // of the closed loop's Jacobian

/// One pass is not efficient, and what still moves has not arrived.
void JudgePasses(const std::vector<KalmanPass>& passes, const Uncertainty& known,
                 Estimate& estimate) {
  if (passes.size() == 1) {
    for (EstimatedParameter& parameter : estimate.parameters) {
      parameter.std.reset();
      parameter.interval95.reset();
    }
    estimate.message += "; intervals need more than one pass";
    return;
  }
  const Eigen::Index p = known.covariance.rows();
  const Eigen::VectorXd moved = passes.back().mean - passes[passes.size() - 2].mean;
  const Eigen::ArrayXd deviation = known.covariance.diagonal().cwiseSqrt();
  if ((moved.head(p).cwiseAbs().array() <= deviation).all()) return;
  Void(Status::not_converged,
       "the last pass still moved parameters by more than their standard deviation; give more "
       "passes, or use energy-ml",
       estimate);
}

/// The estimate that the last pass makes, with its verdict.
Estimate Conclude(const KalmanTrack& track, const std::vector<KalmanPass>& passes,
                  double nominal_squares) {
  const Measurements& m = track.measurements;
  const KalmanPass& last = passes.back();
  const Eigen::Index d = last.mean.size() - 3;
  const Eigen::VectorXd x = last.mean.head(d);
  const Thermal thermal{last.mean[d], std::exp(last.mean[d + 1])};
  if (!last.mean.allFinite() || !(thermal.time_constant > 0) ||
      !std::isfinite(thermal.time_constant)) {
    return Failed(kName, Status::not_converged,
                  "the filters ran away; " + WhyUnsettled(m, "warm-up"));
  }

  // what the whole recording knows of these parameters
  const LoopResponse response = track.loop.Simulate(x, thermal);
  const Eigen::VectorXd torque = Kept(m.torque, track.selection);
  const Eigen::VectorXd fitted = Kept(response.force, track.selection);
  Eigen::MatrixXd jacobian = Kept(track.loop.Jacobian(x, thermal), track.selection).leftCols(d + 2);
  jacobian.col(d + 1) *= thermal.time_constant;  // by ln tau
  if (!fitted.allFinite() || !jacobian.allFinite()) {
    return Failed(kName, Status::not_converged,
                  "the filters ran away; " + WhyUnsettled(m, "warm-up"));
  }
  const double squares = (torque - fitted).squaredNorm();
  const double variance = squares / static_cast<double>(torque.size() - d - 2);
  const LeastSquares joint = SolveLeastSquares(jacobian, torque, kSingular);
  const bool distinct = joint.rank == d + 2;
  const auto [shortest, longest] = TimeConstantRange(track);
  const double vague = distinct ? std::sqrt(variance * joint.cofactor(d + 1, d + 1)) : kInfinity;
  if (auto why =
          UnknownWarming({(nominal_squares - squares) / variance, vague, thermal.time_constant,
                          shortest, longest, m.time[m.size() - 1] - m.time[0]})) {
    return Failed(kName, Status::not_identifiable, *why);
  }
  if (response.feeds_itself) {
    return Failed(kName, Status::inadequate_model,
                  WouldFeedItself(m.time[*response.feeds_itself], "try another law"));
  }

  Estimate estimate;
  estimate.identifier = kName;
  const Uncertainty known =
      JudgeUncertainty(jacobian, joint.cofactor, torque - fitted, track.selection, fitted);
  ReportLaw(track.law, x, known, m, estimate);
  const Eigen::Matrix2d covariance = known.covariance.bottomRightCorner<2, 2>();
  ReportThermal(thermal, covariance, known.freedom, m, estimate);
  const auto parameters = static_cast<int>(d) + 2;
  estimate.metrics = ComputeMetrics(torque, fitted, parameters, parameters);
  estimate.message =
      fmt::format("filtered in {} passes over {} samples; at the end E is {:.4g} {}{}",
                  passes.size(), torque.size(), last.mean[d + 2], m.torque_unit, NoiseOf(known));
  DescribeFriction(track.law, m, estimate);
  if (estimate.friction) estimate.friction->thermal = thermal;

  if (estimate.status == Status::ok) JudgePasses(passes, known, estimate);
  return estimate;
}

Estimate Identify(const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  const Law& law = *FindLaw(input.options.Text("law"));
  const auto d = static_cast<int>(law.parameters.size());
  if (!m.starts.empty()) {
    return Failed(kName, Status::bad_data,
                  "kalman follows one recording; give one, or use energy-ml for several");
  }
  if (auto why = Unusable(input, d + 2)) return Failed(kName, Status::bad_data, *why);

  // the law's columns must be distinct before any warming is thought of
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::MatrixXd kept = Kept(columns, input.selection);
  const LeastSquares nominal = SolveLeastSquares(kept, torque);
  if (nominal.rank < d) {
    return Failed(kName, Status::not_identifiable,
                  Indistinct(nominal.mixed, law, m, input.selection));
  }

  const double root = std::sqrt(static_cast<double>(torque.size()));
  const KalmanTrack track{law,
                          m,
                          input.selection,
                          ClosedLoop(m.time, m.velocity, columns),
                          kept.colwise().norm().transpose() / root,
                          torque.norm() / root};
  std::vector<TraceEntry> trace;
  const std::vector<KalmanPass> passes = RunPasses(track, input.options.Integer("passes"), trace);
  Estimate estimate = Conclude(track, passes, (torque - kept * nominal.solution).squaredNorm());
  estimate.trace = std::move(trace);
  return estimate;
}

}  // namespace

Identifier Kalman() {
  return {kName,
          "law, warming and energy online, by a bank of extended Kalman filters",
          {{"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"},
           {"passes", "10", "integer >= 1 <= 100",
            "most passes over the recording; 1: as online, without intervals"}},
          &Identify};
}

}  // namespace warmjoint::inline identification
