#ifndef OBSCURA_SUPPORT_FILES_EXR_H_
#define OBSCURA_SUPPORT_FILES_EXR_H_

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "obscura/status.h"
#include "support/image.h"

namespace obscura::support {

// Pixels [min, max] in both directions, as OpenEXR counts them.
struct PixelWindow {
  int min_x = 0, min_y = 0, max_x = -1, max_y = -1;

  int width() const { return max_x - min_x + 1; }
  int height() const { return max_y - min_y + 1; }
  bool operator==(const PixelWindow&) const = default;
};

// The header of an OpenEXR file (its first part).
struct ExrHeader {
  struct Channel {
    std::string name;
    std::string type;  // half, float or uint
  };
  // 16 numbers, row by row as stored: OpenEXR's matrices act on row vectors, p' = p M.
  using Matrix = std::array<double, 16>;

  PixelWindow display_window, data_window;
  std::vector<Channel> channels;
  std::optional<Matrix> world_to_camera, world_to_ndc;
  std::vector<std::string> attributes;  // names of all others
  std::shared_ptr<const void> native;   // for write_exr to pass on

  const Channel* find(const std::string& name) const;
};

Status read_exr_header(const std::string& path, ExrHeader* header);

// The channels that `wanted` names (all for an empty list) over the data window, as floats.
Status read_exr(const std::string& path, const std::vector<std::string>& wanted, ExrHeader* header,
                Image* image);

struct ExrWriteOptions {
  bool half = false;  // 16-bit floats
  // Another file's attributes to pass on (not those that describe how its pixels are stored).
  const ExrHeader* attributes_of = nullptr;
  // Where the image lies; by default its own size is display and data window.
  std::optional<PixelWindow> display_window, data_window;
  std::optional<ExrHeader::Matrix> world_to_camera, world_to_ndc;
  // Channels that keep a type of their own.
  std::vector<ExrHeader::Channel> types;
};

// Writes an image with named channels, ZIP-compressed. Not atomic by itself: see write_image.
Status write_exr(const std::string& path, const Image& image, const ExrWriteOptions& options);

}  // namespace obscura::support

#endif  // OBSCURA_SUPPORT_FILES_EXR_H_
