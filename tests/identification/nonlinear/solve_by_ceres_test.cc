#include "identification/nonlinear/solve_by_ceres.h"

#include <ceres/autodiff_cost_function.h>
#include <gtest/gtest.h>

#include <limits>

namespace warmjoint {
namespace {

/// r = (log(a) - 1, b - a), which has no value for a < 0; least at a = b = e.
struct Logarithm {
  template <typename T>
  bool operator()(const T* x, T* r) const {
    using std::log;
    r[0] = log(x[0]) - 1.0;
    r[1] = x[1] - x[0];
    return true;
  }
};

std::unique_ptr<ceres::CostFunction> Cost() {
  return std::make_unique<ceres::AutoDiffCostFunction<Logarithm, 2, 2>>(new Logarithm);
}

/// The solution from a start, and that nothing was printed on the way.
CeresSolution<2> SolveQuietly(double* x, const std::vector<int>& constant = {}) {
  ::testing::internal::CaptureStderr();
  CeresSolution<2> solution = SolveByCeres<2>(Cost(), constant, x);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  return solution;
}

TEST(SolveByCeres, StepsBackFromWhereThereIsNoValue) {
  double x[] = {20, 0};  // the first Gauss-Newton step would lead to a < 0
  const CeresSolution<2> solution = SolveQuietly(x);
  EXPECT_TRUE(solution.converged);
  // 1e-9: gradients of 1e-14 over derivatives of 1/e to 1, with room
  EXPECT_NEAR(x[0], std::exp(1), 1e-9);
  EXPECT_NEAR(x[1], std::exp(1), 1e-9);
  EXPECT_NEAR(solution.jacobian(0, 0), std::exp(-1), 1e-9);
}

TEST(SolveByCeres, HoldsWhatIsConstant) {
  double x[] = {2, 5};
  EXPECT_TRUE(SolveQuietly(x, {1}).converged);
  EXPECT_EQ(x[1], 5);
  EXPECT_GT(x[0], std::exp(1));
}

TEST(SolveByCeres, DoesNotConvergeFromWhereThereIsNoValueAndPrintsNothing) {
  for (const double a : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    double x[] = {a, 0};
    EXPECT_FALSE(SolveQuietly(x).converged) << a;
  }
}

}  // namespace
}  // namespace warmjoint
