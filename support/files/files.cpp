#include "support/files/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "fmt/format.h"
#include "support/files/exr.h"
#include "support/files/pfm.h"
#include "support/files/png.h"

namespace obscura::support {
namespace {

// Adds the channels of `kept` over the display window that `image` does not have itself.
Status keep_channels(const std::string& path, const ExrHeader& header, const Image& kept,
                     Image* image) {
  const PixelWindow& display = header.display_window;
  const PixelWindow& data = header.data_window;
  if (display.width() != image->width || display.height() != image->height) {
    return invalid_input(
        fmt::format("{}: its display window is {}x{}, the result {}x{}; channels "
                    "cannot be kept",
                    path, display.width(), display.height(), image->width, image->height));
  }
  for (const Image::Channel& c : kept.channels) {
    if (image->find(c.name)) continue;
    std::vector<float>& out = image->add(c.name);
    for (int y = std::max(display.min_y, data.min_y); y <= std::min(display.max_y, data.max_y);
         ++y) {
      for (int x = std::max(display.min_x, data.min_x); x <= std::min(display.max_x, data.max_x);
           ++x) {
        out[static_cast<std::size_t>(y - display.min_y) * image->width + x - display.min_x] =
            c.values[static_cast<std::size_t>(y - data.min_y) * data.width() + x - data.min_x];
      }
    }
  }
  return {};
}

Status write_exr_keeping(const std::string& temporary, const Image& image,
                         const WriteOptions& options) {
  ExrWriteOptions exr;
  exr.half = options.half;
  if (options.keep_channels_of.empty()) return write_exr(temporary, image, exr);
  ExrHeader header;
  Image kept;
  if (Status s = read_exr(options.keep_channels_of, {}, &header, &kept); !s.ok()) return s;
  Image all = image;
  if (Status s = keep_channels(options.keep_channels_of, header, kept, &all); !s.ok()) return s;
  exr.attributes_of = &header;
  exr.display_window = exr.data_window = header.display_window;
  for (const ExrHeader::Channel& c : header.channels) {
    if (!image.find(c.name)) exr.types.push_back(c);
  }
  return write_exr(temporary, all, exr);
}

}  // namespace

std::string file_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Status read_image(const std::string& path, Image* image) {
  const std::string ending = file_ending(path);
  if (ending != ".exr" && ending != ".pfm" && ending != ".png" && ending != ".hdr") {
    return invalid_input(fmt::format(
        "{}: unknown kind of image; its ending must be .exr, .pfm, .png or .hdr", path));
  }
  if (ending == ".exr") {
    ExrHeader header;
    return read_exr(path, {}, &header, image);
  }
  std::string bytes;
  if (Status s = read_bytes(path, &bytes); !s.ok()) return s;
  if (ending == ".pfm") return decode_pfm(bytes, path, image);
  if (ending == ".png") return decode_png(bytes, path, image);
  return decode_hdr(bytes, path, image);
}

Status check_image_ending(const std::string& path) {
  const std::string ending = file_ending(path);
  if (ending == ".exr" || ending == ".pfm" || ending == ".png") return {};
  return invalid_argument(
      fmt::format("'{}' has no ending that can be written; it must be .exr, .pfm or .png", path));
}

Status write_image(const std::string& path, const Image& image, const WriteOptions& options) {
  if (Status s = check_image_ending(path); !s.ok()) return s;
  const std::string ending = file_ending(path);
  if (ending == ".exr") {
    return write_atomically(path, [&](const std::string& temporary) {
      return write_exr_keeping(temporary, image, options);
    });
  }
  std::string bytes;
  Status s = ending == ".pfm" ? encode_pfm(image, &bytes) : encode_png(image, &bytes);
  return s.ok() ? write_text(path, bytes) : s;
}

}  // namespace obscura::support
