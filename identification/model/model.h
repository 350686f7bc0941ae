// A torque as a sum of blocks over one table of unknowns: what fills the rows of a fit.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "identification/model/heat_loop.h"
#include "identification/table.h"

namespace warmjoint {

/// A part of the torque.
class Block {
 public:
  virtual ~Block() = default;
  /// Adds the part's force and derivatives along rows.at. x: [P]
  virtual void Fill(const Eigen::VectorXd& x, ModelRows& rows) const = 0;
  /// Whether it is friction, whose loss warms the joint.
  virtual bool MakesHeat() const { return false; }
  /// Whether the losses follow from other samples of the motion than the torque; and the part as it is there.
  virtual bool HasOwnLosses() const { return false; }
  virtual void FillLosses(const Eigen::VectorXd& x, ModelRows& rows) const { Fill(x, rows); }
};

/// Columns over N samples, [N x m], a sample after the other.
using SharedColumns = std::shared_ptr<const ModelRows::Rows>;
inline SharedColumns Shared(const Eigen::MatrixXd& columns) {
  return std::make_shared<const ModelRows::Rows>(columns);
}

/// Columns times unknowns: C x.
class LinearBlock : public Block {
 public:
  LinearBlock(Slice at, SharedColumns columns) : at_(at), columns_(std::move(columns)) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override;

 private:
  Slice at_;
  SharedColumns columns_;
};

/// Friction that is linear in its unknowns. of_losses: the columns of the losses, where they are others; or null
class FrictionBlock : public Block {
 public:
  FrictionBlock(Slice at, SharedColumns columns, SharedColumns of_losses)
      : force_(at, columns),
        losses_(at, of_losses ? of_losses : columns),
        has_own_(of_losses != nullptr) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override { force_.Fill(x, rows); }
  bool MakesHeat() const override { return true; }
  bool HasOwnLosses() const override { return has_own_; }
  void FillLosses(const Eigen::VectorXd& x, ModelRows& rows) const override {
    losses_.Fill(x, rows);
  }

 private:
  LinearBlock force_, losses_;
  bool has_own_;
};

/// A given force that may be wrong: r(z) = r0 + R z with z ~ N(0, 1), seen through a gain: g r(z), g = sign exp(x).
struct GivenForce {
  Eigen::VectorXd force;       // [N] r0
  Eigen::MatrixXd directions;  // [N x r] R

  /// Along a stretch of m samples. z: [r]; returns [m]
  Eigen::VectorXd At(const SampleRange& at, const Eigen::VectorXd& z) const {
    return force.segment(at.first, at.count) + directions.middleRows(at.first, at.count) * z;
  }
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

/// c |g r(z)| s: friction that grows with what the joint carries. s: the direction of motion, as the torque shows it and as the
/// losses follow from it.
class LoadBlock : public Block {
 public:
  struct Directions {
    Eigen::VectorXd of_force, of_losses;  // [N]
  };
  LoadBlock(Eigen::Index gain, GivenPlaces at, GivenForce carried, Directions direction)
      : gain_(gain), at_(at), carried_(std::move(carried)), direction_(std::move(direction)) {}
  void Fill(const Eigen::VectorXd& x, ModelRows& rows) const override;
  bool MakesHeat() const override { return true; }
  bool HasOwnLosses() const override { return true; }
  void FillLosses(const Eigen::VectorXd& x, ModelRows& rows) const override;

 private:
  void FillAlong(const Eigen::VectorXd& direction, const Eigen::VectorXd& x, ModelRows& rows) const;

  Eigen::Index gain_;
  GivenPlaces at_;
  GivenForce carried_;
  Directions direction_;
};

/// What is known of several unknowns together: they are N(0, precision^-1).
struct GroupPrior {
  std::vector<Eigen::Index> places;  // [q] in the table
  Eigen::MatrixXd precision;         // [q x q]
};
/// Two unknowns that are alike: their difference is N(0, deviation^2). first, second: places in the table
GroupPrior Alike(Eigen::Index first, Eigen::Index second, double deviation);

/// A model of a torque.
struct Model {
  std::vector<Unknown> table;      // [P]
  std::vector<GroupPrior> groups;  // what is known in addition to the priors of the table
  std::vector<std::shared_ptr<const Block>> blocks;
  std::optional<HeatLoop> heat;
  Eigen::Index samples = 0;  // N

  Eigen::Index size() const { return std::ssize(table); }
  /// [P] where the fit begins.
  Eigen::VectorXd Start() const;
  /// [P x P] of what is known beforehand: 1 / variance of each prior, and what is known of groups.
  Eigen::MatrixXd PriorPrecision() const;
  /// [P] means of the priors, 0 without one.
  Eigen::VectorXd PriorMean() const;
  /// Appends rows and returns their places.
  Slice Append(const std::vector<Unknown>& rows);
  /// The places of the rows with a role (SliceOf).
  Slice At(Role role) const { return SliceOf(role, table); }
};

/// A model at one point, a stretch of the log after the other: rows of all samples are far larger than the log.
class ModelAt {
 public:
  /// model: must outlive this; x: [P]
  ModelAt(const Model& model, Eigen::VectorXd x);

  /// The heat at the first sample; empty without heat.
  HeatState Begin() const;
  /// The heat at the last sample, of a model with heat.
  HeatState End() const;
  /// Sets `rows` to those of a stretch. state: of the heat at its first sample, led on to the one after the last
  void Along(const SampleRange& stretch, HeatState& state, ModelRows& rows) const;
  /// The same of the blocks that make heat alone, as the losses follow from them, without heat.
  void LossesAlong(const SampleRange& stretch, ModelRows& rows) const;

  /// Calls visit(const ModelRows&) for one stretch after the other.
  template <typename Visit>
  void ForEachStretch(Visit&& visit) const {
    HeatState state = Begin();
    ModelRows rows;
    for (const SampleRange& stretch : Stretches()) {
      Along(stretch, state, rows);
      visit(rows);
    }
  }
  /// E along the log, [N], of a model with heat.
  Eigen::VectorXd Energy() const;
  /// Rows of all samples at once.
  ModelRows All() const;

  /// The stretches that ForEachStretch takes.
  std::vector<SampleRange> Stretches() const;

 private:
  /// Adds the blocks that make heat, and the heat.
  void AddFriction(HeatState& state, ModelRows& rows) const;

  const Model& model_;
  Eigen::VectorXd x_;
  std::vector<IntervalHold> holds_;
  bool has_own_losses_ = false;
};

}  // namespace warmjoint
