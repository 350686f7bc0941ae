// Friction of one joint on a robot's controller: what to add to a motor's torque so that the joint moves as if it had less
// friction, while the joint warms and cools. C99 and C++, no allocation, math.h alone; float in place of double where
// WJ_FLOAT is defined before it is included. Not for -ffast-math: it tells NaN from numbers.
//
//   wj_friction elbow = {};              // numbers: warmjoint export estimate.json --to c
//   elbow.viscous = 5;
//   elbow.coulomb_positive = elbow.coulomb_negative = 15;
//   elbow.thermal_gain = -0.75;
//   elbow.thermal_time_constant = 600;
//   wj_joint joint;
//   wj_begin(&joint, &elbow);            // cold
//   const double measured = 17.2;        // N.m, less weight and inertia; NAN: open loop
//   const double torque = wj_step(&joint, 0.5, measured, 0.001);
#pragma once

#include <math.h>

#ifdef WJ_FLOAT
typedef float wj_real;
#define WJ_MATH(name) name##f
#else
typedef double wj_real;
#define WJ_MATH(name) name
#endif

/// Kernels of one axis of a map, at most; they stand on the stack.
#ifndef WJ_MOST_CENTRES
#define WJ_MOST_CENTRES 128
#endif
#define WJ_MOST_AXES 4

/// No number is larger, N.m, N or W. why: its square is finite in float.
#define WJ_LARGEST ((wj_real)1e18)

/// Standard deviation of a friction whose covariance is not given, as a share of its level. why: identify refuses an answer
/// that changes friction by more than a tenth of its rms; a tenth as five deviations.
#define WJ_UNKNOWN_SHARE ((wj_real)0.02)

/// What a map depends on, and what its kernels are multiplied by: 1, sign(v) or v.
typedef enum { WJ_POSITION, WJ_MOTOR_POSITION, WJ_VELOCITY, WJ_ENERGY, WJ_LOAD } wj_quantity;
typedef enum { WJ_BY_ONE, WJ_BY_DIRECTION, WJ_BY_VELOCITY } wj_factor;
typedef enum { WJ_NORMALISED, WJ_PLAIN } wj_kernels;
typedef enum { WJ_TOGETHER, WJ_APART } wj_sides;

/// Gaussian kernels exp(-(x - c)^2 / (2 width^2)) over one quantity, in its unit.
typedef struct {
  wj_quantity quantity;
  wj_sides sides;          // apart: kernels act on their own side of 0 alone
  int count;               // of centres, at most WJ_MOST_CENTRES
  const wj_real* centres;  // [count], ascending
  wj_real width;
  wj_real period;  // of a circle; 0: none
} wj_axis;

/// factor(v) sum_i w_i kappa_i, Eqs. (10) to (16), N.m or N.
typedef struct {
  int axis_count;
  wj_axis axes[WJ_MOST_AXES];
  wj_kernels kernels;
  wj_factor factor;
  const wj_real* weights;  // one for each product of kernels, the last axis the fastest
} wj_map;

/// The numbers of a friction file; SI, and N, m in place of N.m, rad for linear joints. 0 leaves out what it belongs to.
///   F = (kv + b E) v + sign(v) (g + E + c |load|) + maps,  g = kc+ or kc- + rise exp(-(|v| / vs)^delta)
/// Laws with a bristle of their own slide so, too.
typedef struct {
  wj_real viscous;                              // kv, N.m.s/rad
  wj_real coulomb_positive, coulomb_negative;   // kc of each direction, N.m
  wj_real static_rise;                          // N.m
  wj_real stribeck_velocity;                    // vs, rad/s
  wj_real stribeck_exponent;                    // delta; 0: 2
  wj_real thermal_gain, thermal_time_constant;  // k, N.m/W; tau, s
  wj_real second_thermal_gain, second_thermal_time_constant;
  wj_real level_per_temperature;  // kT, N.m/K
  wj_real viscous_per_energy;     // b, s/rad
  wj_real load_gain;              // c
  wj_real gear;                   // motor turns for each joint turn; 0: 1
  int map_count;
  const wj_map* maps;  // [map_count]
  wj_real level_std;   // standard deviation of the cold level, N.m; 0: WJ_UNKNOWN_SHARE of it
  wj_real
      heat_std;  // of the settled heat, N.m; 0: WJ_UNKNOWN_SHARE of the level, without heat half of it within 20 min
  wj_real
      noise;  // standard deviation of a measured torque about the friction, N.m; 0: 5 % of the level
  wj_real noise_time;  // for which such errors last, s; 0: each sample has one of its own
} wj_friction;

