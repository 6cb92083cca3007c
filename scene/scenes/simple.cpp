#include <numbers>

#include "scene/scenes/scene.h"
#include "scene/scenes/shapes.h"

// Scenes whose visibility has a closed form.

namespace obscura::tools {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr Range kLengths{1e-6, 1e6};  // what floats still tell apart from the camera
// Faces that replace infinite ones are this many times as long as the camera's distance.
constexpr double kFar = 40;

struct PlaneSettings {
  double tilt_x = 30;  // degrees
  double tilt_y = 0;   // degrees
  double side = 100;   // world units
};
template <FieldsOf<PlaneSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.tilt_x, Field{"tilt_x", "degrees", closed(-89, 89), "Turn about the image's x axis."});
  v(s.tilt_y, Field{"tilt_y", "degrees", closed(-89, 89), "Then about its y axis."});
  v(s.side, Field{"side", "world units", kLengths, "Length of a side of the square."});
}

void build_plane(const PlaneSettings& s, std::uint64_t, Scene* scene) {
  const double cx = std::cos(s.tilt_x * kDegree), sx = std::sin(s.tilt_x * kDegree);
  const double cy = std::cos(s.tilt_y * kDegree), sy = std::sin(s.tilt_y * kDegree);
  const Vec3 x{cy, 0, -sy}, y{sx * sy, cx, sx * cy}, z = cross(x, y);
  const double half = s.side / 2, thickness = 0.01 * s.side;
  Shapes(&scene->mesh).block(z * (-thickness / 2), x * half, y * half, z * (thickness / 2));
  scene->mesh.scene_size = s.side;
  scene->view.eye = {0, 0, 3};
}

struct GrooveSettings {
  double angle = 90;  // degrees
  double reach = 40;  // world units
};
template <FieldsOf<GrooveSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.angle, Field{"angle", "degrees", closed(10, 170), "Opening angle between the walls."});
  v(s.reach, Field{"reach", "world units", kLengths,
                   "Length of the walls, and half that of the groove; the camera is 4 away."});
}

void build_groove(const GrooveSettings& s, std::uint64_t, Scene* scene) {
  const double half = s.angle / 2 * kDegree, distance = 4, reach = s.reach;
  const double side = reach * std::sin(half), front = reach * std::cos(half), back = -distance;
  const Vec3 section[] = {{0, -reach, 0},
                          {side, -reach, front},
                          {side, -reach, back},
                          {-side, -reach, back},
                          {-side, -reach, front}};
  Shapes(&scene->mesh).prism(section, {0, 2 * reach, 0});
  scene->mesh.scene_size = 2 * reach;
  scene->view.eye = {0, 0, distance};
}

struct CornerSettings {
  double reach = 40;  // world units
};
template <FieldsOf<CornerSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.reach,
    Field{"reach", "world units", kLengths, "Length of the walls' sides; the camera is 4 away."});
}

void build_corner(const CornerSettings& s, std::uint64_t, Scene* scene) {
  const double distance = 4, reach = s.reach, t = distance;
  Shapes shapes(&scene->mesh);
  shapes.box({-t, -t, -t}, {reach, 0, reach});
  shapes.box({-t, -t, -t}, {0, reach, reach});
  shapes.box({-t, -t, -t}, {reach, reach, 0});
  scene->mesh.scene_size = reach + t;
  const double along = distance / std::sqrt(3.0);
  scene->view.eye = {along, along, along};
}

struct BumpSettings {
  double radius = 1;
};
template <FieldsOf<BumpSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.radius, Field{"radius", "world units", kLengths, "Radius of the half sphere."});
}

void build_bump(const BumpSettings& s, std::uint64_t, Scene* scene) {
  const double r = s.radius, reach = kFar * r;
  Shapes shapes(&scene->mesh);
  shapes.box({-reach, -reach, -2 * r}, {reach, reach, 0});
  shapes.sphere({0, 0, 0}, r);
  scene->mesh.scene_size = 2 * r;
  scene->view.eye = {0, 0, 4 * r};
  scene->view.orthographic = true;
  scene->view.ortho_height = 4 * r;
}

struct SphereOverPlaneSettings {
  double radius = 1;
  double height = 1.5;
};
template <FieldsOf<SphereOverPlaneSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.radius, Field{"radius", "world units", kLengths, "Radius of the sphere."});
  v(s.height, Field{"height", "world units", kLengths, "Height of its centre over the plane."});
}

void build_sphere_over_plane(const SphereOverPlaneSettings& s, std::uint64_t, Scene* scene) {
  const double r = s.radius, reach = kFar * r;
  Shapes shapes(&scene->mesh);
  shapes.box({-reach, -4 * r, -reach}, {reach, 0, reach});
  shapes.sphere({0, s.height, 0}, r);
  scene->mesh.scene_size = 2 * r;
  scene->view.look_at = {0, 0.6 * s.height, 0};
  scene->view.eye = {0, 0.6 * s.height + 2.2 * r, 4.6 * r};
  scene->view.fov_y = 50 * kDegree;
}

}  // namespace

std::vector<SceneKind> simple_scenes() {
  return {
      make_scene_kind("plane", "A square of any tilt; visibility is 1.", build_plane),
      make_scene_kind("groove", "Two walls that meet at an angle.", build_groove),
      make_scene_kind("corner", "The inside corner of three walls at right angles.", build_corner),
      make_scene_kind("bump", "Half a sphere on a plane, from straight above.", build_bump),
      make_scene_kind("sphere-over-plane", "A sphere that hovers over a plane.",
                      build_sphere_over_plane),
  };
}

}  // namespace obscura::tools
