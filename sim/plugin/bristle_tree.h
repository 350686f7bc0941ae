// The coupled bristles of one kinematic tree.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

#include "sim/plugin/box_projection.h"
#include "sim/plugin/few_held.h"
#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint::inline sim {

/// A joint that CoupledBristles hold.
struct CoupledJoint {
  int dof = 0;              // of the model
  double inertia = 1;       // at the reference pose, kg.m^2 or kg
  int instances = 1;        // on its kinematic tree, of the same kind as this one
  bool asks_level = false;  // for each side that a step needs, since it costs much
};

/// Tells the levels of rows that ask for theirs.
class LevelSource {
 public:
  virtual ~LevelSource() = default;
  /// L+ for side 1 and L- for side -1, N.m or N; a level below 0 counts as 0.
  virtual double LevelAt(size_t row, int side) const = 0;
};

/// One step as CoupledBristles says, of the rows of one tree, which are counted from its first. Three ways lead to the one
/// solution: everything is held (one product with M tells), all but a few slide to the side of
/// their stretch (the engine's own factors tell), or what slides is searched for.
class BristleTree {
 public:
  /// tree: its number in the model.
  BristleTree(const mjModel* m, int tree, const std::vector<CoupledJoint>& joints);

  size_t size() const { return side_.size(); }
  int first_dof() const { return inertia_.first(); }
  const std::vector<CoupledJoint>& joints() const { return joints_; }

  /// Sets what follows from the step h, s. slope: of friction over speed, at most, in units of M/h;
  /// damping: of the bristles, beside that of BristlesOf.
  void Shape(double h, double slope, double damping);

  /// Finds friction, sliding and the next load from v, load and levels. first: row of its first.
  void Step(const mjData* d, const LevelSource& levels, Rows rows, size_t first);

 private:
  void Stretch(const mjData* d, Rows rows);
  double Ask(Row row, int i, int side);
  void Multiply(const mjData* d, Rows rows);
  bool Hold(Rows rows);
  bool Slide(const mjData* d, Rows rows);
  bool SlideButFew(Rows rows);
  void Search(const mjData* d, Rows rows);

  struct At {
    int row;
    size_t place;  // in the numbers of the tree's rows
  };

  std::vector<CoupledJoint> joints_;
  std::vector<At> joint_at_,
      asking_;     // where they are, and those of them that ask for their levels
  bool complete_;  // friction in every row
  InertiaBlock inertia_;
  double impulse_ = 0, damping_ = 0;  // A/h and B/h

  // of one step: of all rows
  const LevelSource* levels_ = nullptr;
  size_t first_ = 0;
  std::vector<signed char> side_;     // of the stretch, 0 without friction
  std::vector<unsigned char> known_;  // sides whose level is known: 1 below, 2 above
  std::vector<Two> pair_;             // {A/h^2 (z + h v), the same + B/h v}
  std::vector<Two> force_;            // M times that: {p, f} where everything is held, N.m or N
  std::vector<double> level_;         // on the side of the stretch, N.m or N
  std::vector<double> slip_;          // A/h^2 (z + h v) - M^-1 level
  std::vector<double> left_;          // of it where some are held
  FewHeld slow_;                      // joints that their bristles could stop
  BoxProjection projection_;
};

}  // namespace warmjoint::inline sim