/// What the heat comes from: the modelled friction, or the measured torque while there is one and no contact.
typedef enum { WJ_HEAT_BY_MODEL, WJ_HEAT_BY_TORQUE } wj_heat_source;
typedef enum { WJ_CORRECTED, WJ_OPEN_LOOP } wj_correction;

/// How to compensate; wj_begin sets the defaults.
typedef struct {
  wj_real share;  // of the friction that is compensated, 0 to 1; 0.9. Above 1 a joint runs away.
  wj_real
      dead_band;  // rad/s: no torque below, all of it from twice that on; 0. Some deviations of the velocity's noise
  wj_real most_speed;   // rad/s; a faster one counts as this; 1000. The joint's limit
  wj_real longest_gap;  // s; of a longer time between two calls the rest is rest; 1
  wj_real
      contact_time;  // s, over which the residual is averaged to find a contact; 0.25 + 8 noise_time
  wj_real
      deviations;  // beyond which a residual is a contact; 3.8: once an hour by chance in windows of 0.25 s
  wj_heat_source heat;    // WJ_HEAT_BY_MODEL
  wj_correction correct;  // WJ_CORRECTED
} wj_settings;

/// Where the joint is; wj_begin sets 0, and NAN where that has a meaning. Set what is known before each wj_step.
typedef struct {
  wj_real position;        // rad
  wj_real motor_position;  // rad; NAN: gear times position
  wj_real load;            // that the joint transmits, N.m
  wj_real ambient_rise;    // Ts - T0, K
  wj_real
      reference;  // velocity that is asked for, rad/s, by which the torque is made; NAN: the measured one
} wj_place;

/// What is to be kept while the power is off.
typedef struct {
  wj_real energy, second_energy;  // E1, E2, N.m
  wj_real correction;             // of the level, N.m
  wj_real variance;               // of the level, N.m^2
} wj_state;

/// What a step found.
typedef struct {
  wj_real friction;  // at the measured velocity, with the correction, N.m
  wj_real residual;  // measured torque - friction, N.m; NAN at rest and without a torque
  wj_real energy;    // E1 + E2, N.m
  wj_real std;       // standard deviation of `friction` by the level's variance, N.m
  wj_real loss;      // W
  int contact;  // 1: the residual is more than friction explains, and the correction stands still
} wj_found;

typedef struct {
  wj_friction friction;
  wj_settings settings;
  wj_place at;
  wj_state state;
  wj_found found;
  // of the steps so far
  wj_real lost_digits[2];              // of E1 and E2, which a sum of small steps would lose
  wj_real step, cooling[2];            // the last dt, s, and 1 - exp(-dt / tau)
  wj_real walk;                        // q, N.m^2/s
  wj_real lost_time;                   // s, since a velocity was known
  wj_real mean_residual;               // N.m
  wj_real last_velocity, last_torque;  // of samples that repeat
} wj_joint;

static inline wj_real wj_abs(wj_real x) { return WJ_MATH(fabs)(x); }
static inline wj_real wj_largest(wj_real a, wj_real b) { return a > b ? a : b; }
static inline wj_real wj_within(wj_real x, wj_real most) {
  return x > most ? most : x < -most ? -most : x;
}
static inline int wj_is_number(wj_real x) { return x - x == 0; }
/// x within what may be squared; `otherwise` where it is no number.
static inline wj_real wj_number(wj_real x, wj_real otherwise) {
  return x == x ? wj_within(x, WJ_LARGEST) : otherwise;
}
static inline wj_real wj_sign(wj_real x) { return (wj_real)((x > 0) - (x < 0)); }

