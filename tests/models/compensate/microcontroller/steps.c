// The recordings of tests/golden through wj_step, on the host or on a microcontroller: friction of each sample in hexadecimal, and on the
// controller how many instructions a step takes.
#include <stdio.h>
#include <string.h>
#include <warmjoint/compensate.h>

#include "cases.h"

/// Bits of a double, high word first: newlib's small printf has no %a.
static void Print(wj_real value) {
  const double number = (double)value;
  unsigned words[2];
  memcpy(words, &number, sizeof number);
  printf("%08x%08x\n", words[1], words[0]);
}

static void Run(const Case* one) {
  wj_friction friction;
  memset(&friction, 0, sizeof friction);
  one->numbers(&friction);
  wj_joint joint;
  wj_begin(&joint, &friction);
  joint.settings.share = 1;
  joint.settings.longest_gap = one->step;
  joint.state.energy = one->initial_energy;
  printf("%s %d %d\n", one->name, friction.map_count, one->count);
  for (int i = 0; i < one->count; ++i) {
    if (i > 0) joint.at.ambient_rise = one->ambient_rise[i - 1];
    joint.at.position = one->position[i];
    joint.at.load = one->load[i];
    Print(wj_step(&joint, one->velocity[i], (wj_real)NAN, i > 0 ? one->step : 0));
  }
}

#ifdef __arm__
// SysTick counts down from 2^24 - 1 at the clock of the machine mps2-an386, 25 MHz; with -icount shift=0 an instruction takes 1 ns.
#define SYST_CSR (*(volatile unsigned*)0xE000E010)
#define SYST_RVR (*(volatile unsigned*)0xE000E014)
#define SYST_CVR (*(volatile unsigned*)0xE000E018)
enum { kInstructionsATick = 40, kSteps = 1000 };

static void Count(const char* what, wj_real torque) {
  wj_friction friction;
  memset(&friction, 0, sizeof friction);
  friction.viscous = 5;
  friction.coulomb_positive = friction.coulomb_negative = 15;
  friction.thermal_gain = -(wj_real)0.75;
  friction.thermal_time_constant = 600;
  wj_joint joint;
  wj_begin(&joint, &friction);
  wj_real sum = wj_step(&joint, (wj_real)0.5, torque, (wj_real)0.001);
  SYST_RVR = 0xFFFFFF;
  SYST_CVR = 0;
  SYST_CSR = 5;
  const unsigned begin = SYST_CVR;
  for (int i = 0; i < kSteps; ++i) {
    const wj_real v = (wj_real)(i % 100) * (wj_real)0.01 - (wj_real)0.5;
    sum += wj_step(&joint, v, torque * v, (wj_real)0.001);
  }
  const unsigned ticks = (begin - SYST_CVR) & 0xFFFFFF;
  SYST_CSR = 0;
  printf("instructions %s %u %d\n", what, ticks * kInstructionsATick / kSteps, sum == sum);
}

void _start(void);

/// Interrupts are off; the floating-point unit is switched on before anything uses it.
void Reset(void) {
  *(volatile unsigned*)0xE000ED88 |= 0xFu << 20;
  __asm volatile("dsb\nisb");
  _start();
}

extern unsigned stack_top;
__attribute__((section(".vectors"), used)) static const void* const vectors[] = {&stack_top,
                                                                                 (void*)Reset};
#endif

int main(void) {
  for (unsigned k = 0; k < sizeof cases / sizeof cases[0]; ++k) Run(&cases[k]);
#ifdef __arm__
  Count("open_loop", (wj_real)NAN);
  Count("corrected", 30);
#endif
  return 0;
}
