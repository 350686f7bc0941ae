// The bristles of joints that the inertia matrix couples: they hold as one spring with its shape.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/friction/bristle.h"
#include "sim/plugin/box_projection.h"
#include "sim/plugin/inertia_block.h"

namespace warmjoint::inline sim {

/// A joint that CoupledBristles hold.
struct CoupledJoint {
  size_t place = 0;    // in the arrays that Step takes
  int dof = 0;         // of the model
  double inertia = 1;  // at the reference pose, kg.m^2 or kg
  int instances = 1;   // on its kinematic tree, of the same kind as this one
};

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
  CoupledBristles(const mjModel* m, const std::vector<CoupledJoint>& joints);

  /// Sets the step, s. slope(place): of friction over speed at most, N.m.s/rad or N.s/m.
  template <typename Slope>
  void SetTimestep(double h, const Slope& slope) {
    h_ = h;
    for (Tree& tree : trees_) {
      double steepest = 0;
      for (const CoupledJoint& joint : tree.joints) {
        steepest = std::max(steepest, slope(joint.place) * h / joint.inertia);
      }
      Shape(tree, steepest);
    }
  }

  /// loads: the states, steps: the results, each at a joint's place; level(place, side): L+ for side
  /// 1 and L- for side -1, N.m or N, a level below 0 counts as 0. d: with the inertia matrix and its
  /// factors.
  template <typename Level>
  void Step(const mjData* d, const double* loads, const Level& level, BristleStep* steps);

 private:
  /// So many joints may be held while the others slide before blocks of M are factorised.
  static constexpr int kMostHeld = 2;
  struct FewHeld {
    int count = 0;
    std::array<size_t, kMostHeld> joint{};                // counted from the tree's first
    std::array<std::vector<double>, kMostHeld> column{};  // of M^-1
  };

  /// A kinematic tree with some of the joints; of one step, [size] each.
  struct Tree {
    std::vector<CoupledJoint> joints{};
    bool complete = false;                        // friction on every degree of freedom
    double stiffness = 0, damping = 0;            // A/h^2 and B/h
    std::vector<int> place{};                     // -1 without friction
    std::vector<double> stretch_of{}, load_of{};  // factors from the state to z and back
    InertiaBlock inertia;

    std::vector<double> stretch{};        // z + h v, then z'
    std::vector<double> elastic{};        // p, N.m or N
    std::vector<double> damping_force{};  // B/h M v, N.m or N
    std::vector<signed char> side{};      // of the stretch; then to which p is at its level, or 0
    BoxProjection projection{};           // with f
    int slow_count = 0;                   // of the joints that their bristles could stop
    std::array<int, kMostHeld> slow{};
    FewHeld few{};
  };

  void Shape(Tree& tree, double slope) const;
  static bool SlideMost(Tree& tree, const mjData* d);
  static bool Hold(Tree& tree);
  static void Multiply(Tree& tree, const mjData* d);
  void ProjectTwice(Tree& tree, const mjData* d) const;

  std::vector<Tree> trees_;
  double h_ = 0;
};

template <typename Level>
void CoupledBristles::Step(const mjData* d, const double* loads, const Level& level,
                           BristleStep* steps) {
  for (Tree& tree : trees_) {
    BoxProjection& box = tree.projection;
    const auto size = static_cast<size_t>(tree.inertia.size());
    const auto limit = [&](size_t i, int side) {
      double& bound = side > 0 ? box.upper[i] : box.lower[i];
      return bound = std::max(0.0, level(static_cast<size_t>(tree.place[i]), side));
    };
    const double* v = d->qvel + tree.inertia.first();
    const double* inverse = d->qLDiagInv + tree.inertia.first();

    // which joints are so slow that their bristles could stop them
    tree.slow_count = 0;
    for (size_t i = 0; i < size; ++i) {
      const int place = tree.place[i];
      if (place < 0) continue;
      tree.stretch[i] = loads[place] * tree.stretch_of[i] + h_ * v[i];
      const int side = tree.stretch[i] < 0 ? -1 : 1;
      tree.side[i] = static_cast<signed char>(side);
      if (tree.stiffness * h_ * side * v[i] > inverse[i] * limit(i, side)) continue;
      if (tree.slow_count < kMostHeld) tree.slow[tree.slow_count] = static_cast<int>(i);
      ++tree.slow_count;
    }
    const bool most =
        tree.slow_count <= kMostHeld && tree.slow_count < static_cast<int>(tree.joints.size());
    for (int n = 0; most && n < tree.slow_count; ++n) {
      limit(static_cast<size_t>(tree.slow[n]), -tree.side[tree.slow[n]]);
    }
    if (!(most && SlideMost(tree, d))) {
      // the whole tree is held, or what is held and what slides is to be found
      Multiply(tree, d);
      bool holds = tree.complete;
      for (size_t i = 0; i < size && holds; ++i) {
        const double p = tree.elastic[i], f = box.force[i];
        const int side = p < 0 ? -1 : 1;
        if (side != tree.side[i]) limit(i, side);
        const double bound = side > 0 ? box.upper[i] : box.lower[i];
        holds = side * p <= bound && side * f <= bound &&
                (side * f >= 0 || -side * f <= limit(i, -side));
      }
      if (holds) {
        std::fill(tree.side.begin(), tree.side.end(), 0);
      } else {
        for (size_t i = 0; i < size; ++i) {
          if (tree.place[i] >= 0) limit(i, -tree.side[i]);
        }
        ProjectTwice(tree, d);
      }
    }
    for (size_t i = 0; i < size; ++i) {
      if (tree.place[i] < 0) continue;
      steps[tree.place[i]] = {box.force[i], tree.stretch[i] * tree.load_of[i],
                              tree.side[i] * v[i] > 0};
    }
  }
}

}  // namespace warmjoint::inline sim