/// The kernels of an axis at x that are not 0, into value and index, [WJ_MOST_CENTRES] each; returns how many there are.
static inline int wj_kernels_at(const wj_axis* axis, wj_kernels kind, wj_real x, wj_real* value,
                                int* index) {
  int count = 0;
  wj_real largest = 0, sum = 0;
  // exponents of those on the side of x
  for (int i = 0; i < axis->count && i < WJ_MOST_CENTRES; ++i) {
    wj_real distance = x - axis->centres[i];
    if (axis->sides == WJ_APART && !(wj_sign(x) * wj_sign(axis->centres[i]) > 0)) continue;
    if (axis->period > 0) {
      distance -= axis->period * WJ_MATH(floor)(distance / axis->period + (wj_real)0.5);
    }
    value[count] = -distance * distance / (2 * axis->width * axis->width);
    if (count == 0 || value[count] > largest) largest = value[count];
    index[count++] = i;
  }

  // normalised by the largest, so that they do not become 0/0 far from every centre
  if (kind == WJ_PLAIN) largest = 0;
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const wj_real exponent = value[i] - largest;
    // exp(-40) is beyond the last digit of a sum with the largest
    if (exponent < -40) continue;
    value[kept] = WJ_MATH(exp)(exponent);
    index[kept] = index[i];
    sum += value[kept++];
  }
  for (int i = 0; kind == WJ_NORMALISED && i < kept; ++i) value[i] /= sum;
  return kept;
}

/// point: a value of each wj_quantity.
static inline wj_real wj_map_at(const wj_map* map, const wj_real* point) {
  wj_real value[WJ_MOST_AXES][WJ_MOST_CENTRES];
  int index[WJ_MOST_AXES][WJ_MOST_CENTRES], count[WJ_MOST_AXES], at[WJ_MOST_AXES];
  const int axes = map->axis_count;
  for (int a = 0; a < axes; ++a) {
    const wj_axis* axis = &map->axes[a];
    count[a] = wj_kernels_at(axis, map->kernels, point[axis->quantity], value[a], index[a]);
    if (count[a] == 0) return 0;
    at[a] = 0;
  }

  // all products of one kernel of each axis
  wj_real sum = 0;
  for (int a = axes; a >= 0;) {
    wj_real product = 1;
    int place = 0;
    for (int k = 0; k < axes; ++k) {
      product *= value[k][at[k]];
      place = place * map->axes[k].count + index[k][at[k]];
    }
    sum += product * map->weights[place];
    for (a = axes - 1; a >= 0 && ++at[a] == count[a]; --a) at[a] = 0;
  }
  const wj_real v = point[WJ_VELOCITY];
  return sum * (map->factor == WJ_BY_VELOCITY    ? v
                : map->factor == WJ_BY_DIRECTION ? wj_sign(v)
                                                 : 1);
}

/// The motor's angle on its circle, rad.
static inline wj_real wj_motor_angle(const wj_joint* joint) {
  const wj_real turn = (wj_real)6.283185307179586476925286766559;
  const wj_real gear = joint->friction.gear != 0 ? joint->friction.gear : 1;
  const wj_real motor =
      wj_number(joint->at.motor_position, gear * wj_number(joint->at.position, 0));
  return motor - turn * WJ_MATH(floor)(motor / turn);
}

/// The law's level on one side of motion, 1 or -1, at a speed, N.m.
static inline wj_real wj_law_level(const wj_friction* friction, wj_real side, wj_real speed) {
  const wj_real coulomb = side > 0 ? friction->coulomb_positive : friction->coulomb_negative;
  if (friction->static_rise == 0 || !(friction->stribeck_velocity > 0)) return coulomb;
  const wj_real ratio = speed / friction->stribeck_velocity, exponent = friction->stribeck_exponent;
  const wj_real power =
      exponent == 0 || exponent == 2 ? ratio * ratio : WJ_MATH(pow)(ratio, exponent);
  return power > 40 ? coulomb : coulomb + friction->static_rise * WJ_MATH(exp)(-power);
}

/// The level at which a law begins to slide, the mean of both directions, N.m.
static inline wj_real wj_rest_level(const wj_friction* friction) {
  return (friction->coulomb_positive + friction->coulomb_negative) / 2 + friction->static_rise;
}

/// What joins the law's level, N.m: heat, load, maps and `more`; E: E1 + E2.
static inline wj_real wj_added_level(const wj_joint* joint, wj_real v, wj_real energy,
                                     wj_real more) {
  const wj_friction* friction = &joint->friction;
  const wj_real load = wj_number(joint->at.load, 0);
  wj_real level = energy + more + friction->load_gain * wj_abs(load);
  if (friction->map_count > 0) {
    const wj_real point[] = {wj_number(joint->at.position, 0), wj_motor_angle(joint), v, energy,
                             load};
    for (int i = 0; i < friction->map_count; ++i) {
      level += wj_sign(v) * wj_map_at(&friction->maps[i], point);
    }
  }
  return level;
}

