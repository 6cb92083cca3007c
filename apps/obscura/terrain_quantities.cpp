#include "apps/obscura/terrain_quantities.h"

#include <algorithm>
#include <sstream>

#include "fmt/format.h"

namespace obscura::app {
namespace {

struct Quantity {
  const char* name;
  const char* unit;                        // "" for a share of 1
  ImageView<float> TerrainOutputs::*view;  // null: horizons
};
constexpr Quantity kQuantities[] = {
    {"svf", "", &TerrainOutputs::svf},
    {"svf-normal", "", &TerrainOutputs::svf_normal},
    {"svf-cosine", "", &TerrainOutputs::svf_cosine},
    {"openness", "degree", &TerrainOutputs::openness},
    {"negative-openness", "degree", &TerrainOutputs::negative_openness},
    {"visible-sky", "percent", &TerrainOutputs::visible_sky},
    {"asvf", "", &TerrainOutputs::asvf},
    {"local-dominance", "ratio", &TerrainOutputs::local_dominance},
    {"horizon", "degree", nullptr},
};

const Quantity* find_quantity(const std::string& name) {
  for (const Quantity& q : kQuantities) {
    if (name == q.name) return &q;
  }
  return nullptr;
}

}  // namespace

std::string TerrainQuantities::all_names() {
  std::string names;
  for (const Quantity& q : kQuantities) names += (names.empty() ? "" : ", ") + std::string(q.name);
  return names;
}

Status TerrainQuantities::parse(const std::string& names, TerrainQuantities* quantities) {
  TerrainQuantities result;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    if (!find_quantity(name)) {
      return invalid_argument(
          fmt::format("--quantity names '{}'; it must be a list of {}", name, all_names()));
    }
    if (std::ranges::find(result.names_, name) != result.names_.end()) {
      return invalid_argument(fmt::format("--quantity names '{}' twice", name));
    }
    result.names_.push_back(name);
  }
  if (result.names_.empty()) {
    return invalid_argument("--quantity is empty; it must be a list of " + all_names());
  }
  *quantities = std::move(result);
  return {};
}

void TerrainQuantities::include(const std::string& name) {
  if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
}

bool TerrainQuantities::only_shares() const {
  return std::ranges::all_of(
      names_, [](const std::string& name) { return *find_quantity(name)->unit == '\0'; });
}

int TerrainQuantities::channels(int azimuths) const {
  int count = 0;
  for (const std::string& name : names_) count += find_quantity(name)->view ? 1 : azimuths;
  return count;
}

TerrainOutputs TerrainQuantities::allocate(int width, int height, int azimuths) {
  image_ = tools::Image(width, height);
  for (const std::string& name : names_) {
    const Quantity& q = *find_quantity(name);
    if (q.view) image_.add(name);
    // In order also where channels are sorted by name, as in EXR files.
    for (int k = 0; !q.view && k < azimuths; ++k) {
      image_.add(fmt::format("horizon.{:07.3f}", 360.0 * k / azimuths));
    }
    units_.resize(image_.channels.size(), q.unit);
  }
  // Views only now: adding a channel moves the others.
  TerrainOutputs outputs;
  int channel = 0;
  for (const std::string& name : names_) {
    const Quantity& q = *find_quantity(name);
    if (q.view) outputs.*q.view = image_.view(channel++);
    for (int k = 0; !q.view && k < azimuths; ++k) horizon_.push_back(image_.view(channel++));
  }
  outputs.horizon = horizon_;
  return outputs;
}

ImageView<float> TerrainQuantities::view(const std::string& name) {
  for (std::size_t i = 0; i < image_.channels.size(); ++i) {
    if (image_.channels[i].name == name) return image_.view(static_cast<int>(i));
  }
  return {};
}

}  // namespace obscura::app
