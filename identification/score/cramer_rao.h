// The smallest standard deviation that an unbiased estimate can have.
#pragma once

#include <warmjoint/prepared_log.h>
#include <warmjoint/simulation.h>

#include <Eigen/Core>

namespace warmjoint {

/// Cramer-Rao standard deviations in both parametrisations of the warming.
struct CramerRao {
  Eigen::VectorXd continuous;   // [d + 2 or d] law, k, tau
  Eigen::VectorXd discrete;     // [d + 2 or d] law, ke, te
  Eigen::MatrixXd information;  // of law, k, tau and, where it is estimated, E(0)
};

/// Whether the initial energy counts as known.
enum class KnownInitialEnergy { yes, no };

/// sqrt(diag(I^-1)), I = J^T R^-1 J over the kept samples, J = dF/d(parameters) of the closed loop at
/// the truth and R the covariance of the noise: sigma^2 = truth.torque_noise^2 in all, of which
/// truth.coloured_noise^2 exp(-|t|/truth.correlation_time) is autocorrelated and the rest is white. NaN where the bound does
/// not exist: no noise, parameters that the motion cannot distinguish, or a law that is not linear.
/// nuisance: [N x q] further columns of J, of parameters that are unknown too and get no bound.
/// step: sampling interval of the discrete pair, s.
CramerRao CramerRaoBound(const LogSamples& measurements, const Selection& selection,
                         const Truth& truth, KnownInitialEnergy initial_energy, double step,
                         const Eigen::MatrixXd& nuisance = {});

}  // namespace warmjoint
