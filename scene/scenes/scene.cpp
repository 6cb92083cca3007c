#include "scene/scenes/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace obscura::tools {

std::string field_key(const Field& field) {
  std::string key = field.name;
  std::replace(key.begin(), key.end(), '_', '-');
  return key;
}

const std::vector<SceneKind>& scene_catalogue() {
  static const std::vector<SceneKind> catalogue = [] {
    std::vector<SceneKind> all = simple_scenes();
    for (SceneKind (*make)() : {cornell_scene, hall_scene, meadow_scene, tower_scene}) {
      all.push_back(make());
    }
    return all;
  }();
  return catalogue;
}

std::string scene_tables() {
  std::string scenes =
      "| scene | what | S | triangles | eye | looks at | view |\n|---|---|---|---|---|---|---|\n";
  std::string keys = "| scene | key | value | default | meaning |\n|---|---|---|---|---|\n";
  for (const SceneKind& kind : scene_catalogue()) {
    Scene scene;
    if (!kind.build({}, 1, &scene).ok()) continue;
    const ViewSpec& v = scene.view;
    auto place = [](Vec3 p) { return fmt::format("{:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z); };
    scenes += fmt::format(
        "| `{}` | {} | {:.4g} | {} | {} | {} | {} |\n", kind.name, kind.summary,
        scene.mesh.scene_size, scene.mesh.triangles.size(), place(v.eye), place(v.look_at),
        v.orthographic ? fmt::format("orthographic, {:g} high", v.ortho_height)
                       : fmt::format("{:.0f} degrees", v.fov_y * 180 / std::numbers::pi));
    for (const SceneKind::Parameter& p : kind.parameters) {
      keys += fmt::format("| `{}` | `{}` | {} | {} | {} |\n", kind.name, p.key, p.value_form,
                          p.default_value, p.help);
    }
  }
  return scenes + "\n" + keys;
}

}  // namespace obscura::tools