/// The friction of steady sliding at v, N.m: brakes or is 0, also where heat or a map takes the level below 0. more: beside
/// the level, N.m.
static inline wj_real wj_sliding(const wj_joint* joint, wj_real v, wj_real more) {
  if (v == 0) return 0;
  const wj_friction* friction = &joint->friction;
  const wj_real side = wj_sign(v), speed = wj_abs(v);
  const wj_real energy = joint->state.energy + joint->state.second_energy;
  const wj_real slope = wj_largest(0, friction->viscous + friction->viscous_per_energy * energy);
  const wj_real level =
      wj_law_level(friction, side, speed) + wj_added_level(joint, v, energy, more);
  return side * wj_within(wj_largest(0, slope * speed + level), WJ_LARGEST);
}

/// E' = E - (1 - te) (E - target), (22); lost: what the last sum lost.
static inline void wj_relax(wj_real* energy, wj_real* lost, wj_real cooling, wj_real target) {
  const wj_real change = cooling * (target - *energy) + *lost;
  const wj_real next = *energy + change;
  *lost = wj_number(change - (next - *energy), 0);
  *energy = wj_number(next, 0);
}

/// 1 - exp(-seconds / tau) of both stages, into [2].
static inline void wj_cooling(const wj_friction* friction, wj_real seconds, wj_real* cooling) {
  const wj_real times[] = {friction->thermal_time_constant, friction->second_thermal_time_constant};
  for (int i = 0; i < 2; ++i) {
    cooling[i] = times[i] > 0 ? -WJ_MATH(expm1)(-seconds / times[i]) : 0;
  }
}

/// Heat after a time in which the joint lost `loss`, W. cooling: of that time, [2].
static inline void wj_warm(wj_joint* joint, wj_real loss, const wj_real* cooling) {
  const wj_friction* friction = &joint->friction;
  const wj_real rise = wj_number(joint->at.ambient_rise, 0);
  const wj_real settled = friction->thermal_gain * loss + friction->level_per_temperature * rise;
  wj_relax(&joint->state.energy, &joint->lost_digits[0], cooling[0], settled);
  wj_relax(&joint->state.second_energy, &joint->lost_digits[1], cooling[1],
           friction->second_thermal_gain * loss);
}

// ---- correction of the level ----
//
// The level is off by b, a random walk with the variance q for each second, which begins with level_std^2. A measured torque
// at which the joint slides shows b with the variance r = noise^2 (1 + 2 noise_time / dt); the filter is Kalman's, and its
// time constant T = sqrt(r dt / q). What the heat gets wrong comes up within a time constant, at s = heat_std / tau: behind such a slope the filter is by s T, and its noise is sqrt(r dt / (2 T)). q makes their squares' sum least:
//   T^3 = r dt / (4 s^2),   q = (16 s^4 r dt)^(1/3)
// It stands still while the mean residual over contact_time is more than `deviations` of what friction and noise explain,
// sqrt(p + noise^2 share), share: of the noise that such a mean keeps. Meanwhile p goes on growing by q: a residual d
// counts as contact for (d / deviations)^2 / q seconds, and as friction from then on. So not told from friction are a contact
// below `deviations` sqrt(p + noise^2 share), one that is there from the start while p is large, one that grows more slowly
// than the filter follows, and one that turns with the motion.

static inline wj_real wj_level_scale(const wj_friction* friction) {
  return wj_abs(wj_rest_level(friction));
}

/// The standard deviations in use, N.m.
static inline wj_real wj_noise(const wj_friction* friction) {
  return friction->noise > 0 ? friction->noise : (wj_real)0.05 * wj_level_scale(friction);
}
static inline wj_real wj_std_or_share(const wj_friction* friction, wj_real given) {
  return given > 0 ? given : WJ_UNKNOWN_SHARE * wj_level_scale(friction);
}

/// The slope of what the heat gets wrong, N.m/s.
static inline wj_real wj_drift(const wj_friction* friction) {
  const wj_real tau = friction->thermal_time_constant, std = friction->heat_std;
  if (tau > 0) return wj_std_or_share(friction, std) / tau;
  // why: a joint whose warming nobody knows may lose half of its level within 20 min
  return std > 0 ? std / 3600 : wj_level_scale(friction) / 2400;
}

