#include "identification/adequacy/fading.h"

#include "identification/adequacy/growing_fit.h"
#include "identification/fit_data.h"

namespace warmjoint::inline identification {

std::optional<Structure> FindFading(const FittedModel& model, Eigen::VectorXd& residual) {
  if (!model.maps || !model.knows_warming) return std::nullopt;
  const Selection& selection = model.selection;
  const Eigen::MatrixXd maps = Kept(*model.maps, selection);
  const Eigen::MatrixXd left = Kept(residual, selection);
  const Block steady{Dependence::position, maps};
  const Block fading{Dependence::position_by_energy,
                     maps.cwiseProduct(Kept(model.energy, selection))};
  GrowingFit fit(Eigen::VectorXd::Ones(left.rows()), left, Kept(model.derivatives, selection),
                 selection, {steady, fading});
  fit.Take(steady);
  std::optional<Structure> found = fit.Test(fading);
  if (!found) return std::nullopt;

  fit.Take(fading);
  const Eigen::VectorXd explained = fit.Explained();
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (selection.keep[i]) residual[i] -= explained[row++];
  }
  return found;
}

}  // namespace warmjoint::inline identification
