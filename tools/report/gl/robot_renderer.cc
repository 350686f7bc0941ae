#include "tools/report/gl/robot_renderer.h"

#include <cstring>

#include "models/foundation/bad_input.h"

namespace warmjoint::report {
namespace {

constexpr int kOversampling = 2;  // drawn pixels for each pixel of the picture, each way
constexpr int kMostGeoms = 2000;

}  // namespace

struct RobotRenderer::Scene {
  explicit Scene(const mjModel& model) {
    mjv_defaultScene(&scene);
    mjr_defaultContext(&renderer);
    mjv_makeScene(&model, &scene, kMostGeoms);
  }
  ~Scene() {
    mjv_freeScene(&scene);
    mjr_freeContext(&renderer);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  mjvScene scene;
  mjrContext renderer;
};

RobotRenderer::RobotRenderer(GlContext& context, const mjModel& model, int width, int height)
    : context_(context), model_(model), width_(width), height_(height) {
  context_.MakeCurrent();
  scene_ = std::make_unique<Scene>(model);
  mjrContext& renderer = scene_->renderer;
  mjr_makeContext(&model, &renderer, mjFONTSCALE_100);
  mjr_resizeOffscreen(kOversampling * width, kOversampling * height, &renderer);
  mjr_setBuffer(mjFB_OFFSCREEN, &renderer);
  if (renderer.currentBuffer != mjFB_OFFSCREEN) {
    Refuse({}, "OpenGL ({}) cannot draw robots of {} x {} pixels: ask for smaller ones",
           context.Name(), width, height);
  }
}

RobotRenderer::~RobotRenderer() { context_.MakeCurrent(); }

Image RobotRenderer::Draw(const mjData& data, const ViewFrom& from, Rgb background) {
  context_.MakeCurrent();
  mjvScene& scene = scene_->scene;
  mjrContext& renderer = scene_->renderer;
  mjr_setBuffer(mjFB_OFFSCREEN, &renderer);

  mjvCamera camera;
  mjv_defaultCamera(&camera);
  std::memcpy(camera.lookat, model_.stat.center, sizeof camera.lookat);
  camera.azimuth = from.azimuth;
  camera.elevation = from.elevation;
  camera.distance = from.distance * model_.stat.extent;
  mjvOption option;
  mjv_defaultOption(&option);
  // MuJoCo fills a scene from data that it takes as changeable, and leaves them as they are
  mjv_updateScene(&model_, const_cast<mjData*>(&data), &option, nullptr, &camera, mjCAT_ALL,
                  &scene);

  const mjrRect area{0, 0, kOversampling * width_, kOversampling * height_};
  const std::size_t row = std::size_t{3} * static_cast<std::size_t>(area.width);
  std::vector<unsigned char> colours(row * area.height), mask(colours.size());
  scene.flags[mjRND_SEGMENT] = scene.flags[mjRND_IDCOLOR] = 0;
  mjr_render(area, &scene, &renderer);
  mjr_readPixels(colours.data(), nullptr, area, &renderer);
  // once more by number of the geom: 0 where there is none
  scene.flags[mjRND_SEGMENT] = scene.flags[mjRND_IDCOLOR] = 1;
  mjr_render(area, &scene, &renderer);
  mjr_readPixels(mask.data(), nullptr, area, &renderer);

  // GL counts rows from the bottom
  Image image{area.width, area.height, std::vector<std::uint8_t>(colours.size())};
  for (int y = 0; y < area.height; ++y) {
    for (std::size_t x = 0; x < row; x += 3) {
      const std::size_t source = row * (area.height - 1 - y) + x;
      const bool empty = mask[source] == 0 && mask[source + 1] == 0 && mask[source + 2] == 0;
      const std::uint8_t plain[3] = {background.red, background.green, background.blue};
      std::memcpy(&image.pixels[row * y + x], empty ? plain : &colours[source], 3);
    }
  }
  return Shrink(image, kOversampling);
}

}  // namespace warmjoint::report
