// Warm friction without a plugin: drives the joint springs that `warmjoint attach --as native` wrote. Prints time, position and heat of the first joint.
//   cc -I../../models/include native_friction.c -lmujoco -lm && ./a.out warm.xml 600
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>
#include <warmjoint/compensate.h>

static double Number(
    const mjModel* m, const char* name,
    int joint) {  // of an array that attach wrote; 0 where the frictions have none such
  const int id = mj_name2id(m, mjOBJ_NUMERIC, name);
  return id < 0 ? 0 : m->numeric_data[m->numeric_adr[id] + joint];
}

// The i-th joint's friction, cold.
static void Begin(const mjModel* m, int i, int dof, wj_joint* joint) {
  wj_friction of = {0};
  of.viscous = m->dof_damping[dof];
  of.coulomb_positive = of.coulomb_negative = Number(m, "native/coulomb", i);
  of.static_rise = fmax(0, Number(m, "native/static", i) - of.coulomb_positive);
  of.stribeck_velocity = Number(m, "native/stribeck_velocity", i);
  of.stribeck_exponent = Number(m, "native/stribeck_exponent", i);
  of.thermal_gain = Number(m, "native/thermal_gain", i);
  of.thermal_time_constant = Number(m, "native/thermal_time_constant", i);
  of.second_thermal_gain = Number(m, "native/second_thermal_gain", i);
  of.second_thermal_time_constant = Number(m, "native/second_thermal_time_constant", i);
  wj_begin(joint, &of);
  joint->state.energy = Number(m, "native/initial_energy", i);
  joint->state.second_energy = Number(m, "native/second_initial_energy", i);
}

// The driver: after a step, the heat of each joint and from it the yield of its spring.
static void Warm(mjModel* m, const mjData* d, const int* of, int count, wj_joint* joints) {
  for (int i = 0; i < count; ++i) {
    const double v = d->qvel[m->jnt_dofadr[of[i]]];
    wj_step(&joints[i], v, NAN, 0);                // what it loses at this speed
    wj_step(&joints[i], v, NAN, m->opt.timestep);  // and how warm it is a step later
    const double level = wj_law_level(&joints[i].friction, 1, fabs(v)) + joints[i].found.energy;
    m->jnt_springyield[of[i]] = fmax(0, level) / m->jnt_stiffness[of[i]];
  }
}

int main(int count, char** arguments) {
  char error[1000] = "";
  mjModel* m = count == 3 ? mj_loadXML(arguments[1], NULL, error, sizeof error) : NULL;
  const int list = m ? mj_name2id(m, mjOBJ_TUPLE, "native") : -1;
  if (list < 0) return fprintf(stderr, "give a model with springs, and seconds: %s\n", error), 2;
  mjData* d = mj_makeData(m);
  const int joints = m->tuple_size[list], *of = m->tuple_objid + m->tuple_adr[list];
  wj_joint* state = calloc((size_t)joints, sizeof *state);
  for (int i = 0; i < joints; ++i) Begin(m, i, m->jnt_dofadr[of[i]], &state[i]);
  const int steps = (int)lround(atof(arguments[2]) / m->opt.timestep);
  for (int i = 0; i < m->nu; ++i) d->ctrl[i] = 1;
  for (int step = 1; step <= steps; ++step) {
    mj_step(m, d);
    Warm(m, d, of, joints, state);
    if (step % (steps / 10 + 1) == 0 || step == steps)
      printf("%.9g %.12g %.12g\n", d->time, d->qpos[0], state[0].found.energy);
  }
  free(state), mj_deleteData(d), mj_deleteModel(m);
  return 0;
}
