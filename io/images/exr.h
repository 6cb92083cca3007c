#ifndef OBSCURA_IO_IMAGES_EXR_H_
#define OBSCURA_IO_IMAGES_EXR_H_

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/images/image.h"
#include "obscura/camera.h"
#include "obscura/status.h"

namespace obscura::tools {

// Pixels [min, max] in both directions, as OpenEXR counts them.
struct PixelWindow {
  int min_x = 0, min_y = 0, max_x = -1, max_y = -1;

  int width() const { return max_x - min_x + 1; }
  int height() const { return max_y - min_y + 1; }
  bool operator==(const PixelWindow&) const = default;
};

// Holds Image::occluder.
inline constexpr const char* kOccluderAttribute = "obscuraOccluder";
// Holds ExrWriteOptions::made_by.
inline constexpr const char* kMadeByAttribute = "obscuraMadeBy";

// The header of a part of an OpenEXR file.
struct ExrHeader {
  struct Channel {
    std::string name;
    std::string type;  // half, float or uint
    bool subsampled = false;
  };
  // 16 numbers, row by row as stored: OpenEXR's matrices act on row vectors, p' = p M.
  using Matrix = std::array<double, 16>;

  int part = 0;           // from 0
  std::string part_name;  // "" where the file has one part without a name
  bool deep = false;      // several samples a pixel
  PixelWindow display_window, data_window;
  std::vector<Channel> channels;
  std::optional<Matrix> world_to_camera, world_to_ndc;
  std::string occluder;                 // of the attribute kOccluderAttribute
  std::string made_by;                  // of the attribute kMadeByAttribute
  std::vector<std::string> attributes;  // names of all others
  std::shared_ptr<const void> native;   // OpenEXR's own, for write_exr to pass on

  const Channel* find(const std::string& name) const;
  // The smallest window around data and display window: what a DepthInput covers.
  PixelWindow whole_window() const;
};

// Threads that compress and decompress files, 0 for every processor. Counts before the first file
// is opened; else every processor does.
void set_exr_threads(int threads);

// Of the first part.
Status read_exr_header(const std::string& path, ExrHeader* header);

// Of every part; at most 1024 are read.
Status read_exr_headers(const std::string& path, std::vector<ExrHeader>* parts);

// The channels that `wanted` names (all for an empty list) over the data window of a part, as
// floats. A deep part is refused.
Status read_exr(const std::string& path, const std::vector<std::string>& wanted, ExrHeader* header,
                Image* image, int part = 0);

// Depth layers of a deep part, nearest first, over its data window: samples of Z to ZBack (to Z
// itself where there is no ZBack), those that touch merged into one. +inf where there are no more.
struct DeepLayer {
  std::vector<float> front, back;
};
Status read_exr_deep(const std::string& path, int part, int most_layers,
                     std::vector<DeepLayer>* layers);

// The names that a choice of compression has: "none, rle, zips, zip, piz, ...".
std::string exr_compressions();
// Whether it is one of them, or empty.
Status check_exr_compression(const std::string& name);

struct ExrWriteOptions {
  bool half = false;          // 16-bit floats
  std::string compression{};  // of exr_compressions(); empty: zip
  // The command that made the image, for a sequence to know its frames again; empty: not said.
  std::string made_by{};
  // An EXR file whose other channels, in their own types, and attributes go along. The image then
  // lies on that file's display window, or on its whole window less a guard band where that is
  // given; windows given below are not used.
  std::string keep_channels_of{};
  std::optional<GuardBand> kept_guard_band{};
  // Where the image lies; by default its own size is display and data window.
  std::optional<PixelWindow> display_window, data_window;
  std::optional<ExrHeader::Matrix> world_to_camera, world_to_ndc;
  // Channels with a type of their own, half or float.
  std::vector<ExrHeader::Channel> types;
};

struct ExrAddOptions {
  bool half = false;
  // Empty: the part's own; where that loses bits, zip, so that what is there stays as it was.
  std::string compression{};
  std::string part{};    // name or number from 0; empty: the first; a new name makes a new part
  std::string layer{};   // goes before the channels' names: LAYER.visibility
  bool replace = false;  // channels of the same names
  std::string made_by{};
  // As kept_guard_band above.
  std::optional<GuardBand> guard_band{};
};

// Writes the EXR file `target` again to `path` with the image's channels in one of its parts. Other
// parts, deep and tiled ones too, go along as the bytes they are; the part's own channels keep
// their types and values, its attributes and windows stay. Where the image has no pixel, visibility
// is 1 and other channels are 0.
Status add_to_exr(const std::string& path, const std::string& target, const Image& image,
                  const ExrAddOptions& options);

// By name, in any case: Z, depth.Z, Depth.V, ViewLayer.Depth.Z, VRayZDepth.R; the same with "back".
bool looks_like_depth(const std::string& channel);
bool looks_like_back_depth(const std::string& channel);

// Writes an image with named channels, ZIP-compressed. Not atomic by itself: see write_image.
Status write_exr(const std::string& path, const Image& image, const ExrWriteOptions& options);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_EXR_H_
