// A torque as a sum of blocks over one table of unknowns: what fills the rows of a fit.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "identification/layout.h"
#include "identification/model/unknown.h"

namespace warmjoint {

/// Force of a model over N samples, and its derivatives by the P unknowns.
struct ModelRows {
  Eigen::VectorXd force;        // [N] in the torque's unit
  Eigen::MatrixXd derivatives;  // [N x P]
};

/// A part of the torque.
class Block {
 public:
  virtual ~Block() = default;
  /// Adds the part's force and derivatives. x: [P]
  virtual void Fill(const Eigen::VectorXd& x, ModelRows& rows) const = 0;
  /// Whether it is friction, whose loss warms the joint.
  virtual bool MakesHeat() const { return false; }
};

/// Columns times unknowns: C x.
class LinearBlock : public Block {
 public:
  LinearBlock(Slice at, Eigen::MatrixXd columns, bool makes_heat)
      : at_(at), columns_(std::move(columns)), makes_heat_(makes_heat) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override;
  bool MakesHeat() const override { return makes_heat_; }

 private:
  Slice at_;
  Eigen::MatrixXd columns_;  // [N x m]
  bool makes_heat_;
};

/// A given force that may be wrong: r(z) = r0 + R z with z ~ N(0, 1), seen through a gain: g r(z), g = sign exp(x).
struct GivenForce {
  Eigen::VectorXd force;       // [N] r0
  Eigen::MatrixXd directions;  // [N x r] R

  Eigen::VectorXd At(const Eigen::VectorXd& z) const { return force + directions * z; }
};

/// The places of a given force's unknowns in x.
struct GivenPlaces {
  Eigen::Index log_gain = 0;
  double sign = 1;  // of the gain
  Slice z;

  double Gain(const Eigen::VectorXd& x) const { return sign * std::exp(x[log_gain]); }
};

/// g r(z): the rigid part of a joint's torque.
class GivenBlock : public Block {
 public:
  GivenBlock(GivenPlaces at, GivenForce given) : at_(at), given_(std::move(given)) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override;

 private:
  GivenPlaces at_;
  GivenForce given_;
};

/// c |g r(z)| s: friction that grows with what the joint carries. s: the direction of motion.
class LoadBlock : public Block {
 public:
  LoadBlock(Eigen::Index gain, GivenPlaces at, GivenForce carried, Eigen::VectorXd direction)
      : gain_(gain), at_(at), carried_(std::move(carried)), direction_(std::move(direction)) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override;
  bool MakesHeat() const override { return true; }

 private:
  Eigen::Index gain_;
  GivenPlaces at_;
  GivenForce carried_;
  Eigen::VectorXd direction_;  // [N] s
};

/// The heat of a joint's own losses, Eqs. (20) to (22): tau dE/dt = -E + k |v| max(L + E, 0), L the level of all blocks that make heat,
/// losses held over a step. Adds s E.
struct HeatBlock {
  Eigen::Index gain = 0, log_time_constant = 0;
  double step = 0;                   // s
  Eigen::VectorXd speed;             // [N] |v|, rad/s or m/s
  Eigen::VectorXd sign;              // [N] of v
  Eigen::VectorXd direction;         // [N] s: of the force, as the log shows it
  std::vector<Eigen::Index> starts;  // samples at which the joint is cold again

  /// friction: force and derivatives of the blocks that make heat. Returns E, [N].
  Eigen::VectorXd Fill(const Eigen::VectorXd& x, const ModelRows& friction, ModelRows& rows) const;
};

/// A model of a torque.
struct Model {
  std::vector<Unknown> table;  // [P]
  std::vector<std::shared_ptr<const Block>> blocks;
  std::optional<HeatBlock> heat;
  Eigen::Index samples = 0;  // N

  Eigen::Index size() const { return std::ssize(table); }
  /// [P] where the fit begins.
  Eigen::VectorXd Start() const;
  /// [P] 1 / variance of each prior, 0 without one.
  Eigen::VectorXd PriorPrecision() const;
  /// [P] means of the priors, 0 without one.
  Eigen::VectorXd PriorMean() const;
  /// Appends rows and returns their places.
  Slice Append(const std::vector<Unknown>& rows);
  /// Force and derivatives at x. energy: gets E, [N], of a model with heat.
  ModelRows Evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* energy = nullptr) const;
};

}  // namespace warmjoint
