#ifndef OBSCURA_IO_IMAGES_UNFOLDING_H_
#define OBSCURA_IO_IMAGES_UNFOLDING_H_

#include <string>

#include "fmt/format.h"
#include "obscura/status.h"

namespace obscura::tools {

// What an image may take as floats whatever its file's size is, and how many times that size it may
// take beyond. Real images of that size hold noise or detail and shrink by far less.
inline constexpr double kFreelyUnfolded = 1 << 28;
inline constexpr double kMostUnfolded = 250;

// Refuses a small file that unfolds to an image that fills the memory.
inline Status check_unfolding(const std::string& name, int width, int height, double channels,
                              double file_bytes) {
  const double floats = 4 * channels * width * height;
  if (floats <= kFreelyUnfolded || floats <= kMostUnfolded * file_bytes) return {};
  return {StatusCode::kInvalidInput,
          fmt::format("{}: {}x{} pixels from {:.0f} bytes; an image of more than {:.0f} million "
                      "numbers may be at most {:.0f} times as large as its file",
                      name, width, height, file_bytes, kFreelyUnfolded / 4e6, kMostUnfolded)};
}

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_UNFOLDING_H_
