// <warmjoint/compensate.h> as C99 and as C++, in double and in float: the recordings of tests/golden, a contact, state over a
// night, hostile calls, a joint that is pushed, and its time. Prints what failed; exit 1.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <warmjoint/compensate.h>

#include "cases.h"

static int failures = 0;

static void Expect(int holds, const char* what, double found) {
  if (holds) return;
  ++failures;
  printf("%s: %.17g\n", what, found);
}

/// Rounding of 600 steps at 20 N.m.
static const double kDigits = sizeof(wj_real) == sizeof(double) ? 1e-13 : 3e-6;

static wj_friction Nothing(void) {
  wj_friction friction;
  memset(&friction, 0, sizeof friction);
  return friction;
}

/// The joint of the method paper's first table.
static wj_friction PaperJoint(void) {
  wj_friction friction = Nothing();
  friction.viscous = 5;
  friction.coulomb_positive = friction.coulomb_negative = 15;
  friction.thermal_gain = -(wj_real)0.75;
  friction.thermal_time_constant = 600;
  friction.noise = (wj_real)0.5;
  return friction;
}

/// Uniform from -1 to 1.
static wj_real Uniform(void) { return (wj_real)rand() / ((wj_real)RAND_MAX / 2) - 1; }

/// Nearly normal, with deviation 1.
static wj_real Normal(void) {
  wj_real sum = 0;
  for (int i = 0; i < 12; ++i) sum += Uniform();
  return sum / 2;
}

static void FollowsTheRecordings(void) {
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
    const Case* one = &cases[k];
    wj_friction friction = Nothing();
    one->numbers(&friction);
    wj_joint joint;
    wj_begin(&joint, &friction);
    joint.settings.share = 1;
    joint.settings.longest_gap = one->step;
    joint.state.energy = one->initial_energy;
    double worst = 0, worst_energy = 0, largest = 0;
    for (int i = 0; i < one->count; ++i) {
      // heat of the step that ends here is that of the surroundings in which it began
      if (i > 0) joint.at.ambient_rise = one->ambient_rise[i - 1];
      joint.at.position = one->position[i];
      joint.at.load = one->load[i];
      const wj_real force = wj_step(&joint, one->velocity[i], (wj_real)NAN, i > 0 ? one->step : 0);
      worst = fmax(worst, (double)wj_abs(force - one->force[i]));
      worst_energy = fmax(worst_energy, (double)wj_abs(joint.found.energy - one->energy[i]));
      largest = fmax(largest, (double)wj_abs(one->force[i]));
    }
    Expect(worst <= kDigits * largest, one->name, worst);
    Expect(worst_energy <= kDigits * largest, one->name, worst_energy);
  }
}

static void KeepsItsHeatInSmallSteps(void) {
  // 20 min at 10 kHz are those of one step each second, where the loss is constant
  wj_friction friction = PaperJoint();
  friction.thermal_gain = -(wj_real)0.2;
  wj_joint fine, coarse;
  wj_begin(&fine, &friction);
  wj_begin(&coarse, &friction);
  for (int s = 0; s < 1200; ++s) {
    fine.found.loss = coarse.found.loss = 8;
    for (int i = 0; i < 10000; ++i) wj_pass(&fine, (wj_real)1e-4);
    wj_pass(&coarse, 1);
  }
  const double change = fabs((double)(fine.state.energy - coarse.state.energy));
  Expect(change <= 1e-4 * fabs((double)coarse.state.energy), "heat in small steps", change);
}

/// A joint whose truth is `more` above the numbers, moving to both sides; returns the friction's error at the end.
static double ErrorAfter(wj_joint* joint, wj_real more, wj_real contact, double seconds) {
  const wj_real dt = (wj_real)0.01;
  wj_real error = 0;
  for (int i = 0; i < (int)(seconds / 0.01); ++i) {
    const wj_real v = i / 300 % 2 ? -(wj_real)0.4 : (wj_real)0.4;
    wj_joint before = *joint;
    before.settings.correct = WJ_OPEN_LOOP;
    before.state.correction = more;
    wj_step(&before, v, (wj_real)NAN, dt);
    wj_step(joint, v, before.found.friction + contact + Normal() / 2, dt);
    error = joint->found.friction - before.found.friction;
  }
  return fabs((double)error);
}

static void LearnsTheLevelButNoContact(void) {
  wj_friction friction = PaperJoint();
  friction.level_std = (wj_real)0.5;
  wj_joint joint;
  wj_begin(&joint, &friction);
  double error = ErrorAfter(&joint, (wj_real)0.8, 0, 120);
  Expect(error < 0.1, "the level after two minutes is off by", error);
  Expect(!joint.found.contact, "contact where there is none", 1);

  // a push for 10 min, from then on
  error = ErrorAfter(&joint, (wj_real)0.8, 2, 600);
  Expect(error < 0.15, "after a push the level is off by", error);
  Expect(joint.found.contact, "contact is not seen", 0);
  error = ErrorAfter(&joint, (wj_real)0.8, 0, 5);
  Expect(!joint.found.contact, "contact is seen after its end", 1);

  // open loop learns nothing
  wj_begin(&joint, &friction);
  joint.settings.correct = WJ_OPEN_LOOP;
  ErrorAfter(&joint, (wj_real)0.3, 0, 60);
  Expect(joint.state.correction == 0, "learnt in open loop", (double)joint.state.correction);
}

