// Rolls the model out with the plugin, from C++: rollout PLUGIN MODEL OUT writes qpos, qvel, act of
// every step.
#include <mujoco/mujoco.h>

#include <cstdio>

int main(int, char** arguments) {
  mj_loadPluginLibrary(arguments[1]);
  char error[1000] = "";
  mjModel* model = mj_loadXML(arguments[2], nullptr, error, sizeof error);
  if (!model) return std::fprintf(stderr, "%s\n", error), 1;
  mjData* data = mj_makeData(model);
  std::FILE* out = std::fopen(arguments[3], "wb");

  for (int step = 0; step < 20000; ++step) {
    data->ctrl[0] = step / 2500 % 2 == 0 ? 9 : -9;  // N.m, reversed every 2.5 s
    mj_step(model, data);
    std::fwrite(data->qpos, sizeof(mjtNum), model->nq, out);
    std::fwrite(data->qvel, sizeof(mjtNum), model->nv, out);
    std::fwrite(data->act, sizeof(mjtNum), model->na, out);
  }
  return std::fclose(out);
}
