#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <numbers>

#include "scene/rays/solids.h"
#include "scene/scenes/mesh_view.h"
#include "scene/scenes/shapes.h"

namespace obscura::tools {
namespace {

Vec3 up_of(const ViewOptions& options) {
  const Vec3 up = options.up.value_or(Vec3{0, 1, 0});
  return length(up) > 0 && is_finite(up) ? normalize(up) : Vec3{0, 1, 0};
}

// x to the right and z to the front, as far as `up` lets them.
Frame upright(Vec3 up) {
  const Vec3 front = std::abs(up.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, -1, 0};
  const Vec3 x = normalize(cross(up, front));
  return {x, up, cross(x, up)};
}

void add_ground(Vec3 up, const Bounds& bounds, Mesh* mesh) {
  const Frame frame = upright(up);
  double lowest = INFINITY;
  for (const Mesh::Triangle& t : mesh->triangles) {
    for (std::uint32_t i : {t.a, t.b, t.c}) lowest = std::min(lowest, dot(up, mesh->position(i)));
  }
  const double reach = 20 * mesh->scene_size, thickness = 0.5 * mesh->scene_size;
  const Vec3 center = bounds.center();
  const Vec3 top = center + up * (lowest - dot(up, center));
  Shapes(mesh).block(top - up * (thickness / 2), frame.x * reach, up * (thickness / 2),
                     frame.z * reach);
}

}  // namespace

ViewSpec framed_view(const Bounds& bounds, const ViewOptions& options) {
  ViewSpec v;
  const double radius = 0.5 * length(bounds.max - bounds.min);
  constexpr double kDegree = std::numbers::pi / 180;
  v.fov_y = options.fov_y.value_or(40) * kDegree;
  // The sphere fits the narrower side.
  const double aspect = double(options.size.width) / options.size.height;
  const double half = std::atan(std::tan(v.fov_y / 2) * std::min(1.0, aspect));
  const double distance = radius / std::max(1e-3, std::sin(half));
  const double turn = 35 * kDegree, lift = 22 * kDegree;
  const Frame frame = upright(up_of(options));
  v.up = frame.y;
  v.look_at = options.look_at.value_or(bounds.center());
  v.eye = v.look_at + frame.to_world({std::sin(turn) * std::cos(lift), std::sin(lift),
                                      std::cos(turn) * std::cos(lift)}) *
                          distance;
  v.ortho_height = 2 * radius / std::min(1.0, aspect);
  return v;
}

namespace {

Status load_and_render(const std::string& path, const MeshOptions& options, Executor& executor,
                       Rendering* rendering) {
  Mesh mesh;
  if (Status s = load_mesh(path, &mesh); !s.ok()) return s;
  const Bounds bounds = bounds_of(mesh);
  // The user speaks of the world; mesh and view are kept relative to the mesh's origin.
  ViewOptions local = options.view;
  if (local.eye) *local.eye = *local.eye - mesh.origin;
  if (local.look_at) *local.look_at = *local.look_at - mesh.origin;
  ViewSpec view = framed_view(bounds, local);
  view.origin = mesh.origin;
  if (Status s = apply_options(local, &view); !s.ok()) return s;
  if (!options.sheets) find_solids(&mesh);
  if (options.ground) add_ground(normalize(view.up), bounds, &mesh);
  std::unique_ptr<RayScene> scene;
  if (Status s = RayScene::create(std::move(mesh), &scene, executor.thread_count()); !s.ok()) {
    return s;
  }
  DepthInput gbuffer;
  gbuffer.name = path;
  Status s = render_gbuffer(*scene, view, options.view.layer_spec(), executor, &gbuffer);
  if (!s.ok()) return {s.code(), fmt::format("{}: {}", path, s.message())};
  *rendering = {std::move(scene), view, std::move(gbuffer)};
  return {};
}

}  // namespace

Status load_mesh(const std::string& path, const MeshOptions& options, Executor& executor,
                 Rendering* rendering) {
  try {
    return load_and_render(path, options, executor, rendering);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, path + ": out of memory"};
  }
}

}  // namespace obscura::tools
