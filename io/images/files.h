#ifndef OBSCURA_IO_IMAGES_FILES_H_
#define OBSCURA_IO_IMAGES_FILES_H_

#include <optional>
#include <string>

#include "io/images/atomic_file.h"
#include "io/images/image.h"
#include "obscura/camera.h"

namespace obscura::tools {

// The ending in lower case, with its dot: ".exr".
std::string file_ending(const std::string& path);

// Reads an image by its ending: .exr (the channels of its first part over the data window), .pfm,
// .png (as [0, 1]), .hdr.
Status read_image(const std::string& path, Image* image);

struct WriteOptions {
  bool half = false;  // EXR: 16-bit floats
  int png_bits = 8;   // PNG: 8 or 16 per channel
  // EXR: the command that made the image; empty: not said.
  std::string made_by{};
  std::string compression{};  // EXR: of exr_compressions(); empty: zip
  // EXR: the path of an EXR file whose other channels and attributes are copied along. The image
  // has the size of its display window, or is what is visible of it with this guard band, that of
  // the DepthInput loaded from it.
  std::string keep_channels_of{};
  std::optional<GuardBand> kept_guard_band{};
};

// Writes an image by its ending: .exr, .pfm (1 or 3 channels), .png (the same). The file
// is whole or not there, and an older one is not lost by a failure.
Status write_image(const std::string& path, const Image& image, const WriteOptions& options = {});

// Whether write_image knows the ending.
Status check_image_ending(const std::string& path);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_FILES_H_
