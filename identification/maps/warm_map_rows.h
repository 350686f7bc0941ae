// Rows of the derivatives of law, maps and heat together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/forward/closed_loop.h"
#include "identification/forward/log_trajectory.h"
#include "identification/identifier.h"
#include "identification/layout.h"
#include "identification/linear/linear_laws.h"

namespace warmjoint {

/// The parts of law, maps and heat.
struct WarmMapParts {
  const Law& law;
  std::vector<FrictionMap> maps{};           // shapes
  Eigen::MatrixXd rigid{};                   // [N x r] of gravity and inertia
  std::vector<Eigen::Index> jump_samples{};  // [J] where E jumps
  Layout layout{};                           // law, rigid, weights, heat, start, jumps
};

/// Rows d(F + G + M a)/dx at the kept samples, made block by block along the log: all of them at once are far larger than it.
/// For a gain and a time constant the force is linear in all other unknowns, so that the rows give it as well.
class WarmMapRows {
 public:
  /// input: must outlive this.
  WarmMapRows(const IdentifierInput& input, WarmMapParts parts);

  /// Sums the rows' products at x, [p].
  void MoveTo(const Eigen::VectorXd& x);

  const Layout& layout() const { return parts_.layout; }
  const Eigen::MatrixXd& gram() const { return gram_; }  // [p x p]
  const Eigen::VectorXd& product() const {
    return product_;
  }                                                          // [p] with what is left of the torque
  const Eigen::VectorXd& torque() const { return torque_; }  // [n] N.m or N
  double squares() const { return squares_; }                // of that, (N.m)^2 or N^2

  /// dE/dx at the end of the log, [p].
  Eigen::VectorXd OfEnd() const;
  /// Rows first <= i < last of the kept samples. [last - first x p]
  Eigen::MatrixXd Between(Eigen::Index first, Eigen::Index last) const;
  /// E along the log, [N] N.m or N.
  Eigen::VectorXd Energy() const;

 private:
  static constexpr Eigen::Index kBlock = 4096;  // samples

  /// The loop where a block begins.
  struct Begin {
    Eigen::Index sample;
    LoopEnd at;
  };

  /// Rows of all samples first <= n < last, in the order of the loop: law, weights, k, log tau, E0, jumps, then gravity and
  /// inertia, which make no heat.
  /// at: of the loop at the first, led on to the last; [last - first x d + q + 3 + J + r]
  ClosedLoop::Rows Along(Eigen::Index first, Eigen::Index last, LoopEnd& at) const;
  double InitialEnergy() const;

  const LogSamples& m_;
  WarmMapParts parts_;
  MapPoints points_;                 // [N x 5]
  Eigen::MatrixXd law_;              // [N x d]
  Eigen::MatrixXd of_loss_;          // [N x d], or empty where the losses have the same
  ClosedLoop loop_;                  // without columns of its own
  std::vector<Eigen::Index> kept_;   // [n] samples
  Eigen::VectorXd torque_;           // [n] N.m or N
  std::vector<Eigen::Index> order_;  // [p] places of the layout's unknowns in the order of the loop
  Eigen::Index loop_size_;           // d + q + 3 + J
  Eigen::VectorXd x_;                // [p] at which the others are
  std::vector<Begin> begins_;
  Eigen::MatrixXd gram_;
  Eigen::VectorXd product_;
  double squares_ = 0;
};

}  // namespace warmjoint
