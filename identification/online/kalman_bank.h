// A bank of Kalman filters, each around a time constant of its own.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "identification/online/kalman_step.h"

namespace warmjoint {

/// Filters side by side. Given tau, the law, the gain and the energy enter the measurement almost
/// linearly, because the level g . p + E that feeds the losses is itself measured; ln tau does not.
/// So that no filter ever strays from where it was linearised, each knows ln tau beforehand to
/// about the distance to its neighbours, and the data weigh them (a Gaussian sum: Alspach and
/// Sorenson 1972).
template <int D>
struct KalmanBank {
  static constexpr int kMembers = 24;
  std::array<KalmanState<D>, kMembers> members;
  std::array<double, kMembers> log_weight;  // the greatest is 0; -infinity: dropped
  double noise = 0;                         // variance of the torque's noise, as seen so far
  double count = 0;                         // samples that this stands on
};

/// Where a bank begins.
template <int D>
struct KalmanPrior {
  KalmanState<D> state;     // of (p, k, ln tau, E); ln tau is set for each member
  double shortest = 0;      // s, range of time constants; all are taken for equally likely
  double longest = 0;       // s
  double noise = 0;         // a guess of the torque's noise, (N.m)^2 or N^2
  double confidence = 100;  // samples that this guess counts as
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
  bank.count = prior.confidence;
  bank.log_weight.fill(0);
  bank.members.fill(prior.state);
  const Eigen::Index at = prior.state.mean.size() - 2;
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
