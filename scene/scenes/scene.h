#ifndef OBSCURA_SCENE_SCENES_SCENE_H_
#define OBSCURA_SCENE_SCENES_SCENE_H_

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "obscura/settings.h"
#include "scene/rays/gbuffer.h"

namespace obscura::tools {

// A procedural scene: geometry and the view that it is made for.
struct Scene {
  Mesh mesh;
  ViewSpec view;
  double sheet_thickness = 0;  // of LayerSpec, unless the user says otherwise
};

// Text by key, as after the '?' of `scene:NAME?key=value&...`.
using SceneParameters = std::map<std::string, std::string>;

// The parts of `scene:NAME?key=value&...`, of which is_scene() holds.
Status split_scene(const std::string& spec, std::string* name, SceneParameters* parameters);

// One scene of the catalogue, in docs/scenes.md.
struct SceneKind {
  struct Parameter {
    std::string key, value_form, default_value, help;
  };

  std::string name;
  std::string summary;
  std::vector<Parameter> parameters;  // its own, beside those of every scene
  // Same parameters and seed: the same scene, bit for bit.
  std::function<Status(const SceneParameters&, std::uint64_t seed, Scene*)> build;
};

const std::vector<SceneKind>& scene_catalogue();

// The tables of docs/scenes.md: a test keeps that page and the catalogue in step.
std::string scene_tables();

// The key under which a field stands in text: '-' for '_'.
std::string field_key(const Field& field);

// Reads the fields of `settings` that `parameters` name; flags may be written 0 and 1 too.
template <class Settings>
Status read_fields(const SceneParameters& parameters, Settings* settings) {
  Status status;
  visit_fields(*settings, [&](auto& value, const Field& field) {
    const std::string key = field_key(field);
    const auto at = parameters.find(key);
    if (at == parameters.end() || !status.ok()) return;
    std::string text = at->second;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, bool>) {
      if (text == "0") text = "false";
      if (text == "1") text = "true";
    }
    status = parse_setting(key, field, text, &value);
  });
  return status;
}

// Describes the fields of a default-made Settings.
template <class Settings>
std::vector<SceneKind::Parameter> describe_fields() {
  std::vector<SceneKind::Parameter> all;
  const Settings settings;
  visit_fields(settings, [&](const auto& value, const Field& field) {
    using T = std::remove_cvref_t<decltype(value)>;
    std::string form = expected_text<T>(field);
    if (*field.unit) form += std::string(", ") + field.unit;
    all.push_back({field_key(field), form, write_setting(value), field.help});
  });
  return all;
}

template <class Settings>
SceneKind make_scene_kind(std::string name, std::string summary,
                          void (*build)(const Settings&, std::uint64_t seed, Scene*)) {
  return {std::move(name), std::move(summary), describe_fields<Settings>(),
          [build](const SceneParameters& parameters, std::uint64_t seed, Scene* scene) {
            Settings settings;
            if (Status s = read_fields(parameters, &settings); !s.ok()) return s;
            build(settings, seed, scene);
            return Status();
          }};
}

// The catalogue's entries, a file each or a file for a few.
std::vector<SceneKind> simple_scenes();  // plane, groove, corner, bump, sphere-over-plane
SceneKind cornell_scene();
SceneKind hall_scene();
SceneKind meadow_scene();
SceneKind tower_scene();

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_SCENES_SCENE_H_
