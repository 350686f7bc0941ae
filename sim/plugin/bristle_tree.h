// The coupled bristles of one kinematic tree.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "sim/plugin/asked_levels.h"
#include "sim/plugin/few_held.h"
#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"
#include "sim/plugin/search_tree.h"

namespace warmjoint::inline sim {

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

}  // namespace warmjoint::inline sim
