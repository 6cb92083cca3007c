#ifndef OBSCURA_SRC_FILTERS_INTERLEAVED_KERNEL_H_
#define OBSCURA_SRC_FILTERS_INTERLEAVED_KERNEL_H_

#include <cstddef>

namespace obscura::interleaved {

inline constexpr int kMaxInterleave = 8;
inline constexpr int kBlurTaps = kMaxInterleave / 2 + 1;  // on one side, the middle included

// What a pixel's samples have in sum: the channels that are blurred. Directions are differences to
// what the same share of all directions, occluded or not, would give, so that an open pixel's are
// zero and its bent normal is the normal n (Klehm et al. 2011, section 4):
//   uniform weights  open = mean V,                        x y z = mean V w - open n/2
//   cosine weights   open = 1/pi integral of V (n.w),      x y z = 1/pi integral of V w (n.w)
//                                                                  - open 2/3 n
inline constexpr int kChannels = 4;

// One row of the blur in one direction, of `channels` images at once: tap k of pixel x is at
// x + k * step.
struct BlurRow {
  const float* values[kChannels] = {};
  float* out[kChannels] = {};
  int channels = 0;
  const float* surface = nullptr;  // linear on planes (bilateral_kernel.h); 0 or +inf: background
  const float* normal[3] = {};
  std::ptrdiff_t value_step = 1, surface_step = 1, normal_step = 1;
  int first_tap = 0, last_tap = 0;
  float weights[kBlurTaps] = {};
  bool orthographic = false;
  float edge = 0, edges_per_depth = 0;  // as in Resolve
};
void blur_row(const BlurRow& row, int width);

// From sums to results; all rows are of kernel length, null where not wanted.
struct Results {
  float* visibility = nullptr;  // of the sums given
  float* direction[3] = {};
  float* angle = nullptr;
  float* integral[3] = {};
};
struct Finish {
  bool cosine = false;       // weights of the sums
  bool cosine_open = false;  // uniform weights, but `open` is the cosine-weighted visibility
  bool paper_cone = false;
};
void finish_row(const Finish& finish, const float* const sums[kChannels],
                const float* const normal[3], int width, const Results& results);

}  // namespace obscura::interleaved

#endif  // OBSCURA_SRC_FILTERS_INTERLEAVED_KERNEL_H_
