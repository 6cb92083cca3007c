#ifndef OBSCURA_IO_IMAGES_IMAGE_H_
#define OBSCURA_IO_IMAGES_IMAGE_H_

#include <string>
#include <vector>

#include "obscura/views.h"

namespace obscura::tools {

// An owned image of float planes, one per named channel, all of one size.
struct Image {
  struct Channel {
    std::string name;
    std::vector<float> values;  // width * height, row by row from the top
  };

  int width = 0, height = 0;
  std::vector<Channel> channels;
  // The model of matter behind a result ("auto, from widths"); empty: not said. EXR files keep it
  // as the attribute obscuraOccluder.
  std::string occluder;

  Image() = default;
  Image(int w, int h) : width(w), height(h) {}

  // Appends a channel of zeros. References to channels last until the next add().
  std::vector<float>& add(std::string name) {
    channels.push_back({std::move(name), std::vector<float>(std::size_t(width) * height)});
    return channels.back().values;
  }
  const Channel* find(const std::string& name) const {
    for (const Channel& c : channels) {
      if (c.name == name) return &c;
    }
    return nullptr;
  }
  ImageView<float> view(int channel) { return {channels[channel].values.data(), width, height}; }
  ImageView<const float> view(int channel) const {
    return {channels[channel].values.data(), width, height};
  }
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_IMAGE_H_
