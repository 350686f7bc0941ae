#include "sim/plugin/stiff_drives.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "sim/plugin/check_joint.h"

namespace warmjoint::inline sim {
namespace {

/// Eigenvalues below this change no BristlesOf: why: 4 (1.2 / 4 + 2 1.2 / 4) + 0.3 = kCarried.
constexpr double kMinor = 0.3;

/// Poses in which drives are looked at, of which the reference pose is the first.
constexpr int kPoses = 32;

/// Stiffness and damping of one drive over its length; 0 where it is not affine.
struct Affine {
  double stiffness, damping;
};

Affine AffineOf(const mjModel* m, int actuator) {
  if (m->actuator_biastype[actuator] != mjBIAS_AFFINE) return {0, 0};
  const mjtNum* bias = m->actuator_biasprm + actuator * mjNBIAS;
  return {-bias[1], -bias[2]};
}

double SpringOf(const mjModel* m, int dof) {
  const int joint = m->dof_jntid[dof], type = m->jnt_type[joint];
  return type == mjJNT_HINGE || type == mjJNT_SLIDE ? m->jnt_stiffness[joint] : 0;
}

/// The trace of that matrix at most, of all trees and any integrator.
double Bound(const mjModel* m) {
  const double h = m->opt.timestep;
  double bound = 0;
  // M^-1 at a joint is not more than the acceleration by a unit force
  for (int i = 0; i < m->nactuator; ++i) {
    const auto [stiffness, damping] = AffineOf(m, i);
    const double added = std::abs(h * h * stiffness) + std::abs(2 * h * damping);
    if (added == 0) continue;
    if (m->actuator_trntype[i] != mjTRN_JOINT) return std::numeric_limits<double>::infinity();
    const int output = m->actuator_outadr[i];
    bound += added * std::abs(m->actuator_gear[6 * output]) * m->actuator_acc0[output];
  }
  for (int dof = 0; dof < m->nv; ++dof) {
    const double inertia = EffectiveInertia(m, dof);
    if (inertia > 0) bound += h * h * std::abs(SpringOf(m, dof)) / inertia;
  }
  return bound;
}

/// Data of a model without its plugins, as far as inertia and transmissions need.
class Pose {
 public:
  explicit Pose(const mjModel* m)
      : m_(mj_copyModel(nullptr, m), mj_deleteModel), d_(nullptr, mj_deleteData) {
    // data of a model with plugins would ask for this instance again
    m_->nplugin = 0;
    d_.reset(mj_makeData(m_.get()));
  }

  /// Another pose within the joints' ranges, the same ones for each model.
  void Draw() {
    for (int i = 0; i < m_->njnt; ++i) {
      const bool hinge = m_->jnt_type[i] == mjJNT_HINGE, limited = m_->jnt_limited[i];
      if (!hinge && !(limited && m_->jnt_type[i] == mjJNT_SLIDE)) continue;
      const double share = static_cast<double>(random_()) / std::minstd_rand::max();
      const double lower = limited ? m_->jnt_range[2 * i] : -mjPI;
      const double upper = limited ? m_->jnt_range[2 * i + 1] : mjPI;
      d_->qpos[m_->jnt_qposadr[i]] = lower + share * (upper - lower);
    }
  }

  void FindInertia() {
    mj_kinematics(m_.get(), d_.get());
    mj_comPos(m_.get(), d_.get());
    mj_tendon(m_.get(), d_.get());
    mj_transmission(m_.get(), d_.get());
    mj_makeM(m_.get(), d_.get());
  }

  Eigen::MatrixXd Inertia() const {
    Eigen::MatrixXd inertia(m_->nv, m_->nv);
    mj_fullM(m_.get(), d_.get(), inertia.data());
    return inertia;
  }

  /// Length of an actuator's first output over each degree of freedom.
  Eigen::VectorXd Moment(int actuator) const {
    Eigen::VectorXd moment = Eigen::VectorXd::Zero(m_->nv);
    const int output = m_->actuator_outadr[actuator], begin = d_->moment_rowadr[output];
    for (int k = begin; k < begin + d_->moment_rownnz[output]; ++k) {
      moment[d_->moment_colind[k]] = d_->actuator_moment[k];
    }
    return moment;
  }

 private:
  std::unique_ptr<mjModel, void (*)(mjModel*)> m_;
  std::unique_ptr<mjData, void (*)(mjData*)> d_;
  std::minstd_rand random_;
};

/// h^2 K + 2 h C, [nv x nv].
Eigen::MatrixXd Added(const mjModel* m, const Pose& pose, int integrator) {
  const double h = m->opt.timestep;
  // Euler takes the damping of joints alone implicitly, unless that is switched off
  const double drives = integrator == mjINT_EULER ? 2 * h : -2 * h;
  const bool explicit_damping = integrator == mjINT_EULER && m->opt.disableflags & mjDSBL_EULERDAMP;
  const double joints = explicit_damping ? 2 * h : -2 * h;
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(m->nv, m->nv);
  for (int dof = 0; dof < m->nv; ++dof) {
    added(dof, dof) = h * h * SpringOf(m, dof) + joints * m->dof_damping[dof];
  }
  for (int i = 0; i < m->nactuator; ++i) {
    const auto [stiffness, damping] = AffineOf(m, i);
    if (stiffness == 0 && damping == 0) continue;
    const Eigen::VectorXd moment = pose.Moment(i);
    added += (h * h * stiffness + drives * damping) * moment * moment.transpose();
  }
  return added;
}

}  // namespace

std::vector<double> StiffestDrives(const mjModel* m, int integrator) {
  std::vector<double> stiffest(static_cast<size_t>(m->ntree), 0);
  if (integrator == mjINT_DISCRETE || integrator == mjINT_RK4 || Bound(m) <= kMinor) {
    return stiffest;
  }
  Pose pose(m);
  for (int number = 0; number < kPoses; ++number) {
    if (number > 0) pose.Draw();
    pose.FindInertia();
    const Eigen::MatrixXd inertia = pose.Inertia(), added = Added(m, pose, integrator);
    for (int tree = 0; tree < m->ntree; ++tree) {
      const int first = m->tree_dofadr[tree], size = m->tree_dofnum[tree];
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
          added.block(first, first, size, size), inertia.block(first, first, size, size),
          Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
      stiffest[tree] = std::max(stiffest[tree], modes.eigenvalues().maxCoeff());
    }
  }
  return stiffest;
}

}  // namespace warmjoint::inline sim
