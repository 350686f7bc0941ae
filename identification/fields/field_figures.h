// What fits with fields report: law, friction at speeds, maps and bands.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/fields/field_block.h"
#include "identification/fields/field_evidence.h"
#include "identification/fit/fit.h"
#include "identification/sentences/fields.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// A solved fit with fields.
struct SolvedFields {
  const FieldRows& rows;
  const std::vector<FieldBlock>& blocks;
  const FieldEvidence& evidence;
  FieldHyperparameters best;
  FieldPosterior posterior;

  /// The values at a block's knots. [m]
  Eigen::VectorXd ValuesOf(size_t block) const {
    return posterior.mean.segment(evidence.Begin(block), blocks[block].size());
  }
};

/// What the fields hold along a log, with the constant torque beside them. p: unknowns of the fit's table; returns [N] N.m or N
Eigen::VectorXd FieldsAlong(const SolvedFields& solved, Eigen::Index p, const LogSamples& m);
/// The friction over time at the rows, unsigned; empty without such a field. [n] N.m or N
Eigen::VectorXd FrictionOverTime(const SolvedFields& solved);
/// The part of it that is of this log alone: the torque over time, and the friction over time about its mean. [N] N.m or N
Eigen::VectorXd DriftAlong(const SolvedFields& solved, const LogSamples& m);

/// Linear functions of the unknowns of a fit with fields.
class FieldFigures {
 public:
  /// fit: the one without fields; m: the motion that it follows. Both and `solved` must outlive this.
  FieldFigures(const SolvedFields& solved, const Fit& fit, const LogSamples& m);

  /// The unknowns of the table as they are reported (WithFields). [p]
  Eigen::VectorXd Reported() const;
  /// These as functions of all unknowns. [p x p + m]
  const Eigen::MatrixXd& report() const { return report_; }
  /// Of these. residual: [n] that the fit with fields leaves; effective: parameters (EffectiveParameters)
  Uncertainty UncertaintyOf(const Eigen::VectorXd& residual, double effective) const;
  /// Adds maps, their bands, and friction at speeds to a fit whose table and model have the reported law.
  void AddTo(double degrees_of_freedom, Fit& fit) const;
  /// Whether friction falls with speed beyond chance: its line is held flat then, and the curve over the speed has the fall.
  bool Falls() const { return falls_; }
  /// rms of each field that holds something, in the order of the blocks, shares of the friction.
  std::vector<FieldShare> Shares(double friction) const;

 private:
  /// Reports the friction at the median speed as a level, where the line falls with all of its interval and friction brakes at all speeds.
  void HoldFlat(double slow, double fast);
  /// The friction at a velocity as a function of all unknowns: law, curve over the speed, and the means of what depends on place and
  /// time. load: |load|, of a friction that grows with it. [p + m]
  Eigen::VectorXd AtVelocity(double velocity, double load) const;
  Eigen::VectorXd OfFields(double speed) const;
  /// Of what depends on place and time, the means over the samples in motion. [p + m]
  Eigen::VectorXd MeansOfFields() const;
  /// dE/dx at the kept sample with the largest |E|, and E. [p + m]
  struct WarmMoment {
    double energy = 0;  // N.m or N
    Eigen::VectorXd function;
  };
  std::optional<WarmMoment> Warmest(const Fit& fit) const;
  void AddFriction(double reach, Fit& fit) const;
  void AddPlaces(double reach, Fit& fit) const;
  void AddCurve(double reach, Fit& fit) const;
  void AddMap(FrictionMap map, const Eigen::MatrixXd& functions, double reach, Fit& fit) const;
  double Deviation(const Eigen::VectorXd& function) const;
  /// The covariance of all unknowns up to each part of an error: that of the best strengths where what comes later is known. [p + m]^2 each
  std::vector<ErrorUpTo<Eigen::MatrixXd>> CovariancesUpTo() const;
  bool Holds(FieldKind kind) const;
  /// Whether a torque that is the same in both directions is there beyond chance, in addition to gravity. place_torque: the block over the position
  bool HasConstant(size_t place_torque) const;

  const SolvedFields& solved_;
  const Fit& fit_;
  const LogSamples& m_;
  bool falls_ = false;
  std::vector<FieldKind> held_;  // of the fields that are there beyond chance, and that maps give
  Eigen::VectorXd means_;        // MeansOfFields
  Eigen::MatrixXd report_;       // [p x p + m]
  std::vector<ErrorUpTo<Eigen::MatrixXd>> up_to_;  // CovariancesUpTo
};

}  // namespace warmjoint
