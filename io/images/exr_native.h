#ifndef OBSCURA_IO_IMAGES_EXR_NATIVE_H_
#define OBSCURA_IO_IMAGES_EXR_NATIVE_H_

// What the files of io/images that include OpenEXR's headers share.

#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>

#include "fmt/format.h"
#include "io/images/exr.h"

namespace obscura::tools {

inline PixelWindow from_box(const Imath::Box2i& b) { return {b.min.x, b.min.y, b.max.x, b.max.y}; }
inline Imath::Box2i to_box(const PixelWindow& w) {
  return {{w.min_x, w.min_y}, {w.max_x, w.max_y}};
}

// Runs what may throw; every exception of OpenEXR ends here.
template <class F>
Status guard_exr(const std::string& path, F&& f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", path)};
  } catch (const std::exception& e) {
    std::string reason = e.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return invalid_input(fmt::format("{}: not a readable EXR file ({})", path, reason));
  }
}

// Walks over the attributes of all headers before OpenEXR does, since that allocates what an
// attribute claims to hold: one that reaches beyond the end of the file, or has not the size of its
// type, is found here.
Status check_exr_attributes(const std::string& path);

// Opens a file, fills `header` from one of its parts and checks what that part claims against the
// file's length before anything of that size is allocated. May throw: see guard_exr.
Status open_exr(const std::string& path, ExrHeader* header,
                std::unique_ptr<Imf::MultiPartInputFile>* file, int part = 0);

// Refuses a part with several samples a pixel.
Status refuse_deep(const std::string& path, const ExrHeader& header);

// "zip" and so on; exr_compressions() lists them.
Status parse_exr_compression(const std::string& name, Imf::Compression* compression);

// Where pixel (0, 0) of a plane over `window` would lie, as OpenEXR addresses pixels.
inline char* origin_of(void* pixels, const PixelWindow& window, std::ptrdiff_t pixel_bytes) {
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{window.width()} * pixel_bytes;
  return static_cast<char*>(pixels) - window.min_x * pixel_bytes - window.min_y * row_bytes;
}

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_EXR_NATIVE_H_
