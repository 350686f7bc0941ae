#include "tools/scene/robot_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "models/foundation/bad_input.h"

namespace warmjoint::scene {
namespace {

constexpr int kOversampling = 2;  // drawn pixels for each pixel of the picture, each way
constexpr int kMostGeoms = 2000;

/// Whether a pixel of the geoms' numbers shows none.
bool IsEmpty(const unsigned char* pixel) { return pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0; }

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
  context_.Publish();
  scene_ = std::make_unique<Scene>(model);
  mjrContext& renderer = scene_->renderer;
  // drawn larger than asked for, since shrinking smooths the edges
  mjr_makeContext(&model, &renderer, mjFONTSCALE_100);
  mjr_resizeOffscreen(kOversampling * width, kOversampling * height, &renderer);
  mjr_setBuffer(mjFB_OFFSCREEN, &renderer);
  if (renderer.currentBuffer != mjFB_OFFSCREEN) {
    Refuse({}, "OpenGL ({}) cannot draw robots of {} x {} pixels: ask for smaller ones",
           context.Name(), width, height);
  }
}

RobotRenderer::~RobotRenderer() { context_.MakeCurrent(); }

void RobotRenderer::SetUp(const mjData& data, const ViewFrom& from) {
  context_.MakeCurrent();
  mjr_setBuffer(mjFB_OFFSCREEN, &scene_->renderer);
  // the camera looks at the middle of the robot from as far as its size needs
  mjvCamera camera;
  mjv_defaultCamera(&camera);
  for (int i = 0; i < 3; ++i) camera.lookat[i] = model_.stat.center[i] + from.beside[i];
  camera.azimuth = from.azimuth;
  camera.elevation = from.elevation;
  camera.distance = from.distance * model_.stat.extent;
  mjvOption option;
  mjv_defaultOption(&option);
  // MuJoCo fills a scene from data that it takes as changeable, and leaves them as they are
  mjv_updateScene(&model_, const_cast<mjData*>(&data), &option, nullptr, &camera, mjCAT_ALL,
                  &scene_->scene);
}

std::vector<unsigned char> RobotRenderer::Render(Paint paint) {
  const mjrRect area{0, 0, kOversampling * width_, kOversampling * height_};
  std::vector<unsigned char> pixels(std::size_t{3} * area.width * area.height);
  mjvScene& scene = scene_->scene;
  scene.flags[mjRND_SEGMENT] = scene.flags[mjRND_IDCOLOR] = paint == Paint::geoms;
  mjr_render(area, &scene, &scene_->renderer);
  mjr_readPixels(pixels.data(), nullptr, area, &scene_->renderer);
  return pixels;
}

void Covered::Join(const Covered& other) {
  left = std::min(left, other.left);
  right = std::max(right, other.right);
  lower = std::min(lower, other.lower);
  upper = std::max(upper, other.upper);
}

Covered RobotRenderer::Box(const mjData& data, const ViewFrom& from) {
  SetUp(data, from);
  const std::vector<unsigned char> mask = Render(Paint::geoms);
  const int width = kOversampling * width_, height = kOversampling * height_;
  Covered covered;
  // GL counts rows from the bottom
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (IsEmpty(&mask[3 * (static_cast<std::size_t>(y) * width + x)])) continue;
      const double right = (2.0 * x + 1) / width - 1, up = (2.0 * y + 1) / height - 1;
      covered.Join({right, right, up, up});
    }
  }
  return covered;
}

ViewFrom RobotRenderer::Closer(const ViewFrom& from, const Covered& covered, double share) const {
  if (covered.left > covered.right) return from;
  // half of what the picture shows at the point that is looked at, m
  const double angle = model_.vis.global.fovy / 2 * mjPI / 180;
  const double half = from.distance * model_.stat.extent * std::tan(angle);
  const double right = half * width_ / height_ * (covered.left + covered.right) / 2;
  const double up = half * (covered.lower + covered.upper) / 2;
  // the point moves within the plane of the picture
  const double azimuth = from.azimuth * mjPI / 180, elevation = from.elevation * mjPI / 180;
  const std::array<double, 3> to_right{std::sin(azimuth), -std::cos(azimuth), 0};
  const std::array<double, 3> upwards{-std::sin(elevation) * std::cos(azimuth),
                                      -std::sin(elevation) * std::sin(azimuth),
                                      std::cos(elevation)};
  ViewFrom closer = from;
  for (std::size_t i = 0; i < 3; ++i) closer.beside[i] += right * to_right[i] + up * upwards[i];
  // and the nearest edge gets as near as is asked for
  const double reach = std::max(covered.right - covered.left, covered.upper - covered.lower) / 2;
  closer.distance *= reach / share;
  return closer;
}

void RobotRenderer::AddFloor(const mjData& data) {
  mjvScene& scene = scene_->scene;
  if (scene.ngeom >= scene.maxgeom) return;
  // a thin disc below the base, which is the first body that stands in the world
  const double* base = model_.nbody > 1 ? data.xpos + 3 : data.xpos;
  const mjtNum extent = model_.stat.extent;
  const mjtNum size[3] = {0.3 * extent, 0.002 * extent, 0};  // radius, half of the height
  const mjtNum at[3] = {base[0], base[1], base[2] - 1.5 * size[1]};
  const float grey[4] = {0.93f, 0.94f, 0.95f, 1};
  mjvGeom* floor = &scene.geoms[scene.ngeom++];
  mjv_initGeom(floor, mjGEOM_CYLINDER, size, at, nullptr, grey);
  floor->emission = 0.3f;  // as light from above as from the side
  floor->segid = scene.ngeom - 1;
}

Pixel RobotRenderer::PlaceOf(const std::array<double, 3>& point) const {
  const mjvGLCamera eye = mjv_averageCamera(&scene_->scene.camera[0], &scene_->scene.camera[1]);
  // to the right, up and away from the eye
  double right = 0, up = 0, away = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double offset = point[i] - eye.pos[i];
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    right += offset * (eye.forward[j] * eye.up[k] - eye.forward[k] * eye.up[j]);
    up += offset * eye.up[i];
    away += offset * eye.forward[i];
  }
  // half of what the picture shows, at the near plane
  const double half = (eye.frustum_top - eye.frustum_bottom) / 2.0;
  const double scale = height_ / 2.0 / half * eye.frustum_near / away;
  return {width_ / 2.0 + scale * right, height_ / 2.0 - scale * up};
}

Image RobotRenderer::Draw(const mjData& data, const ViewFrom& from, Rgb background) {
  SetUp(data, from);
  AddFloor(data);
  // colours of the robot, and a mask that tells it from the background
  const std::vector<unsigned char> colours = Render(Paint::colours), mask = Render(Paint::geoms);
  Image image{kOversampling * width_, kOversampling * height_,
              std::vector<std::uint8_t>(colours.size())};
  // GL counts rows from the bottom
  const std::size_t row = std::size_t{3} * image.width;
  const std::uint8_t plain[3] = {background.red, background.green, background.blue};
  for (int y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < row; x += 3) {
      const std::size_t source = row * (image.height - 1 - y) + x;
      std::memcpy(&image.pixels[row * y + x], IsEmpty(&mask[source]) ? plain : &colours[source], 3);
    }
  }
  return Shrink(image, kOversampling);
}

}  // namespace warmjoint::scene
