// The bristles of joints that the inertia matrix couples: they hold as one spring with its shape.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <vector>

#include "sim/plugin/bristle_tree.h"

namespace warmjoint::inline sim {

/// One step of the bristles of several joints, elastic and perfectly plastic in the metric of the
/// inertia matrix M. z: their stretches, rad or m; box: -L- <= x <= L+ for each joint, 0 for every
/// degree of freedom without friction.
///   p  = projection of A/h^2 M (z + h v)    z' = z + h v - h^2/A M^-1 (A/h^2 M (z + h v) - p)
///   f  = projection of p + B/h M v
/// A projection of g onto the box is the x of it that is nearest in the metric of M^-1: a linear
/// complementarity problem, solved exactly. For M that stands still this is passive for any v and
/// any boxes that hold 0: with U = A/(2 h^2) z'M z, f'v h >= U(z') - U(z) (both projections are
/// onto a convex set that holds 0 and p). Held joints form one spring and damper with the shape of
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

}  // namespace warmjoint::inline sim
