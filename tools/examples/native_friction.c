// Warm friction without a plugin: drives the joint springs that `warmjoint attach --as native` wrote. Prints time, position and heat of the first joint.
//   cc native_friction.c -lmujoco -lm && ./a.out warm.xml 600
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

static double Number(
    const mjModel* m, const char* name,
    int joint) {  // of an array that attach wrote; 0 where the frictions have none such
  const int id = mj_name2id(m, mjOBJ_NUMERIC, name);
  return id < 0 ? 0 : m->numeric_data[m->numeric_adr[id] + joint];
}

// The driver: after a step, the heat E of each joint and from it the yield of its spring.
static void Warm(mjModel* m, const mjData* d, double* E) {
  const int list = mj_name2id(m, mjOBJ_TUPLE, "native");
  for (int i = 0; i < m->tuple_size[list]; ++i) {
    const int j = m->tuple_objid[m->tuple_adr[list] + i], dof = m->jnt_dofadr[j];
    const double v = d->qvel[dof], k = m->jnt_stiffness[j],
                 tau = Number(m, "native/thermal_time_constant", i);
    const double z = d->qpos[m->jnt_qposadr[j]] - d->plastic[m->jnt_plasticadr[j]],
                 yield = m->jnt_springyield[j];
    const int slides = fabs(z) >= (1 - 1e-6) * yield && z * v > 0;
    const double W = m->dof_damping[dof] * v * v + (slides ? k * yield * fabs(v) : 0);
    if (tau > 0)
      E[i] += -expm1(-m->opt.timestep / tau) * (Number(m, "native/thermal_gain", i) * W - E[i]);
    m->jnt_springyield[j] = fmax(0, Number(m, "native/coulomb", i) + E[i]) / k;
  }
}

int main(int count, char** arguments) {
  char error[1000] = "";
  mjModel* m = count == 3 ? mj_loadXML(arguments[1], NULL, error, sizeof error) : NULL;
  if (!m) return fprintf(stderr, "give a model and seconds: %s\n", error), 2;
  mjData* d = mj_makeData(m);
  double* E = calloc((size_t)m->njnt, sizeof *E);
  const int steps = (int)lround(atof(arguments[2]) / m->opt.timestep);
  for (int i = 0; i < m->nu; ++i) d->ctrl[i] = 1;
  for (int step = 1; step <= steps; ++step) {
    mj_step(m, d);
    Warm(m, d, E);
    if (step % (steps / 10 + 1) == 0 || step == steps)
      printf("%.9g %.12g %.12g\n", d->time, d->qpos[0], E[0]);
  }
  free(E), mj_deleteData(d), mj_deleteModel(m);
  return 0;
}