/// q for samples that are dt apart, N.m^2/s.
static inline wj_real wj_walk(const wj_friction* friction, wj_real dt) {
  const wj_real slope = wj_drift(friction), square = slope * slope, noise = wj_noise(friction);
  return WJ_MATH(cbrt)(16 * square * square * noise * noise * (dt + 2 * friction->noise_time));
}

/// p after some time.
static inline void wj_doubt(wj_joint* joint, wj_real seconds) {
  joint->state.variance = wj_within(joint->state.variance + joint->walk * seconds, WJ_LARGEST);
}

/// residual: of a joint that slides, N.m; side: of its motion; dt: since the last sample, s.
static inline void wj_learn(wj_joint* joint, wj_real residual, wj_real side, wj_real dt) {
  const wj_friction* friction = &joint->friction;
  const wj_settings* settings = &joint->settings;
  wj_state* state = &joint->state;
  const wj_real noise = wj_noise(friction), r = noise * noise, p = state->variance;
  const wj_real alike = 1 + 2 * wj_largest(0, friction->noise_time) / dt;

  // is the mean residual more than friction and noise explain? spikes count as a little more than that
  const wj_real weight = dt / (wj_largest(0, settings->contact_time) + dt);
  const wj_real kept = weight / (2 - weight) * alike;
  const wj_real limit = settings->deviations * WJ_MATH(sqrt)(p + r * (kept < 1 ? kept : 1));
  const wj_real largest = settings->deviations * WJ_MATH(sqrt)(p + r);
  joint->mean_residual += weight * (wj_within(residual, 4 * largest) - joint->mean_residual);
  joint->found.contact = wj_abs(joint->mean_residual) > limit;
  if (settings->correct == WJ_OPEN_LOOP || joint->found.contact || !(p + r > 0)) return;

  // Kalman's step; no larger than the level itself
  const wj_real gain = p / (p + r * alike);
  const wj_real most =
      wj_largest(wj_level_scale(friction),
                 settings->deviations * wj_std_or_share(friction, friction->level_std));
  state->correction =
      wj_within(state->correction + gain * side * wj_within(residual, largest), most);
  state->variance = p * (1 - gain);
}

// ---- what a controller calls ----

/// The joint is cold, at its defaults.
static inline void wj_begin(wj_joint* joint, const wj_friction* friction) {
  // why: a mean over eight times what an error lasts for keeps a third of it
  const wj_real window = (wj_real)0.25 + 8 * wj_largest(0, friction->noise_time);
  const wj_settings settings = {(wj_real)0.9,     0,           1000, 1, window, (wj_real)3.8,
                                WJ_HEAT_BY_MODEL, WJ_CORRECTED};
  const wj_place place = {0, (wj_real)NAN, 0, 0, (wj_real)NAN};
  const wj_found found = {0, (wj_real)NAN, 0, 0, 0, 0};
  const wj_real std = wj_std_or_share(friction, friction->level_std);
  const wj_state cold = {0, 0, 0, std * std};
  joint->friction = *friction;
  joint->settings = settings;
  joint->at = place;
  joint->state = cold;
  joint->found = found;
  joint->found.std = std;
  joint->lost_digits[0] = joint->lost_digits[1] = 0;
  joint->step = joint->cooling[0] = joint->cooling[1] = 0;
  // why: until the first sample, a controller of 1 kHz
  joint->walk = wj_walk(friction, (wj_real)0.001);
  joint->mean_residual = joint->lost_time = 0;
  joint->last_velocity = joint->last_torque = (wj_real)NAN;
}

/// Time in which the joint does not move: it cools, and what is known of its level gets older. seconds: above 0.
static inline void wj_rest(wj_joint* joint, wj_real seconds) {
  if (!(seconds > 0)) return;
  seconds = wj_number(seconds, 0);
  wj_real cooling[2];
  wj_cooling(&joint->friction, seconds, cooling);
  wj_warm(joint, 0, cooling);
  wj_doubt(joint, seconds);
  joint->found.loss = joint->mean_residual = 0;
}

/// Goes on with a state that was kept (joint->state) after `seconds` without power; NAN: nobody knows how long, so that the
/// heat is between what it was and 0: half of it, with the variance of a uniform distribution. Returns 0, and the joint stays as
/// it was begun, where the state holds no numbers.
static inline int wj_restore(wj_joint* joint, const wj_state* state, wj_real seconds) {
  const wj_real sum = state->energy + state->second_energy + state->correction + state->variance;
  if (!wj_is_number(sum) || state->variance < 0) return 0;
  joint->state = *state;
  if (seconds == seconds) {
    wj_rest(joint, seconds);
    return 1;
  }
  const wj_real energy = state->energy + state->second_energy;
  joint->state.energy /= 2;
  joint->state.second_energy /= 2;
  joint->state.variance = wj_within(state->variance + energy * energy / 12, WJ_LARGEST);
  return 1;
}

