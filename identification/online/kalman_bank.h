// Online filters: recursive least squares with forgetting, and a bank of Kalman filters, each around a time constant of its own.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

#include "models/friction/thermal.h"

namespace warmjoint {

/// What is known after some samples; d = D parameters, or any number for Eigen::Dynamic.
template <int D>
struct RecursiveState {
  Eigen::Matrix<double, D, 1> estimate;  // [d]
  Eigen::Matrix<double, D, D> cofactor;  // [d x d] (sum of f^age a a^T)^-1
};

/// The state before any sample: estimate 0, cofactor `doubt` times the identity. doubt: large relative to the inverse
/// of the regressor's squares.
template <int D>
RecursiveState<D> KnowNothing(Eigen::Index d, double doubt) {
  return {Eigen::Matrix<double, D, 1>::Zero(d),
          doubt * Eigen::Matrix<double, D, D>::Identity(d, d)};
}

/// The state after one more sample y = a . x + noise (Ljung, System Identification, 11.2):
///   g = P a / (f + a . P a),  x <- x + g (y - a . x),  P <- (P - g (P a)^T) / f.
/// forgetting: f, above 0 and at most 1; a sample counts f as much as its successor. P stays
/// symmetric to the last bit.
template <int D>
void TakeIn(const Eigen::Matrix<double, D, 1>& a, double y, double forgetting,
            RecursiveState<D>& state) {
  const Eigen::Matrix<double, D, 1> Pa = state.cofactor * a;
  const double scale = 1 / (forgetting + a.dot(Pa));
  const double innovation = y - a.dot(state.estimate);
  state.estimate += (scale * innovation) * Pa;
  const Eigen::Matrix<double, D, D> outer = Pa * Pa.transpose();
  state.cofactor = (state.cofactor - scale * outer) * (1 / forgetting);
}

/// The places of p, k, ln tau and E in a state: d parameters of the law, heat, and the energy now.
struct StatePlaces {
  Eigen::Index d = 0;

  constexpr Eigen::Index gain() const { return d; }
  constexpr Eigen::Index log_time_constant() const { return d + 1; }
  constexpr Eigen::Index energy() const { return d + 2; }
  constexpr Eigen::Index size() const { return d + 3; }
};

/// What is known of (p, k, ln tau, E): the d = D parameters of a linear law, the thermal gain and
/// time constant, and the energy now. D may be Eigen::Dynamic; only then a step allocates.
template <int D>
struct KalmanState {
  static constexpr int kSize = D == Eigen::Dynamic ? D : D + 3;
  Eigen::Matrix<double, kSize, 1> mean;            // [d + 3]
  Eigen::Matrix<double, kSize, kSize> covariance;  // [d + 3 x d + 3]

