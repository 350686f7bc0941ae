// Rows of a least-squares problem whose noise is coloured, made white.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "identification/forward/row_products.h"
#include "identification/uncertainty/noise_model.h"

namespace warmjoint {

/// Whether the sign of a residual turns with the direction of motion, as that of friction which a model lacks does and
/// that of noise does not: the means of runs of one direction differ in sign from run to run
/// more often than half of the times, by more than three deviations (a sign test). Returns nothing where there are
/// fewer than nine changes of direction, which are too few to decide. residual, velocity: [n]
std::optional<bool> TurnsWithDirection(const Eigen::VectorXd& residual,
                                       const Eigen::VectorXd& velocity);

/// The places of the kept samples in time, in sampling intervals (the median step between neighbours
/// that are kept): ascending from 0. Samples that preparation put in between take no place. A gap,
/// or the start of another recording, counts a thousand intervals at most, or exactly. [n]
std::vector<Eigen::Index> PlacesInTime(const LogSamples& measurements, const Selection& selection);

/// W with W R W^T = s^2 I, R the covariance of the noise at the rows and s^2 its innovation: row i
/// less its best prediction from the rows before, times s over the error of that. Of p rows before,
/// p the order of the noise (Vecchia 1988): exact where all of them are neighbours, and for AR(1)
/// across any gap; otherwise the prediction is by the covariances of the rows that are left.
class Whitening final : public RowTransform {
 public:
  /// noise: of order 1 or more, over places; places: [n] ascending.
  Whitening(NoiseModel noise, const std::vector<Eigen::Index>& places);

  void Apply(Rows& rows) const override;
  Eigen::Index size() const override { return static_cast<Eigen::Index>(which_.size()); }

  const NoiseModel& noise() const { return noise_; }

 private:
  /// How a row is predicted from those before it.
  struct Predictor {
    Eigen::RowVectorXd weights;  // [m] of the m rows before, the farthest first
    double scale = 1;            // s over the deviation of what is left
  };
  Predictor Solve(const std::vector<Eigen::Index>& lags, const Eigen::VectorXd& covariances) const;

  NoiseModel noise_;
  std::vector<Predictor> predictors_;
  std::vector<int> which_;  // [n] of them
};

/// The whitening of a fit whose residual is coloured beyond doubt (IsSurelyColoured); nothing where
/// it may be white. residual: [n] over the kept samples, N.m or N.
std::shared_ptr<const Whitening> WhiteningFor(const Eigen::VectorXd& residual,
                                              const LogSamples& measurements,
                                              const Selection& selection);

}  // namespace warmjoint
