#include "sim/plugin/stiff_drives.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <memory>
#include <random>

#include "sim/plugin/check_joint.h"

namespace warmjoint::inline sim {
namespace {

/// Eigenvalues up to this change no BristlesOf. Why: 3.6 of instances that share a tree + 0.3 = kCarried.
constexpr double kMinor = 0.3;

/// Poses in which drives are looked at, of which the reference pose is the first.
constexpr int kPoses = 32;

/// The diagonal of h^2 K + 2 h C, kg.m^2 or kg.
Eigen::VectorXd Added(const mjModel* m, int integrator) {
  const double h = m->opt.timestep, per_damping = integrator == mjINT_EULER ? 2 * h : -2 * h;
  Eigen::VectorXd added = Eigen::VectorXd::Zero(m->nv);
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_trntype[i] != mjTRN_JOINT || m->actuator_biastype[i] != mjBIAS_AFFINE) continue;
    const double gear = m->actuator_gear[6 * m->actuator_outadr[i]];
    const mjtNum* bias = m->actuator_biasprm + i * mjNBIAS;
    added[m->jnt_dofadr[m->actuator_trnid[2 * i]]] -=
        gear * gear * (h * h * bias[1] + per_damping * bias[2]);
  }
  return added;
}

/// Another pose within the joints' ranges, the same ones for each model.
void Draw(const mjModel* m, std::minstd_rand& random, mjtNum* position) {
  for (int i = 0; i < m->njnt; ++i) {
    const bool limited = m->jnt_limited[i], hinge = m->jnt_type[i] == mjJNT_HINGE;
    const double share = static_cast<double>(random()) / std::minstd_rand::max();
    const double lower = limited ? m->jnt_range[2 * i] : -mjPI;
    const double upper = limited ? m->jnt_range[2 * i + 1] : mjPI;
    if (hinge) position[m->jnt_qposadr[i]] = lower + share * (upper - lower);
  }
}

}  // namespace

std::vector<double> StiffestDrives(const mjModel* m, int integrator) {
  // most models: the eigenvalues' sum, in which the compiler at first knows no inertia, is small
  std::vector<double> stiffest(static_cast<size_t>(m->ntree), 0);
  const Eigen::VectorXd added = Added(m, integrator);
  double sum = 0;
  for (int dof = 0; dof < m->nv; ++dof) {
    const double inertia = EffectiveInertia(m, dof);
    if (inertia > 0) sum += std::max(0.0, added[dof]) / inertia;
  }
  if (sum <= kMinor || integrator == mjINT_DISCRETE || integrator == mjINT_RK4) return stiffest;

  // data of a model with plugins would ask for this instance again
  const std::unique_ptr<mjModel, void (*)(mjModel*)> bare(mj_copyModel(nullptr, m), mj_deleteModel);
  bare->nplugin = 0;
  const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(bare.get()), mj_deleteData);
  Eigen::MatrixXd inertia(m->nv, m->nv);
  std::minstd_rand random;
  for (int pose = 0; pose < kPoses; ++pose) {
    if (pose > 0) Draw(m, random, d->qpos);
    mj_kinematics(bare.get(), d.get());
    mj_comPos(bare.get(), d.get());
    mj_makeM(bare.get(), d.get());
    mj_fullM(bare.get(), d.get(), inertia.data());
    for (int tree = 0; tree < m->ntree; ++tree) {
      const int first = m->tree_dofadr[tree], size = m->tree_dofnum[tree];
      const Eigen::MatrixXd of_tree = added.segment(first, size).asDiagonal();
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
          of_tree, inertia.block(first, first, size, size), Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
      stiffest[tree] = std::max(stiffest[tree], modes.eigenvalues().maxCoeff());
    }
  }
  return stiffest;
}

}  // namespace warmjoint::inline sim
