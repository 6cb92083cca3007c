#include <numbers>

#include "scene/scenes/scene.h"
#include "scene/scenes/shapes.h"

namespace obscura::tools {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct CornellSettings {
  bool sphere = false;
  double gap = 0;
};
template <FieldsOf<CornellSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.sphere, Field{"sphere", "", {}, "A sphere in place of the low block."});
  v(s.gap, Field{"gap", "world units", closed(0, 0.5), "Height at which both hover."});
}

// A block on the floor, turned about the vertical.
void stand(Shapes* shapes, Vec3 foot, double half_width, double half_height, double turn) {
  const double c = std::cos(turn * kDegree), s = std::sin(turn * kDegree);
  shapes->block(foot + Vec3{0, half_height, 0}, Vec3{c, 0, -s} * half_width, {0, half_height, 0},
                Vec3{s, 0, c} * half_width);
}

void build(const CornellSettings& s, std::uint64_t, Scene* scene) {
  Shapes shapes(&scene->mesh);
  // A room of 3.6 x 2 x 2.4, open towards the camera, with walls of 0.1.
  const double w = 1.8, h = 2, d = 1.2, t = 0.1;
  shapes.box({-w - t, -t, -d - t}, {w + t, 0, d});
  shapes.box({-w - t, h, -d - t}, {w + t, h + t, d});
  shapes.box({-w - t, 0, -d - t}, {-w, h, d});
  shapes.box({w, 0, -d - t}, {w + t, h, d});
  shapes.box({-w, 0, -d - t}, {w, h, -d});
  shapes.box({-0.45, h - 0.03, -0.35}, {0.45, h, 0.35});  // the lamp
  stand(&shapes, {-0.62, s.gap, -0.4}, 0.34, 0.68, 17);
  if (s.sphere) {
    shapes.sphere({0.66, 0.38 + s.gap, 0.2}, 0.38);
  } else {
    stand(&shapes, {0.66, s.gap, 0.2}, 0.34, 0.34, -18);
  }
  const Bounds bounds = bounds_of(scene->mesh);
  scene->mesh.scene_size = bounds.longest_side();
  scene->view.eye = {0, 1, 3.45};
  scene->view.look_at = {0, 0.97, 0};
  scene->view.fov_y = 46 * kDegree;
}

}  // namespace

SceneKind cornell_scene() {
  return make_scene_kind("cornell", "A room with two blocks, or a block and a sphere.", build);
}

}  // namespace obscura::tools
