#include "apps/obscura/describe_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "io/images/depth_camera.h"
#include "io/meshes/load_mesh.h"
#include "obscura/executor.h"
#include "scene/scenes/load_scene.h"
#include "scene/scenes/scene.h"

namespace obscura::app {
namespace {

using tools::Json;

// To a millionth of `size`, as floats have no more digits; as it is where that has no meaning.
double rounded(double x, double size) {
  const double units = std::pow(10, 6 - std::floor(std::log10(size)));
  const double result = std::round(x * units) / units;
  return std::isfinite(result) ? result : x;
}
std::array<double, 3> numbers(tools::Vec3 v, double size) {
  return {rounded(v.x, size), rounded(v.y, size), rounded(v.z, size)};
}

// As a shell takes it.
std::string quoted(const std::string& word) {
  const bool plain = word.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789._-+/:") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

void describe_geometry(const tools::Mesh& mesh, Json* description) {
  Json& d = *description;
  d["triangles"] = mesh.triangles.size();
  d["vertices"] = mesh.positions.size();
  const tools::Bounds bounds = tools::bounds_of(mesh);
  const double size = bounds.longest_side();
  d["min"] = Json(numbers(bounds.min + mesh.origin, size));
  d["max"] = Json(numbers(bounds.max + mesh.origin, size));
  d["size"] = rounded(size, size);
}

void add_notes(const std::vector<std::string>& notes, Json* description) {
  for (const std::string& note : notes) (*description)["notes"].push_back(note);
}

}  // namespace

Status describe_mesh(const std::string& path, Json* description) {
  tools::Mesh mesh;
  if (Status s = tools::load_mesh(path, &mesh); !s.ok()) return s;
  Json& d = *description;
  d["file"] = path;
  d["kind"] = "mesh";
  describe_geometry(mesh, description);
  add_notes(mesh.notes, description);
  d["picture"] = fmt::format("obscura ao {} -o ao.png", quoted(path));
  d["at its vertices"] = fmt::format("obscura bake {} -o baked.ply", quoted(path));
  return {};
}

Status describe_scene(const std::string& spec, Json* description) {
  // Refuses what `ao` refuses.
  tools::Rendering rendering;
  const auto executor = make_executor(0);
  if (Status s = tools::load_scene(spec, {}, *executor, &rendering); !s.ok()) return s;
  std::string name;
  tools::SceneParameters parameters;
  if (Status s = tools::split_scene(spec, &name, &parameters); !s.ok()) return s;
  const auto& all = tools::scene_catalogue();
  const auto kind =
      std::find_if(all.begin(), all.end(), [&](const auto& k) { return k.name == name; });
  Json& d = *description;
  d["scene"] = spec;
  d["kind"] = "procedural scene";
  d["what"] = kind->summary;
  const tools::ViewSpec& view = rendering.view;
  const tools::Mesh& mesh = rendering.scene->mesh();
  describe_geometry(mesh, description);
  const double size = mesh.scene_size;
  d["picture_size"] = Json(std::array<int, 2>{view.width, view.height});
  d["eye"] = Json(numbers(view.eye, size));
  d["look_at"] = Json(numbers(view.look_at, size));
  for (const auto& p : kind->parameters) {
    d["parameters"].push_back(
        Json{{"name", p.key}, {"is", p.value_form}, {"default", p.default_value}});
  }
  d["picture"] = fmt::format("obscura ao {} -o ao.png", quoted(spec));
  return {};
}

Status describe_projection(const std::string& path, Json* description) {
  tools::DepthFileOptions options;
  options.projection = path;
  tools::DepthInput input;
  input.width = input.height = 1;
  if (Status s = tools::set_camera(path, options, &input); !s.ok()) return s;
  const Camera& c = input.camera;
  const double height = c.scale_y, aspect = c.scale_x / c.scale_y;
  Json& d = *description;
  d["file"] = path;
  d["kind"] = "projection";
  if (c.orthographic) {
    d["camera"] = "parallel";
    d["ortho_height"] = rounded(height, height);
  } else {
    d["camera"] = "perspective";
    d["fov_y"] = rounded(2 * std::atan(0.5 * height) * 180 / std::numbers::pi, 1);
  }
  d["aspect"] = rounded(aspect, 1);
  if (std::abs(c.center_u - 0.5f) > 1e-6f || std::abs(c.center_v - 0.5f) > 1e-6f) {
    d["centre"] = Json(std::array<double, 2>{c.center_u, c.center_v});
  }
  add_notes(input.notes, description);
  d["picture"] = fmt::format("obscura ao DEPTH --projection {} -o ao.png", quoted(path));
  return {};
}

}  // namespace obscura::app
