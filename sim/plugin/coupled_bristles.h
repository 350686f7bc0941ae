// The bristles of joints that the inertia matrix couples: they hold as one spring with its shape.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <vector>

#include "sim/plugin/box_projection.h"
#include "sim/plugin/few_held.h"
#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint {

/// A joint that CoupledBristles hold.
struct CoupledJoint {
  int dof = 0;              // of the model
  double inertia = 1;       // at the reference pose, kg.m^2 or kg
  int instances = 1;        // on its kinematic tree, of the same kind as this one
  bool asks_level = false;  // for each side that a step needs, since it costs much
};

/// One step as CoupledBristles says, of the rows of one tree, which are counted from its first. Three
/// ways lead to the one solution: everything is held (one product with M tells), all but a few slide
/// to the side of their stretch (the engine's own factors tell), or what slides is searched for.
class BristleTree {
 public:
  /// tree: its number in the model.
  BristleTree(const mjModel* m, int tree, const std::vector<CoupledJoint>& joints);

  size_t size() const { return static_cast<size_t>(inertia_.size()); }
  int first_dof() const { return inertia_.first(); }
  const std::vector<CoupledJoint>& joints() const { return joints_; }

  /// Sets what follows from the step h, s. slope: of friction over speed, at most, in units of M/h;
  /// damping: of the bristles, beside that of BristlesOf; drive: the tree's StiffestDrives.
  void Shape(double h, double slope, double damping, double drive);

  /// Finds friction, sliding and the next load from v, load and levels. first: row of its first.
  void Step(const mjData* d, const LevelSource& levels, Rows rows, size_t first);

 private:
  double Stretch(const mjData* d, Rows rows);
  void Multiply(const mjData* d, Rows rows);
  bool Hold(Rows rows);
  void TakeSides(Rows rows);
  int LikeliestHeld(Rows rows) const;
  bool Slide(const mjData* d, Rows rows, int likely);
  bool SlideButFew(const mjData* d, Rows rows);

  std::vector<CoupledJoint> joints_;
  std::vector<int> rows_of_joints_;
  bool complete_;  // friction in every row
  InertiaBlock inertia_;
  double impulse_ = 0, damping_ = 0;  // A/h and B/h

  // of one step, two rows at once
  std::vector<Two> present_;  // 1 where there is friction, or 0
  std::vector<Two>
      mobility_;            // of a joint by itself, with those before it held, 1/(kg.m^2) or 1/kg
  std::vector<Two> side_;   // of the stretch, 0 without friction
  std::vector<Two> start_;  // A/h^2 (z + h v) - M^-1 level, then what the damper adds to it
  std::vector<Two> slip_;   // what is left of it where some are held

  // of each row
  std::vector<Two> pair_;   // {A/h^2 (z + h v), v}
  std::vector<Two> force_;  // M times that

  AskedLevels levels_;
  FewHeld few_;
  SearchTree search_;
};

/// One step of the bristles of several joints, elastic and perfectly plastic in the metric of the
/// inertia matrix M. z: their stretches, rad or m; box: -L- <= x <= L+ for each joint, 0 for every
/// degree of freedom without friction.
///   p  = projection of A/h^2 M (z + h v)    z' = z + h v - h^2/A M^-1 (A/h^2 M (z + h v) - p)
///   f  = projection of p + B/h M v, onto a box that is kDamperLevels times as wide for each joint whose
///        bristle is within it, where p is at no bound
/// A projection of g onto the box is the x of it that is nearest in the metric of M^-1: a linear
/// complementarity problem, solved exactly. For M that stands still this is passive for any v and
/// any boxes that hold 0: with U = A/(2 h^2) z'M z, f'v h >= U(z') - U(z) (both projections are
/// onto a convex set that holds 0, and p). Held joints form one spring and damper with the shape of
/// the inertia that they feel with all sliding joints free to give, so that no pose is stiffer than
/// the step carries. The state of each joint is its stretch times A m/h^2, m being its inertia at
/// the reference pose: N.m or N, and the bristle's load where nothing else moves the joint.
class CoupledBristles {
 public:
  CoupledBristles() = default;
  /// Rows are the degrees of freedom of the kinematic trees on which the joints are.
  CoupledBristles(const mjModel* m, const std::vector<CoupledJoint>& joints);

  /// Rows of all trees, each of which begins with a pair of its own.
  size_t size() const { return size_; }

  /// The row of a joint's degree of freedom.
  size_t RowOf(int dof) const;

  /// Sets the step, s. damping: beside that of BristlesOf, for the integrator; slope(dof): of friction
  /// over speed at most, N.m.s/rad or N.s/m; drive(dof): its tree's StiffestDrives.
  template <typename Slope, typename Drive>
  void SetTimestep(double h, double damping, const Slope& slope, const Drive& drive) {
    for (auto& [tree, first] : trees_) {
      double steepest = 0;
      for (const CoupledJoint& joint : tree.joints()) {
        steepest = std::max(steepest, slope(joint.dof) * h / joint.inertia);
      }
      tree.Shape(h, steepest, damping, drive(tree.joints().front().dof));
    }
  }

  /// Finds friction, sliding and the next load of all rows from their speeds, loads and levels.
  /// levels: of the rows that ask for theirs. d: with the inertia matrix and its factors.
  void Step(const mjData* d, const LevelSource& levels, Rows rows) {
    for (auto& [tree, first] : trees_) {
      tree.Step(d, levels, {rows.numbers + PlaceOf(first)}, first);
    }
  }

 private:
  struct Placed {
    BristleTree tree;
    size_t first;  // its first row
  };
  std::vector<Placed> trees_;
  size_t size_ = 0;
};

}  // namespace warmjoint
