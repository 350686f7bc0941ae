#include "identification/model/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "identification/forward/row_products.h"
#include "identification/model/model_squares.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kSamples = 700;  // of some stretches

/// A motion with uneven samples, turns and a second recording.
struct Motion {
  VectorXd time{kSamples}, velocity{kSamples}, shown{kSamples};

  Motion() {
    double t = 0;
    for (Index i = 0; i < kSamples; ++i) {
      t += i % 7 == 0 ? .05 : .02;
      time[i] = t;
      velocity[i] = std::sin(2 * t) + .3 * std::sin(5 * t);
      // as a filter of the torque would show the direction
      shown[i] = std::tanh(5 * velocity[i]);
    }
  }
};

/// All kinds of blocks with heat, E(0) and a jump.
Model EveryBlock() {
  const Motion m;
  Model model;
  model.samples = kSamples;
  model.table.resize(12);
  const VectorXd sign = m.velocity.cwiseSign();
  MatrixXd law(kSamples, 2), of_losses(kSamples, 2), directions(kSamples, 2);
  law << m.velocity, m.shown;
  of_losses << .9 * m.velocity, sign;
  directions << m.time.array().sin().matrix(), (2 * m.time).array().cos().matrix();
  const GivenForce given{(.7 * m.time).array().sin().matrix() * 3, directions};
  const GivenPlaces at{3, -1, {4, 2}};
  model.blocks = {
      std::make_shared<FrictionBlock>(Slice{0, 2}, Shared(law), Shared(of_losses)),
      std::make_shared<LoadBlock>(2, at, given, LoadBlock::Directions{m.shown, sign}),
      std::make_shared<GivenBlock>(at, given),
      std::make_shared<LinearBlock>(Slice{6, 1}, Shared(m.velocity.cwiseAbs2())),
  };
  model.heat = HeatLoop{.loop = std::make_shared<const ClosedLoop>(
                            m.time, m.velocity, MatrixXd(kSamples, 0), std::vector<Index>{400}),
                        .direction = m.shown,
                        .friction = 6,
                        .parameters = {7, 2},
                        .start = {9, 1},
                        .jump_samples = {250, kSamples - 1},
                        .jumps = {10, 2}};
  return model;
}

VectorXd SomePoint() {
  VectorXd x(12);
  x << 2, 5, .1, .2, .3, -.4, .5, -.3, std::log(3.0), -.6, .4, .2;
  return x;
}

/// d f/dx_i about x by central differences.
template <typename Value>
Value SlopeBy(Index i, const VectorXd& x, const std::function<Value(const VectorXd&)>& f) {
  VectorXd more = x, less = x;
  more[i] += 1e-5;
  less[i] -= 1e-5;
  return (f(more) - f(less)) / 2e-5;
}

TEST(Model, DerivativesAreThoseOfItsForce) {
  const Model model = EveryBlock();
  const VectorXd x = SomePoint();
  const ModelRows rows = ModelAt(model, x).All();
  for (Index i = 0; i < x.size(); ++i) {
    const VectorXd slope =
        SlopeBy<VectorXd>(i, x, [&](const VectorXd& at) { return ModelAt(model, at).All().force; });
    // central differences: 1e-10 of the third derivative, and rounding over the step
    EXPECT_LT((slope - rows.derivatives.col(i)).cwiseAbs().maxCoeff(),
              1e-7 * std::max(1.0, slope.cwiseAbs().maxCoeff()))
        << i;
  }
}

TEST(Model, EndsWithTheHeatOfItsLastSample) {
  const Model model = EveryBlock();
  const VectorXd x = SomePoint();
  const HeatState end = ModelAt(model, x).End();
  EXPECT_NEAR(end.energy, ModelAt(model, x).Energy()[kSamples - 1], 1e-14);
  for (Index i = 0; i < x.size(); ++i) {
    const double slope =
        SlopeBy<double>(i, x, [&](const VectorXd& at) { return ModelAt(model, at).End().energy; });
    EXPECT_NEAR(end.slopes[i], slope, 1e-7 * std::max(1.0, std::abs(slope))) << i;
  }
}

TEST(ModelSquares, AreThoseOfAllRowsWithWeightsAndPriors) {
  Model model = EveryBlock();
  model.table[8].prior = Normal{1, .5};
  model.groups = {Alike(0, 2, .25)};
  const VectorXd x = SomePoint();
  ModelSamples samples{.torque = VectorXd::LinSpaced(kSamples, -4, 7),
                       .keep = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(kSamples, true),
                       .weights = VectorXd::LinSpaced(kSamples, .1, 1)};
  samples.keep.segment(100, 60) = false;
  const RowSums sums = ModelSquares(model, samples).At(x, 2);

  const ModelRows rows = ModelAt(model, x).All();
  const VectorXd weights = samples.weights.array() * samples.keep.cast<double>() / 2;
  const VectorXd left = samples.torque - rows.force;
  MatrixXd gram = rows.derivatives.transpose() * weights.asDiagonal() * rows.derivatives;
  VectorXd product = rows.derivatives.transpose() * weights.cwiseProduct(left);
  gram(8, 8) += 4;
  product[8] -= 4 * (x[8] - 1);
  // the difference of the first and the third over .25
  VectorXd difference = VectorXd::Zero(x.size());
  difference[0] = 4;
  difference[2] = -4;
  const double apart = difference.dot(x);
  gram += difference * difference.transpose();
  product -= apart * difference;
  const double squares =
      left.cwiseAbs2().dot(weights) + 4 * (x[8] - 1) * (x[8] - 1) + apart * apart;
  EXPECT_LT((sums.gram - gram).norm(), 1e-12 * gram.norm());
  EXPECT_LT((sums.product - product).norm(), 1e-12 * product.norm());
  EXPECT_NEAR(sums.squares, squares, 1e-12 * squares);
}

TEST(KeptRows, AreThoseOfTheSamplesThatCount) {
  const Model model = EveryBlock();
  const VectorXd x = SomePoint();
  Eigen::Array<bool, Eigen::Dynamic, 1> keep(kSamples);
  for (Index i = 0; i < kSamples; ++i) keep[i] = i % 3 != 1 && (i < 300 || i > 580);
  const ModelRows all = ModelAt(model, x).All();
  std::vector<Index> kept;
  for (Index i = 0; i < kSamples; ++i) {
    if (keep[i]) kept.push_back(i);
  }
  const KeptRows rows(model, x, keep);
  const auto count = std::ssize(kept);
  for (const auto& [first, last] :
       {std::pair<Index, Index>(0, count), {50, 51}, {190, 250}, {7, 7}}) {
    const std::vector<Index> these(kept.begin() + first, kept.begin() + last);
    EXPECT_EQ(rows.Between(first, last), MatrixXd(all.derivatives(these, Eigen::all)))
        << first << " to " << last;
  }
}

TEST(RowProducts, AreThoseOfTheRowsForAnyNumberOfColumns) {
  for (Index p = 1; p <= 20; ++p) {
    const MatrixXd rows = MatrixXd::Random(301, p);
    RowProducts products(p);
    for (const auto& row : rows.rowwise()) products.Next() = row;
    const MatrixXd expected = rows.transpose() * rows;
    EXPECT_LT((products.Sums() - expected).norm(), 1e-13 * expected.norm()) << p;
  }
}

}  // namespace
}  // namespace warmjoint
