// Ridge regression of 25 000 samples on 720 kernels, 5 folds x 20 strengths, against the same
// written plainly with Eigen; and normal equations of 1 and 10 million samples in bounded memory.
// Both sides start from the samples and end with 20 cross-validation errors.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "identification/linear/linear_laws.h"
#include "identification/ridge/local_rows.h"
#include "tests/support/cross_validate.h"

namespace warmjoint {
namespace {

constexpr int kFolds = 5;

/// A joint that travels between its limits and warms: 40 x 6 x 3 kernels over P x V x E.
struct Problem {
  std::vector<FrictionMap> maps;
  MapPoints points;      // [n x 5]
  Eigen::MatrixXd free;  // [n x 2]
  Eigen::VectorXd y;     // [n] N.m
  std::vector<double> strengths;
};

/// first: number of its first sample in the recording.
Problem MakeProblem(Eigen::Index n, Eigen::Index first = 0) {
  Problem problem;
  problem.maps = {{{{MapQuantity::position, EvenAxis(-1, 1, 40)},
                    {MapQuantity::velocity, SpeedAxis(0.3, 2, 3)},
                    {MapQuantity::energy, EvenAxis(-0.3, 0, 3)}},
                   KernelKind::normalised,
                   {}}};
  problem.points = MapPoints::Zero(n, 5);
  problem.y.resize(n);
  const double speeds[] = {0.3, 0.6, 1, 1.5, 2};
  double position = -1, direction = 1;
  int sweep = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = direction * speeds[(sweep / 2) % 5];
    const double energy = -0.3 * (1 - std::exp(-static_cast<double>(first + i) / 5000));
    problem.points.row(i) << position, 0, v, energy, 0;
    // a deterministic stand-in for noise
    problem.y[i] = 0.05 * v + direction * (0.5 + energy) + 0.05 * std::sin(9 * position) +
                   0.01 * std::sin(1e4 * std::sin(static_cast<double>(first + i)));
    position += 0.05 * v;
    if (std::abs(position) > 1) {
      position = std::copysign(1, position);
      direction = -direction;
      ++sweep;
    }
  }
  problem.free = LawColumns(*FindLaw("viscous_coulomb"), problem.points.col(2));
  for (int i = 0; i < 20; ++i) problem.strengths.push_back(std::pow(10, -3 + 0.3 * i));
  return problem;
}

Eigen::Index Begin(Eigen::Index n, int fold) { return n * fold / kFolds; }

/// Calls work(fold) for all folds on so many threads.
void ForFolds(int threads, const std::function<void(int)>& work) {
  std::vector<std::jthread> helpers;
  for (int t = 0; t < threads; ++t) {
    helpers.emplace_back([&, t] {
      for (int fold = t; fold < kFolds; fold += threads) work(fold);
    });
  }
}

Eigen::VectorXd Ours(const Problem& problem, int threads) {
  const Eigen::Index n = problem.y.size();
  std::vector<NormalEquations> parts(kFolds, NormalEquations(722));
  ForFolds(threads, [&](int fold) {
    parts[fold] = LocalNormal(problem.maps, problem.points, problem.free, problem.y, Begin(n, fold),
                              Begin(n, fold + 1));
  });
  return test::CrossValidate(parts, 2, problem.strengths, threads);
}

/// All rows, dense.
Eigen::MatrixXd DenseRows(const Problem& problem) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(problem.y.size(), 722);
  A.leftCols(2) = problem.free;
  for (const RowGroup& group : GroupRows(problem.maps, problem.points, 0, problem.y.size())) {
    for (size_t i = 0; i < group.samples.size(); ++i) {
      for (size_t k = 0; k < group.kernels.size(); ++k) {
        A(group.samples[i], 2 + group.kernels[k]) = group.values(i, k);
      }
    }
  }
  return A;
}

