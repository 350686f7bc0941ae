// load_model MODEL.xml: loads the plugin into MuJoCo and takes a step of a model that needs it; 0 where both work.
#include <mujoco/mujoco.h>

#include <cstdio>

int main(int, char** arguments) {
  mj_loadPluginLibrary(PLUGIN);
  char error[1000] = "";
  mjModel* model = mj_loadXML(arguments[1], nullptr, error, sizeof error);
  if (!model) {
    std::fprintf(stderr, "%s\n", error);
    return 1;
  }
  mjData* data = mj_makeData(model);
  data->qvel[0] = 1;
  mj_step(model, data);
  const bool brakes = data->qvel[0] < 1;
  std::printf("plugin loaded: %d actuator, %g rad/s after a step\n",
              static_cast<int>(model->nactuator), data->qvel[0]);
  mj_deleteData(data);
  mj_deleteModel(model);
  return brakes ? 0 : 1;
}