/// How much of the level acts at a velocity, 0 to 1: none in the dead band, all from twice that on.
static inline wj_real wj_rise(const wj_joint* joint, wj_real v) {
  const wj_real band = joint->settings.dead_band;
  if (!(band > 0)) return 1;
  const wj_real rise = wj_abs(v) / band - 1;
  return rise < 0 ? 0 : rise > 1 ? 1 : rise;
}

/// Heat by the loss that the last sample left, and doubt, dt later.
static inline void wj_pass(wj_joint* joint, wj_real dt) {
  // what follows from dt is found where it changes
  const wj_real held = dt > joint->settings.longest_gap ? joint->settings.longest_gap : dt;
  if (held != joint->step) {
    joint->step = held;
    wj_cooling(&joint->friction, held, joint->cooling);
    joint->walk = wj_walk(&joint->friction, held);
  }
  wj_warm(joint, joint->found.loss, joint->cooling);
  wj_doubt(joint, held);
  wj_rest(joint, dt - held);
}

/// The loss until the next sample, W, of a joint that slides. v: bounded; torque: measured, or NAN.
static inline wj_real wj_loss(const wj_joint* joint, wj_real v, wj_real torque) {
  const int by_torque = joint->settings.heat == WJ_HEAT_BY_TORQUE && !joint->found.contact;
  const wj_real power = by_torque && wj_is_number(torque) ? wj_largest(0, wj_number(torque, 0) * v)
                                                          : joint->found.friction * v;
  return wj_within(power, WJ_LARGEST);
}

/// A sample. velocity: measured, rad/s or m/s; NAN: lost. torque: measured, of the motor less weight and inertia, N.m or N, with
/// the sign of v where it overcomes friction; NAN: none. dt: time since the last call, s; what is not above 0 repeats a sample.
/// Returns the torque that compensates `share` of the friction, N.m or N: finite, 0 or with the sign of the velocity it is made
/// by, and at most share |F|.
static inline wj_real wj_step(wj_joint* joint, wj_real velocity, wj_real torque, wj_real dt) {
  const wj_settings* settings = &joint->settings;
  wj_found* found = &joint->found;
  const int later = dt > 0 && wj_is_number(dt);
  if (later) wj_pass(joint, dt);

  // friction of the measured motion
  const wj_real most = wj_within(wj_number(settings->most_speed, 0), WJ_LARGEST);
  const wj_real v = wj_within(wj_number(velocity, 0), most);
  const wj_real correction = joint->state.correction;
  found->friction = wj_sliding(joint, v, correction);
  found->energy = joint->state.energy + joint->state.second_energy;
  found->std = WJ_MATH(sqrt)(joint->state.variance);

  // what a measured torque tells; a sample that a bus repeats tells nothing new
  const int slides = v != 0 && wj_abs(v) > settings->dead_band;
  const int is_told = slides && wj_is_number(torque);
  found->residual = is_told ? wj_number(torque, 0) - found->friction : (wj_real)NAN;
  const int is_new = velocity != joint->last_velocity || torque != joint->last_torque;
  joint->last_velocity = velocity;
  joint->last_torque = torque;
  if (is_told && later && is_new) wj_learn(joint, found->residual, wj_sign(v), dt);

  // heat until the next sample; a lost one is as the last, for a while
  joint->lost_time = velocity == velocity ? 0 : joint->lost_time + (later ? dt : 0);
  if (joint->lost_time == 0 || joint->lost_time > settings->longest_gap) {
    found->loss = slides ? wj_loss(joint, v, torque) : 0;
  }

  // what is compensated
  const wj_real asked = joint->at.reference;
  const wj_real by = asked == asked ? wj_within(wj_number(asked, 0), most) : v;
  const wj_real whole = by == v ? found->friction : wj_sliding(joint, by, correction);
  const wj_real share = settings->share > 0 ? settings->share : 0;
  return (share < 1 ? share : 1) * wj_rise(joint, by) * whole;
}
