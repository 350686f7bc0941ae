#include "identification/maps/anderson_mixing.h"

#include <Eigen/QR>

namespace warmjoint {
namespace {

// rounds; why four: three differences, one for each way in which a warming is mistaken for a map (how far, how soon, from
// where), span what converges slowly. The fixed point does not depend on it
constexpr size_t kRemembered = 4;

}  // namespace

Eigen::VectorXd AndersonMixing::Next(const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
  rounds_.push_back({g - x, g});
  if (rounds_.size() > kRemembered) rounds_.pop_front();
  const auto differences = static_cast<Eigen::Index>(rounds_.size()) - 1;
  if (differences == 0) return g;

  // each round against the one before it
  Eigen::MatrixXd of_residual(g.size(), differences), of_image(g.size(), differences);
  for (Eigen::Index i = 0; i < differences; ++i) {
    const Round& before = rounds_[static_cast<size_t>(i)];
    const Round& after = rounds_[static_cast<size_t>(i) + 1];
    of_residual.col(i) = after.residual - before.residual;
    of_image.col(i) = after.image - before.image;
  }
  // the combination of the differences that comes nearest to the latest residual
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(of_residual);
  Eigen::VectorXd next = g - of_image * solver.solve(rounds_.back().residual);
  return next.allFinite() ? next : g;
}

}  // namespace warmjoint
