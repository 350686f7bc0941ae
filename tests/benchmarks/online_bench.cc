// Time of one online step, on one core.
#include <benchmark/benchmark.h>

#include <cmath>

#include "identification/online/kalman_bank.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

/// One step of rls with 8 parameters; regressors of 1024 samples in turn.
void RecursiveLeastSquares(benchmark::State& state) {
  constexpr int kParameters = 8;
  RandomStream random({1, 0}, Stream::test);
  Eigen::Matrix<double, kParameters, 1024> rows;
  for (double& entry : rows.reshaped()) entry = random.Normal();
  auto known = KnowNothing<kParameters>(kParameters, 1e8);
  Eigen::Index i = 0;
  for (auto _ : state) {
    TakeIn<kParameters>(rows.col(i), rows(0, i), 0.999, known);
    i = (i + 1) % 1024;
    benchmark::DoNotOptimize(known);
  }
}

KalmanPrior<2> SomePrior() {
  KalmanPrior<2> prior;
  prior.state.mean << 5, 15, -3, std::log(600.0), 0;
  prior.state.covariance.setIdentity();
  prior.shortest = 100;
  prior.longest = 3600;
  prior.noise = 0.25;
  return prior;
}

KalmanSample<2> SampleAt(int i) {
  const double speed = 0.1 + 0.009 * (i % 100);
  return {Eigen::Vector2d(speed, 1), speed, 5 * speed + 15, true, 1};
}

/// One filter around one time constant: 5 states.
void KalmanFilterStep(benchmark::State& state) {
  KalmanState<2> known = SomePrior().state;
  int i = 0;
  for (auto _ : state) {
    known = KalmanStep(known, SampleAt(++i), 0.25).state;
    benchmark::DoNotOptimize(known);
  }
}

/// The whole bank, none of its members dropped yet.
void KalmanBankStep(benchmark::State& state) {
  KalmanBank<2> bank = MakeBank(SomePrior());
  int i = 0;
  for (auto _ : state) {
    bank.log_weight.fill(0);
    bank = BankStep(bank, SampleAt(++i));
    benchmark::DoNotOptimize(bank);
  }
}

BENCHMARK(RecursiveLeastSquares);
BENCHMARK(KalmanFilterStep);
BENCHMARK(KalmanBankStep);

}  // namespace
}  // namespace warmjoint