static void GoesOnAfterANight(void) {
  wj_friction friction = PaperJoint();
  wj_joint joint, next;
  wj_begin(&joint, &friction);
  for (int i = 0; i < 60000; ++i) wj_step(&joint, (wj_real)0.5, (wj_real)NAN, (wj_real)0.01);
  const wj_state kept = joint.state;
  wj_begin(&next, &friction);
  Expect(wj_restore(&next, &kept, 600) == 1, "not restored", 0);
  const double cooled = (double)kept.energy * exp(-1.0);
  Expect(fabs((double)next.state.energy - cooled) < 1e-6 * fabs(cooled), "heat after 600 s",
         (double)next.state.energy);
  Expect(next.state.variance > kept.variance, "nothing is forgotten", (double)next.state.variance);

  // nobody knows how long
  wj_begin(&next, &friction);
  wj_restore(&next, &kept, (wj_real)NAN);
  Expect(next.state.energy == kept.energy / 2, "heat after an unknown time",
         (double)next.state.energy);
  Expect((double)next.found.std < 1 && next.state.variance > kept.variance + 1, "doubt of it",
         (double)next.state.variance);

  // a gap between two calls cools, too, and a state that is no state is refused
  wj_step(&joint, (wj_real)0.5, (wj_real)NAN, 36000);
  Expect(fabs((double)joint.found.energy) < 1e-6, "heat after a gap of ten hours",
         (double)joint.found.energy);
  wj_state broken = kept;
  broken.energy = (wj_real)NAN;
  wj_begin(&next, &friction);
  Expect(wj_restore(&next, &broken, 1) == 0 && next.state.energy == 0, "a broken state was taken",
         0);
}

static void DoesNotBelieveEverySample(void) {
  wj_friction friction = PaperJoint();
  wj_joint joint, other;
  wj_begin(&joint, &friction);
  ErrorAfter(&joint, 0, 0, 30);
  other = joint;
  // one spike changes the level by less than its own deviations
  wj_step(&joint, (wj_real)0.4, (wj_real)1e9, (wj_real)0.01);
  const double change = fabs((double)(joint.state.correction - other.state.correction));
  Expect(change <= 3.8 * sqrt((double)other.state.variance), "a spike changed the level by",
         change);
  // a sample again tells nothing; one without velocity compensates nothing, and heats as the last
  joint = other;
  wj_step(&joint, (wj_real)0.4, 17, (wj_real)0.01);
  const wj_real learnt = joint.state.correction, loss = joint.found.loss;
  for (int i = 0; i < 100; ++i) wj_step(&joint, (wj_real)0.4, 17, (wj_real)0.01);
  Expect(joint.state.correction == learnt, "learnt from a sample that was repeated",
         (double)joint.state.correction);
  Expect(wj_step(&joint, (wj_real)NAN, 17, (wj_real)0.01) == 0, "compensates without a velocity",
         1);
  Expect(wj_abs(joint.found.loss - loss) < loss / 10, "heat of a lost sample",
         (double)joint.found.loss);
  for (int i = 0; i < 200; ++i) wj_step(&joint, (wj_real)NAN, 17, (wj_real)0.01);
  Expect(joint.found.loss == 0, "heats without a velocity for ever", (double)joint.found.loss);
}

/// A number that a controller should not get, or a usual one.
static wj_real Hostile(void) {
  static const double bad[] = {0,      -0.0, 1e-320, -1e-42, 1e30,   -1e30, 1e300,
                               -1e300, 3e38, 1e-3,   0.001,  -0.001, 3.2e7, 1,
                               -1,     0.5,  1e-300, 100,    -100,   17};
  switch (rand() % 4) {
    case 0:
      return (wj_real)bad[(size_t)rand() % (sizeof bad / sizeof bad[0])];
    case 1:
      return rand() % 2 ? (wj_real)NAN : rand() % 2 ? (wj_real)INFINITY : -(wj_real)INFINITY;
    default:
      return Uniform() * (rand() % 2 ? 1 : 20);
  }
}

