#include "io/images/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "fmt/format.h"
#include "io/images/exr.h"
#include "io/images/hdr.h"
#include "io/images/pfm.h"
#include "io/images/png.h"

namespace obscura::tools {

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
      ExrWriteOptions exr;
      exr.half = options.half;
      exr.made_by = options.made_by;
      exr.compression = options.compression;
      exr.keep_channels_of = options.keep_channels_of;
      exr.kept_guard_band = options.kept_guard_band;
      return write_exr(temporary, image, exr);
    });
  }
  std::string bytes;
  Status s =
      ending == ".pfm" ? encode_pfm(image, &bytes) : encode_png(image, options.png_bits, &bytes);
  return s.ok() ? write_text(path, bytes) : s;
}

}  // namespace obscura::tools
