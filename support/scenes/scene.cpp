#include "support/scenes/scene.h"

#include <algorithm>

namespace obscura::support {

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

}  // namespace obscura::support
