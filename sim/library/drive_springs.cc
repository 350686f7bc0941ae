// What Python calls while joint springs with a yield hold friction: heat, and from it the yields (warmjoint.native).
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

/// A stretch in double precision is a difference of angles, worth 1e-15 of some rad, and a yield is 1e-6 rad at least where it matters.
[[maybe_unused]] constexpr double kAtYield = 1 - 1e-6;

/// A joint's spring and its friction, as native_springs.py lays it out.
struct DrivenSpring {
  int joint, position, dof, plastic;  // in the model, qpos, qvel and plastic
  double stiffness;                   // N.m/rad or N/m
  double level, rise;                 // of sliding, and what it falls by with speed, N.m or N
  double velocity, exponent;          // of that
  double gain[2];                     // N.m/W or N/W
  double ratio[2];                    // h / tau
};

#if mjVERSION_HEADER >= 4000000

double FiniteOr0(double x) { return std::isfinite(x) ? x : 0; }

/// What a joint loses, W: always by its damping, by its level where the spring is at its yield and gives way.
double LossOfSpring(const mjModel* m, const mjData* d, const DrivenSpring& of) {
  const double v = d->qvel[of.dof], yield = m->jnt_springyield[of.joint];
  const double stretch = d->qpos[of.position] - d->plastic[of.plastic];
  const bool slides = std::abs(stretch) >= kAtYield * yield && stretch * v > 0;
  return FiniteOr0(m->dof_damping[of.dof] * v * v +
                   (slides ? of.stiffness * yield * std::abs(v) : 0));
}

/// (g(|v|) + E) / k, not below 0.
double Yield(const DrivenSpring& of, double energy, double speed) {
  double level = of.level + energy;
  if (of.rise != 0) {
    level += of.rise * std::exp(-std::pow(std::abs(speed) / of.velocity, of.exponent));
  }
  return std::max(0.0, level) / of.stiffness;
}

#endif

}  // namespace
}  // namespace warmjoint

extern "C" {

/// Heat of the time of so many steps, and the yields by it. energy: [2 x count] E1 and E2, N.m or N. What is no finite number counts as 0.
[[gnu::visibility("default")]] void warmjoint_warm_springs(
    [[maybe_unused]] mjModel* m, [[maybe_unused]] const mjData* d,
    [[maybe_unused]] const warmjoint::DrivenSpring* springs, [[maybe_unused]] int count,
    [[maybe_unused]] double* energy, [[maybe_unused]] int steps) {
#if mjVERSION_HEADER >= 4000000
  using warmjoint::FiniteOr0;
  for (int i = 0; i < count; ++i) {
    const warmjoint::DrivenSpring& of = springs[i];
    const double loss = warmjoint::LossOfSpring(m, d, of);
    double sum = 0;
    for (const int stage : {0, 1}) {
      double& stored = energy[stage * count + i];
      stored = FiniteOr0(stored);
      // E' = E + (1 - te) (k W - E)
      stored += -std::expm1(-steps * of.ratio[stage]) * (of.gain[stage] * loss - stored);
      sum += stored;
    }
    m->jnt_springyield[of.joint] = warmjoint::Yield(of, sum, FiniteOr0(d->qvel[of.dof]));
  }
#endif
}

/// Relaxes springs that are stretched beyond twice their yields, where a pose was set anew.
[[gnu::visibility("default")]] void warmjoint_relax_springs(
    [[maybe_unused]] const mjModel* m, [[maybe_unused]] mjData* d,
    [[maybe_unused]] const warmjoint::DrivenSpring* springs, [[maybe_unused]] int count) {
#if mjVERSION_HEADER >= 4000000
  for (int i = 0; i < count; ++i) {
    const warmjoint::DrivenSpring& of = springs[i];
    double& plastic = d->plastic[of.plastic];
    const double stretch = d->qpos[of.position] - plastic;
    if (!(std::abs(stretch) <= 2 * m->jnt_springyield[of.joint])) plastic = d->qpos[of.position];
  }
#endif
}
}
