#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_PHASE_IMAGE_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_PHASE_IMAGE_H_

#include <algorithm>
#include <cstddef>

#include "core/aligned_image.h"

namespace obscura::far_field {

// How a row of numbers is laid out where every m-th one belongs together: number i lies beside
// i + m. So receivers that do alike (a pixel of each 3x3 group, or all that share a scanned line)
// are read and written as whole vectors. m = 1 is the common row.
struct Phases {
  int count = 1;              // m
  std::ptrdiff_t stride = 0;  // from one phase to the next

  // Of number i >= 0.
  std::ptrdiff_t index(int i) const { return count == 1 ? i : i % count * stride + i / count; }
};

// Rows of floats in phases, with a margin to the left and right of each row.
class PhaseImage {
 public:
  void resize(int width, int height, int margin, int phases) {
    constexpr int kVector = 16;
    margin_ = (margin + kVector * phases - 1) / (kVector * phases) * kVector * phases;
    const int longest = (width + 2 * margin_ + phases - 1) / phases;
    phases_ = {phases, (longest + kVector - 1) / kVector * kVector};
    image_.resize(static_cast<int>(phases_.stride) * phases, height);
  }
  int phases() const { return phases_.count; }
  int margin() const { return margin_; }
  // Texel u of a row lies at row(y) + offset(u), that of the next row stride() further on.
  const float* row(int y) const { return image_.row(y); }
  std::ptrdiff_t offset(int u) const { return phases_.index(u + margin_); }
  std::ptrdiff_t stride() const { return image_.stride(); }

  // Texel u of row y, from -margin on; the next in memory is texel u + phases().
  float* at(int y, int u) { return image_.row(y) + phases_.index(u + margin_); }
  const float* at(int y, int u) const { return image_.row(y) + phases_.index(u + margin_); }
  void fill_row(int y, float value) {
    std::fill_n(image_.row(y), phases_.stride * phases_.count, value);
  }

 private:
  AlignedImage<float> image_;
  Phases phases_;
  int margin_ = 0;
};

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_PHASE_IMAGE_H_