  StatePlaces places() const { return {mean.size() - StatePlaces().size()}; }
};

/// One sample and the interval that follows it.
template <int D>
struct KalmanSample {
  Eigen::Matrix<double, D, 1> levels;  // [d] g = sign(v) dFn/dp
  double speed = 0;                    // |v|, rad/s or m/s
  double level = 0;                    // sign(v) torque, N.m or N
  bool measured = false;               // whether the torque is friction alone, Eq. (6)
  double step = 0;                     // s until the next sample
};

/// The state at the next sample, and how the measurement compared with what was expected of it.
template <int D>
struct KalmanOutcome {
  KalmanState<D> state;
  double innovation = 0;  // measured less expected level, N.m or N; 0 where not measured
  double variance = 0;    // expected variance of the innovation; 0 where not measured
};

/// Takes in sign(v) tau = g . p + E + noise, which the state enters linearly.
template <int D>
void Correct(const KalmanSample<D>& sample, double noise, KalmanOutcome<D>& outcome) {
  auto& [mean, covariance] = outcome.state;
  const StatePlaces at = outcome.state.places();
  const Eigen::Index d = at.d;
  const Eigen::Matrix<double, KalmanState<D>::kSize, 1> Pa =
      covariance.template leftCols<D>(d) * sample.levels + covariance.col(at.energy());
  outcome.innovation =
      sample.level - sample.levels.dot(mean.template head<D>(d)) - mean[at.energy()];
  outcome.variance = noise + sample.levels.dot(Pa.template head<D>(d)) + Pa[at.energy()];
  mean += (outcome.innovation / outcome.variance) * Pa;
  const auto scaled = ((1 / outcome.variance) * Pa).eval();
  covariance.noalias() -= scaled * Pa.transpose();
}

/// Predicts E over one interval; p, k and ln tau stay.
template <int D>
void Predict(const KalmanSample<D>& sample, KalmanState<D>& state) {
  auto& [mean, covariance] = state;
  const StatePlaces at = state.places();
  const Eigen::Index d = at.d;
  const double gain = mean[at.gain()];
  const ThermalHold<> hold = HoldOver(sample.step, std::exp(mean[at.log_time_constant()]));
  const double energy = mean[at.energy()];
  const double loss = sample.speed * (sample.levels.dot(mean.template head<D>(d)) + energy);

  // the row of E in the Jacobian of the motion; the others are those of the identity
  Eigen::Matrix<double, KalmanState<D>::kSize, 1> row(at.size());
  row.template head<D>(d) = gain * hold.cooling * sample.speed * sample.levels;
  row[at.gain()] = hold.cooling * loss;
  row[at.log_time_constant()] = hold.Slope() * (energy - gain * loss);
  row[at.energy()] = hold.pole + gain * hold.cooling * sample.speed;

  const Eigen::Matrix<double, KalmanState<D>::kSize, 1> cross = covariance * row;
  covariance.row(at.energy()) = cross.transpose();
  covariance.col(at.energy()) = cross;
  covariance(at.energy(), at.energy()) = row.dot(cross);
  mean[at.energy()] = ThermalStep(gain * hold.cooling, hold.pole, energy, loss);
}

/// One step, a pure function of its arguments. First the measurement, where there is one; then the
/// motion
///   E <- te E + k (1 - te) |v| (g . p + E),  te = exp(-h/tau),
/// which are Eqs. (20) and (22) with (19). E has no noise of its own: it follows from the
/// parameters, and the covariance contains this dependence (Ljung 1979: the filter then descends on the
/// prediction error). noise: variance of the torque's noise, (N.m)^2 or N^2.
template <int D>
KalmanOutcome<D> KalmanStep(const KalmanState<D>& state, const KalmanSample<D>& sample,
                            double noise) {
  KalmanOutcome<D> outcome{state};
  if (sample.measured) Correct(sample, noise, outcome);
  Predict(sample, outcome.state);
  return outcome;
}

/// Filters side by side. Given tau, the law, the gain and the energy enter the measurement almost
/// linearly, because the level g . p + E that feeds the losses is itself measured; ln tau does not.
/// So that no filter gets far from the point at which it was linearised, each has a prior of ln tau with a deviation of
/// about the distance to its neighbours, and the data weigh them (a Gaussian sum: Alspach and
/// Sorenson 1972).
template <int D>
struct KalmanBank {
  static constexpr int kMembers = 24;
  std::array<KalmanState<D>, kMembers> members;
  std::array<double, kMembers> log_weight;  // the greatest is 0; -infinity: dropped
  double noise = 0;                         // variance of the torque's noise, as seen so far
  double count = 0;                         // samples that this was computed from
};

/// The start of a bank.
template <int D>
struct KalmanPrior {
  KalmanState<D> state;  // of (p, k, ln tau, E); ln tau is set for each member
  double shortest = 0;   // s, range of time constants; all are taken for equally likely
  double longest = 0;    // s
  double noise = 0;      // a guess of the torque's noise, (N.m)^2 or N^2
};

/// Distance of neighbours in ln tau.
template <int D>
double Spacing(const KalmanPrior<D>& prior) {
  return std::log(prior.longest / prior.shortest) / (KalmanBank<D>::kMembers - 1);
}

template <int D>
KalmanBank<D> MakeBank(const KalmanPrior<D>& prior) {
  constexpr double kOverlap = 0.6;  // deviation over spacing; why 0.6: their sum is flat to 1 %
  KalmanBank<D> bank;
  bank.noise = prior.noise;
  bank.count = 100;  // samples that this guess counts as
  bank.log_weight.fill(0);
  bank.members.fill(prior.state);
  const Eigen::Index at = prior.state.places().log_time_constant();
  for (int i = 0; i < KalmanBank<D>::kMembers; ++i) {
    bank.members[i].mean[at] = std::log(prior.shortest) + i * Spacing(prior);
    bank.members[i].covariance(at, at) = std::pow(kOverlap * Spacing(prior), 2);
  }
  return bank;
}

/// One step of all members, a pure function of its arguments. The weights follow from the
/// likelihood; a member below e^-40 of the best is dropped. The noise's variance is the mean of
/// innovation^2 / expected variance of the best member.
template <int D>
KalmanBank<D> BankStep(KalmanBank<D> bank, const KalmanSample<D>& sample) {
  constexpr double kDropped = -40;  // why: e^-40 of the best is less than rounding
  double best = -std::numeric_limits<double>::infinity();
  double ratio = 1;  // innovation^2 over its expectation, of the best member
  for (int i = 0; i < KalmanBank<D>::kMembers; ++i) {
    double& weight = bank.log_weight[i];
    if (weight < kDropped) continue;
    const KalmanOutcome<D> outcome = KalmanStep(bank.members[i], sample, bank.noise);
    bank.members[i] = outcome.state;
    if (!sample.measured) continue;
    const double square = outcome.innovation * outcome.innovation / outcome.variance;
    weight -= 0.5 * (std::log(outcome.variance) + square);
    if (weight <= best) continue;
    best = weight;
    ratio = square;
  }
  if (!sample.measured) return bank;

  for (double& weight : bank.log_weight) weight -= best;
  bank.count += 1;
  bank.noise += (ratio - 1) * bank.noise / bank.count;
  return bank;
}

/// One state that has the mean and the covariance of the whole bank.
template <int D>
KalmanState<D> Merge(const KalmanBank<D>& bank) {
  KalmanState<D> all = bank.members[0];
  all.mean.setZero();
  all.covariance.setZero();
  double sum = 0;
  for (const double weight : bank.log_weight) sum += std::exp(weight);
  for (int i = 0; i < KalmanBank<D>::kMembers; ++i) {
    all.mean += std::exp(bank.log_weight[i]) / sum * bank.members[i].mean;
  }
  for (int i = 0; i < KalmanBank<D>::kMembers; ++i) {
    const auto away = (bank.members[i].mean - all.mean).eval();
    const double share = std::exp(bank.log_weight[i]) / sum;
    all.covariance += share * (bank.members[i].covariance + away * away.transpose());
  }
  return all;
}

}  // namespace warmjoint
