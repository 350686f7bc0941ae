#include "identification/linear/linear_laws.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace warmjoint {

bool IsLinear(const Law& law) {
  // a law with a parameter that steady sliding does not show cannot be fitted
  const size_t d = law.parameters.size();
  std::vector<double> p(d), q(d), sum(d);
  for (size_t i = 0; i < d; ++i) {
    std::vector<double> unit(d, 0.0);
    unit[i] = 1;
    if (law.force(1, unit.data()) == 0 && law.force(-1, unit.data()) == 0) return false;
  }

  // two sets of parameters, and one that is the first and twice the second
  for (size_t i = 0; i < d; ++i) {
    p[i] = 1.0 + 0.37 * static_cast<double>(i);
    q[i] = 0.6 + 0.23 * static_cast<double>(i * i);
    sum[i] = p[i] + 2 * q[i];
  }

  // F(p + 2 q) = F(p) + 2 F(q), up to rounding
  for (const double v : {-3.0, -0.4, -0.01, 0.02, 0.7, 5.0}) {
    const double together = law.force(v, sum.data());
    const double apart = law.force(v, p.data()) + 2 * law.force(v, q.data());
    if (!(std::abs(together - apart) <= 1e-12 * (std::abs(together) + std::abs(apart)))) {
      return false;
    }
  }
  return true;
}

std::span<const Word<LinearLaw>> WordsOf(LinearLaw) {
  static const std::vector<Word<LinearLaw>> words = [] {
    std::vector<Word<LinearLaw>> linear;
    for (const Law& law : Laws()) {
      if (IsLinear(law)) linear.push_back({law.name, {&law}});
    }
    return linear;
  }();
  return words;
}

Eigen::MatrixXd LawColumns(const Law& law, const Eigen::VectorXd& velocity) {
  const auto d = static_cast<Eigen::Index>(law.parameters.size());
  Eigen::MatrixXd columns(velocity.size(), d);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(d);

  // the law with one parameter of 1 and all others of 0; samples of one segment share their speed
  for (Eigen::Index begin = 0, end = 0; begin < velocity.size(); begin = end) {
    while (end < velocity.size() && velocity[end] == velocity[begin]) ++end;
    end = std::max(end, begin + 1);
    for (Eigen::Index i = 0; i < d; ++i) {
      unit[i] = 1;
      columns.col(i)
          .segment(begin, end - begin)
          .setConstant(law.force(velocity[begin], unit.data()));
      unit[i] = 0;
    }
  }
  return columns;
}

Eigen::MatrixXd WithLoad(Eigen::MatrixXd of_law, PartFit load, const Eigen::VectorXd& velocity,
                         const std::optional<Eigen::VectorXd>& carried) {
  if (load == PartFit::none) return of_law;
  assert(carried);
  of_law.conservativeResize(Eigen::NoChange, of_law.cols() + 1);
  of_law.rightCols(1) = carried->cwiseAbs().cwiseProduct(velocity.cwiseSign());
  return of_law;
}

Eigen::MatrixXd NominalColumns(const Law& law, PartFit load, const LogSamples& m,
                               const Eigen::VectorXd& velocity) {
  return WithLoad(LawColumns(law, velocity), load, velocity, m.load);
}

Eigen::MatrixXd LossColumns(const Law& law, const LogSamples& m, PartFit load) {
  return m.loss_velocity ? NominalColumns(law, load, m, *m.loss_velocity) : Eigen::MatrixXd();
}

}  // namespace warmjoint
