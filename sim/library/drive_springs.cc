// What Python calls while joint springs with a yield hold friction: steps, heat, and from it the yields (warmjoint.native).
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <vector>

#if mjVERSION_HEADER >= 4000000
extern "C" {
// the handler of a thread's messages, as MuJoCo's own Python sets it while it steps
[[gnu::weak]] mjfLogHandler _mjPRIVATE_setTlsLogHandler(mjfLogHandler handler);  // NOLINT
[[gnu::weak]] mjfLogHandler _mjPRIVATE_getGlobalLogHandler();                    // NOLINT
}
#endif

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

/// 1 - te of each stage over so many steps.
std::array<double, 2> Gone(const DrivenSpring& of, int steps) {
  return {-std::expm1(-steps * of.ratio[0]), -std::expm1(-steps * of.ratio[1])};
}

/// A joint's heat after the time in which `gone` of each stage's goes, and its spring's yield. energy: of the first stage; the second's is `count` on.
void Warm(mjModel* m, const mjData* d, const DrivenSpring& of, const std::array<double, 2>& gone,
          double* energy, int count) {
  const double loss = LossOfSpring(m, d, of);
  double sum = 0;
  for (const int stage : {0, 1}) {
    double& stored = energy[stage * count];
    stored = FiniteOr0(stored);
    // E' = E + (1 - te) (k W - E)
    stored += gone[static_cast<size_t>(stage)] * (of.gain[stage] * loss - stored);
    sum += stored;
  }
  m->jnt_springyield[of.joint] = Yield(of, sum, FiniteOr0(d->qvel[of.dof]));
}

/// Where an error of the engine leaves to, and what it said.
thread_local std::jmp_buf at_error;
thread_local std::array<char, 4096> error_text;

void TakeMessage(const mjLogMessage* message) {
  if (message->level == mjLOG_ERROR) {
    std::snprintf(error_text.data(), error_text.size(), "%s%s%s", message->subject,
                  message->body ? "\n" : "", message->body ? message->body : "");
    std::longjmp(at_error, 1);
  }
  if (_mjPRIVATE_getGlobalLogHandler) {
    if (const mjfLogHandler shared = _mjPRIVATE_getGlobalLogHandler()) shared(message);
  }
}

/// Steps with the driver after each. An error of the engine leaves it by longjmp, so that nothing here may wait for its end.
void Step(mjModel* m, mjData* d, const DrivenSpring* springs, int count, double* energy,
          const std::array<double, 2>* gone, int steps) {
  for (int step = 0; step < steps; ++step) {
    mj_step(m, d);
    for (int i = 0; i < count; ++i) Warm(m, d, springs[i], gone[i], energy + i, count);
  }
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
  for (int i = 0; i < count; ++i) {
    warmjoint::Warm(m, d, springs[i], warmjoint::Gone(springs[i], steps), energy + i, count);
  }
#endif
}

/// Relaxes springs that are stretched beyond twice their yields, where a pose was set anew; then steps, with heat and yields after each. Returns
/// what the engine's error said, until the thread's next call; nullptr where there was none.
[[gnu::visibility("default")]] const char* warmjoint_step_springs(
    [[maybe_unused]] mjModel* m, [[maybe_unused]] mjData* d,
    [[maybe_unused]] const warmjoint::DrivenSpring* springs, [[maybe_unused]] int count,
    [[maybe_unused]] double* energy, [[maybe_unused]] int steps) {
#if mjVERSION_HEADER >= 4000000
  std::vector<std::array<double, 2>> gone(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    const warmjoint::DrivenSpring& of = springs[i];
    double& plastic = d->plastic[of.plastic];
    const double stretch = d->qpos[of.position] - plastic;
    if (!(std::abs(stretch) <= 2 * m->jnt_springyield[of.joint])) plastic = d->qpos[of.position];
    gone[static_cast<size_t>(i)] = warmjoint::Gone(of, 1);
  }
  if (!_mjPRIVATE_setTlsLogHandler) {
    warmjoint::Step(m, d, springs, count, energy, gone.data(), steps);
    return nullptr;
  }
  const mjfLogHandler before = _mjPRIVATE_setTlsLogHandler(warmjoint::TakeMessage);
  const bool failed = setjmp(warmjoint::at_error) != 0;
  if (!failed) warmjoint::Step(m, d, springs, count, energy, gone.data(), steps);
  _mjPRIVATE_setTlsLogHandler(before);
  return failed ? warmjoint::error_text.data() : nullptr;
#else
  return nullptr;
#endif
}
}