static void HoldsItsPromisesWhateverComes(int calls) {
  wj_friction friction = PaperJoint();
  friction.static_rise = 3;
  friction.stribeck_velocity = (wj_real)0.1;
  friction.stribeck_exponent = (wj_real)1.4;
  friction.second_thermal_gain = (wj_real)0.2;
  friction.second_thermal_time_constant = 3600;
  friction.viscous_per_energy = (wj_real)0.1;
  friction.load_gain = (wj_real)0.1;
  wj_joint joint;
  wj_begin(&joint, &friction);
  for (int i = 0; i < calls; ++i) {
    if (rand() % 50 == 0) {
      joint.at.load = Hostile();
      joint.at.position = Hostile();
      joint.at.ambient_rise = Hostile();
      joint.at.reference = rand() % 2 ? (wj_real)NAN : Hostile();
      joint.settings.heat = rand() % 2 ? WJ_HEAT_BY_MODEL : WJ_HEAT_BY_TORQUE;
      joint.settings.share = rand() % 4 ? (wj_real)0.9 : Hostile();
      joint.settings.dead_band = rand() % 2 ? 0 : (wj_real)0.01;
    }
    if (rand() % 1000 == 0) {
      const wj_state kept = joint.state;
      wj_begin(&joint, &friction);
      wj_restore(&joint, &kept, rand() % 2 ? (wj_real)3.2e7 : Hostile());
    }
    const wj_real v = Hostile(), correction = joint.state.correction;
    const wj_real torque = wj_step(&joint, v, Hostile(), rand() % 2 ? (wj_real)0.001 : Hostile());
    // by which velocity, and what the model says of it
    const wj_real asked = joint.at.reference == joint.at.reference ? joint.at.reference : v;
    const wj_real most = joint.settings.most_speed, share = joint.settings.share;
    const wj_real by = asked == asked ? wj_within(asked, most) : 0;
    const wj_real whole = wj_abs(wj_sliding(&joint, by, correction));
    const wj_real limit = (share > 0 ? share < 1 ? share : 1 : 0) * whole;
    const int finite = wj_is_number(torque), sided = torque == 0 || wj_sign(torque) == wj_sign(by);
    if (finite && sided && wj_abs(torque) <= limit * (wj_real)1.00001 &&
        wj_is_number(joint.state.energy) && wj_is_number(joint.state.variance) &&
        wj_is_number(joint.found.loss)) {
      continue;
    }
    Expect(0, "hostile call", (double)torque);
    printf("  call %d: v %g, limit %g, energy %g, loss %g, variance %g\n", i, (double)by,
           (double)limit, (double)joint.state.energy, (double)joint.found.loss,
           (double)joint.state.variance);
    return;
  }
}

/// A joint of 1 kg.m^2 with friction behind a drive, compensated from a measured velocity with noise, that is pushed each 5 s;
/// returns its largest speed in the last second before each push.
static double SpeedAtRest(wj_real dead_band, wj_real noise) {
  wj_friction friction = PaperJoint();
  wj_joint joint;
  wj_begin(&joint, &friction);
  joint.settings.dead_band = dead_band;
  const double h = 1e-3, level = 15, viscous = 5, kp = 200, kd = 20;
  double q = 0, v = 0, largest = 0;
  for (int i = 0; i < 60000; ++i) {
    const int within = i % 5000;
    const double push = within < 300 ? (i / 5000 % 2 ? -60 : 60) : 0;
    const wj_real seen = (wj_real)v + noise * Normal();
    const double drive = -kp * q - kd * (double)seen + push +
                         (double)wj_step(&joint, seen, (wj_real)NAN, (wj_real)h);
    // it sticks where its level, or what is left of it, holds the drive
    const double free = v + h * drive, most = h * level;
    v = fabs(free) <= most ? 0 : (free - (free > 0 ? most : -most)) / (1 + h * viscous);
    q += h * v;
    if (within > 4000) largest = fmax(largest, fabs(v));
  }
  return largest;
}

static void APushedJointComesToRest(void) {
  const double quiet = SpeedAtRest(0, 0), noisy = SpeedAtRest((wj_real)0.03, (wj_real)0.01);
  Expect(quiet == 0, "a pushed joint is not at rest, rad/s", quiet);
  Expect(noisy == 0, "a pushed joint with noise is not at rest, rad/s", noisy);
}

static void TakesLittleTime(int calls) {
  wj_friction friction = PaperJoint();
  wj_joint joint;
  wj_begin(&joint, &friction);
  wj_real sum = 0;
  const clock_t begin = clock();
  for (int i = 0; i < calls; ++i) {
    const wj_real v = (wj_real)(i % 1000) * (wj_real)1e-3 - (wj_real)0.5;
    sum += wj_step(&joint, v, v * 30, (wj_real)0.001);
  }
  const double each = (double)(clock() - begin) / CLOCKS_PER_SEC / calls;
  printf("wj_step %.1f ns (%g)\n", each * 1e9, (double)sum);
}

int main(int count, char** arguments) {
  const int calls = count > 1 ? atoi(arguments[1]) : 1000000;
  srand(1);
  FollowsTheRecordings();
  KeepsItsHeatInSmallSteps();
  LearnsTheLevelButNoContact();
  GoesOnAfterANight();
  DoesNotBelieveEverySample();
  HoldsItsPromisesWhateverComes(calls);
  APushedJointComesToRest();
  TakesLittleTime(calls);
  return failures > 0;
}
