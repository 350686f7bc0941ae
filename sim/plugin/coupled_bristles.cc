#include "sim/plugin/coupled_bristles.h"

#include "sim/plugin/bristle_shape.h"

namespace warmjoint::inline sim {
namespace {

/// A slope of friction over speed that the step can carry takes at most so much of the damping.
constexpr double kMostSlope = 0.5;

}  // namespace

CoupledBristles::CoupledBristles(const mjModel* m, const std::vector<CoupledJoint>& joints) {
  for (int id = 0; id < m->ntree; ++id) {
    Tree tree;
    const auto size = static_cast<size_t>(m->tree_dofnum[id]);
    tree.place.assign(size, -1);
    for (const CoupledJoint& joint : joints) {
      if (m->dof_treeid[joint.dof] != id) continue;
      tree.joints.push_back(joint);
      tree.place[static_cast<size_t>(joint.dof - m->tree_dofadr[id])] =
          static_cast<int>(joint.place);
    }
    if (tree.joints.empty()) continue;
    tree.complete = tree.joints.size() == size;
    tree.inertia = InertiaBlock(m, id);
    tree.projection = BoxProjection(tree.inertia.size());
    tree.side.assign(size, 0);
    for (std::vector<double>& column : tree.few.column) column.assign(size, 0);
    for (std::vector<double>* numbers :
         {&tree.stretch_of, &tree.load_of, &tree.stretch, &tree.elastic, &tree.damping_force}) {
      numbers->assign(size, 0);
    }
    trees_.push_back(std::move(tree));
  }
}

/// Sets what follows from the step. slope: of friction over speed, at most, in units of M/h.
void CoupledBristles::Shape(Tree& tree, double slope) const {
  // the slope damps already
  slope = std::min(slope, kMostSlope);
  BristleShape shape = BristlesOf(tree.joints.front().instances);
  shape.stiffness *= 1 - slope;
  shape.damping = std::max(0.0, shape.damping - slope);
  tree.stiffness = shape.stiffness / (h_ * h_);
  tree.damping = shape.damping / h_;
  for (const CoupledJoint& joint : tree.joints) {
    const auto i = static_cast<size_t>(joint.dof - tree.inertia.first());
    tree.load_of[i] = tree.stiffness * joint.inertia;
    tree.stretch_of[i] = 1 / tree.load_of[i];
  }
}

/// Both projections where all joints but a few slide to the side of their stretch. With u = M^-1 of
/// their levels, c_k = M^-1's column of the held joint k, and e_k what its force lacks to its level,
///   slip = A/h^2 (z + h v) - u + sum_k c_k e_k,   0 at each k; then A/h^2 z' + B/h v in its place
/// so that the engine's factors serve. False where a joint that is fast would have to be held, or a
/// held one's force would be beyond its levels.
bool CoupledBristles::SlideMost(Tree& tree, const mjData* d) {
  const size_t size = tree.place.size();
  BoxProjection& box = tree.projection;
  for (size_t i = 0; i < size; ++i) {
    const double level = tree.side[i] > 0 ? box.upper[i] : -box.lower[i];
    box.force[i] = box.aim[i] = tree.place[i] < 0 ? 0 : level;
  }
  tree.inertia.Solve(d, box.aim.data());
  for (size_t i = 0; i < size; ++i) box.aim[i] = tree.stiffness * tree.stretch[i] - box.aim[i];

  // of the slow ones, those that would slide against their side are held
  FewHeld& few = tree.few;
  few.count = 0;
  for (int n = 0; n < tree.slow_count; ++n) {
    const auto k = static_cast<size_t>(tree.slow[n]);
    if (tree.side[k] * box.aim[k] < 0) few.joint[few.count++] = k;
  }
  for (int n = 0; n < few.count; ++n) {
    std::fill(few.column[n].begin(), few.column[n].end(), 0.0);
    few.column[n][few.joint[n]] = 1;
    tree.inertia.Solve(d, few.column[n].data());
  }
  if (!Hold(tree)) return false;

  const double* v = d->qvel + tree.inertia.first();
  const double softness = 1 / tree.stiffness;
  for (size_t i = 0; i < size; ++i) {
    tree.elastic[i] = softness * box.slip[i];
    box.aim[i] += tree.damping * v[i] - box.slip[i];
  }
  if (!Hold(tree)) return false;
  for (size_t i = 0; i < size; ++i) {
    if (tree.place[i] >= 0) tree.stretch[i] -= tree.elastic[i];
  }
  for (int n = 0; n < few.count; ++n) tree.side[few.joint[n]] = 0;
  return true;
}

/// Finds the slip and the forces that hold the few, from the slip without them (aim).
bool CoupledBristles::Hold(Tree& tree) {
  BoxProjection& box = tree.projection;
  const FewHeld& few = tree.few;
  double lack[kMostHeld]{};
  if (few.count == 1) {
    const size_t k = few.joint[0];
    lack[0] = -box.aim[k] / few.column[0][k];
  } else if (few.count == 2) {
    const auto [j, k] = few.joint;
    const double a = few.column[0][j], b = few.column[1][j], c = few.column[1][k];
    lack[0] = (b * box.aim[k] - c * box.aim[j]) / (a * c - b * b);
    lack[1] = (b * box.aim[j] - a * box.aim[k]) / (a * c - b * b);
  }
  box.slip = box.aim;
  for (int n = 0; n < few.count; ++n) {
    const size_t k = few.joint[n];
    const double level = tree.side[k] > 0 ? box.upper[k] : -box.lower[k];
    box.force[k] = level - lack[n];
    if (!(box.force[k] <= box.upper[k] && -box.force[k] <= box.lower[k])) return false;
    for (size_t i = 0; i < box.slip.size(); ++i) box.slip[i] += few.column[n][i] * lack[n];
  }
  for (int n = 0; n < few.count; ++n) box.slip[few.joint[n]] = 0;
  bool right = true;
  for (size_t i = 0; i < box.slip.size(); ++i) {
    right = right && (tree.place[i] < 0 || tree.side[i] * box.slip[i] >= 0);
  }
  return right;
}

/// The elastic and damping forces of bristles that hold everything.
void CoupledBristles::Multiply(Tree& tree, const mjData* d) {
  const double* v = d->qvel + tree.inertia.first();
  tree.inertia.Multiply(d, tree.stretch.data(), v, tree.elastic.data(), tree.damping_force.data());
  for (size_t i = 0; i < tree.place.size(); ++i) {
    tree.elastic[i] *= tree.stiffness;
    tree.damping_force[i] *= tree.damping;
    tree.projection.force[i] = tree.elastic[i] + tree.damping_force[i];
  }
}

/// Where several joints slide, or others have no friction: both projections.
void CoupledBristles::ProjectTwice(Tree& tree, const mjData* d) const {
  BoxProjection& box = tree.projection;
  const double* v = d->qvel + tree.inertia.first();
  const double* inverse = d->qLDiagInv + tree.inertia.first();
  const size_t size = tree.place.size();

  // slides what is fast, and what would be beyond its level if all were held
  using Course = BoxProjection::Course;
  for (size_t i = 0; i < size; ++i) {
    const double elastic = tree.elastic[i], impulse = tree.stiffness * h_ * v[i];
    Course& course = box.course[i] = Course::within;
    if (tree.place[i] < 0 || (box.lower[i] == 0 && box.upper[i] == 0)) {
      course = Course::free;
    } else if (impulse > inverse[i] * box.upper[i]) {
      course = Course::at_upper;
    } else if (-impulse > inverse[i] * box.lower[i]) {
      course = Course::at_lower;
    } else if (elastic > box.upper[i]) {
      course = Course::at_upper;
    } else if (-elastic > box.lower[i]) {
      course = Course::at_lower;
    }
  }
  box.Start(tree.inertia, d);
  box.aim = tree.elastic;
  box.Find(tree.inertia, d);

  const double softness = 1 / tree.stiffness;
  for (size_t i = 0; i < size; ++i) {
    tree.side[i] = static_cast<signed char>(box.course[i] == Course::free ? 0 : box.course[i]);
    if (tree.place[i] >= 0) tree.stretch[i] -= softness * box.slip[i];
    box.aim[i] = box.force[i] + tree.damping_force[i];
  }
  box.Find(tree.inertia, d);
}

}  // namespace warmjoint::inline sim
