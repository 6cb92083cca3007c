#ifndef OBSCURA_APPS_OBSCURA_TERRAIN_QUANTITIES_H_
#define OBSCURA_APPS_OBSCURA_TERRAIN_QUANTITIES_H_

#include <string>
#include <vector>

#include "io/images/image.h"
#include "obscura/terrain.h"

namespace obscura::app {

// The results that --quantity can name and the channels that hold them: one each, and one per
// azimuth for horizons.
class TerrainQuantities {
 public:
  // `names` is a comma-separated list such as "svf,openness".
  static Status parse(const std::string& names, TerrainQuantities* quantities);
  static std::string all_names();

  // Adds one that is not there yet.
  void include(const std::string& name);
  bool only_shares() const;  // all in [0, 1], as a .png holds them
  int channels(int azimuths) const;
  // Of the model's size that the sweeps sum up at once, at most.
  int sums() const { return static_cast<int>(names_.size()); }

  // Makes the channels; the outputs last as long as this object does.
  TerrainOutputs allocate(int width, int height, int azimuths);
  tools::Image& image() { return image_; }
  // Of each channel, as UDUNITS writes them.
  const std::vector<const char*>& units() const { return units_; }
  ImageView<float> view(const std::string& name);

 private:
  std::vector<std::string> names_;
  tools::Image image_;
  std::vector<const char*> units_;
  std::vector<ImageView<float>> horizon_;
};

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_TERRAIN_QUANTITIES_H_
