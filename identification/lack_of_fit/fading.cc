#include "identification/lack_of_fit/fading.h"

#include "identification/fit_data.h"

namespace warmjoint {

Finding TestFading(const FittedModel& model, Eigen::VectorXd& residual, ErrorLevel& level) {
  Finding finding;
  finding.test = FindLackOfFitTest("position_by_energy");
  finding.reason = finding.test->absent;
  if (!model.maps || !model.thermal) return finding;

  // beside maps whose strength is free
  const Selection& selection = model.selection;
  const Eigen::MatrixXd maps = Kept(*model.maps, selection);
  const Eigen::MatrixXd left = Kept(residual, selection);
  const Features steady{maps}, fading{maps.cwiseProduct(Kept(model.energy, selection))};
  GrowingFit fit(Eigen::VectorXd::Ones(left.rows()), left, Kept(model.derivatives, selection),
                 selection);
  fit.LearnNoise({steady, fading});
  fit.Take(steady);
  finding = fit.Test(fading);
  finding.test = FindLackOfFitTest("position_by_energy");
  finding.p_adjusted = level.Adjusted(finding.p);
  if (finding.explained <= 0 || !level.Rejects(finding.p)) return finding;

  // taken off the residual
  finding.rejected = true;
  fit.Take(fading);
  const Eigen::VectorXd explained = fit.Explained();
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (selection.keep[i]) residual[i] -= explained[row++];
  }
  return finding;
}

}  // namespace warmjoint