/// Gram matrix of the kernels beside the free columns, its eigendecomposition, 20 strengths.
Eigen::VectorXd SquaresByEigen(const NormalEquations& rest, const NormalEquations& part,
                               const std::vector<double>& strengths) {
  const Eigen::Index q = rest.product.size() - 2;
  const Eigen::LLT<Eigen::MatrixXd> corner(rest.gram.topLeftCorner(2, 2));
  const Eigen::MatrixXd slopes = corner.solve(rest.gram.topRightCorner(2, q));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      rest.gram.bottomRightCorner(q, q) - rest.gram.bottomLeftCorner(q, 2) * slopes);
  const Eigen::VectorXd right = eigen.eigenvectors().transpose() *
                                (rest.product.tail(q) - slopes.transpose() * rest.product.head(2));
  Eigen::VectorXd squares(strengths.size());
  for (size_t i = 0; i < strengths.size(); ++i) {
    const Eigen::VectorXd scaled =
        (right.array() / (eigen.eigenvalues().array() + strengths[i])).matrix();
    Eigen::VectorXd x(q + 2);
    x.tail(q) = eigen.eigenvectors() * scaled;
    x.head(2) = corner.solve(rest.product.head(2)) - slopes * x.tail(q);
    squares[static_cast<Eigen::Index>(i)] = part.Squares(x);
  }
  return squares;
}

enum class Grams { of_each_training_part, of_folds };

/// The plain way: dense rows; a Gram matrix for each training part, or, in place of that, one for
/// each fold and differences of them.
Eigen::VectorXd Plain(const Problem& problem, int threads, Grams grams) {
  const Eigen::MatrixXd A = DenseRows(problem);
  const Eigen::Index n = A.rows();
  std::vector<NormalEquations> parts(kFolds, NormalEquations(722));
  const auto add = [&](Eigen::Index first, Eigen::Index last, NormalEquations& normal) {
    if (first == last) return;
    const auto rows = A.middleRows(first, last - first);
    const auto y = problem.y.segment(first, last - first);
    normal.gram.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
    normal.gram.triangularView<Eigen::StrictlyUpper>() = normal.gram.transpose();
    normal.product += rows.transpose() * y;
    normal.squares += y.squaredNorm();
    normal.rows += y.size();
  };
  ForFolds(threads, [&](int fold) { add(Begin(n, fold), Begin(n, fold + 1), parts[fold]); });
  NormalEquations all = parts[0];
  for (int fold = 1; fold < kFolds; ++fold) all = all.Plus(parts[fold]);

  std::vector<Eigen::VectorXd> squares(kFolds);
  ForFolds(threads, [&](int fold) {
    NormalEquations rest(722);
    if (grams == Grams::of_folds) {
      rest = all.Minus(parts[fold]);
    } else {
      add(0, Begin(n, fold), rest);
      add(Begin(n, fold + 1), n, rest);
    }
    squares[fold] = SquaresByEigen(rest, parts[fold], problem.strengths);
  });
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(20);
  for (const Eigen::VectorXd& part : squares) errors += part;
  return errors / static_cast<double>(n);
}

const Problem& Shared() {
  static const Problem problem = MakeProblem(25000);
  return problem;
}

void Local(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(0));
  Eigen::VectorXd errors;
  for (auto _ : state) errors = Ours(Shared(), threads);
  static const Eigen::VectorXd expected = Plain(Shared(), 2, Grams::of_each_training_part);
  state.counters["error"] = ((errors - expected).array() / expected.array()).abs().maxCoeff();
}
BENCHMARK(Local)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void PlainEigen(benchmark::State& state, Grams grams) {
  const int threads = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Plain(Shared(), threads, grams));
}
BENCHMARK_CAPTURE(PlainEigen, gram_of_each_training_part, Grams::of_each_training_part)
    ->Arg(1)
    ->Arg(2)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(PlainEigen, gram_of_each_fold, Grams::of_folds)
    ->Arg(1)
    ->Arg(2)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Normal equations of so many samples that are made as they are taken up, 25 000 at a time. The
/// peak of the memory is that of the whole process: run it alone, --benchmark_filter=Streaming.
void Streaming(benchmark::State& state) {
  const Eigen::Index n = state.range(0), piece = 25000;
  for (auto _ : state) {
    NormalEquations normal(722);
    for (Eigen::Index done = 0; done < n; done += piece) {
      const Problem now = MakeProblem(piece, done);
      AddGroups(GroupRows(now.maps, now.points, 0, piece), now.free, now.y, normal);
    }
    benchmark::DoNotOptimize(normal);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024;
  state.SetItemsProcessed(n * state.iterations());
}

}  // namespace
}  // namespace warmjoint

BENCHMARK(warmjoint::Streaming)
    ->Arg(1000000)
    ->Arg(10000000)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);
