#ifndef OBSCURA_SRC_FILTERS_UPSAMPLING_KERNEL_H_
#define OBSCURA_SRC_FILTERS_UPSAMPLING_KERNEL_H_

#include <cstddef>

namespace obscura {

inline constexpr int kUpsamplingChannels = 14;
// Depths that differ by more than so many pixels' size, from what a plane would give, are kept
// apart.
inline constexpr float kUpsamplingEdge = 4;

// Values at pixels between two that have them, one row at a time: the mean of both where the three
// surfaces go on as one plane, and of the two the one that is nearer in depth where they do not.
// Normals that differ count less; the background counts nothing, and what it gets is of no use.
// Whole vectors are read and written past the row's end.
struct UpsamplingRow {
  const float* values[kUpsamplingChannels] =
      {};                                // at the pixel; its two neighbours are a step away
  float* out[kUpsamplingChannels] = {};  // may be the values: neighbours keep theirs
  float open[kUpsamplingChannels] = {};  // where neither neighbour is a surface
  int channels = 0;
  const float* surface = nullptr;  // filters/bilateral/kernel.h; 0 or +inf: background
  const float* normal[3] = {};     // null: none
  std::ptrdiff_t value_step = 1, surface_step = 1, normal_step = 1;
  bool before = true, after = true;  // whether there are neighbours
  bool odd_only = false;             // even pixels keep their values
  bool orthographic = false;
  float edge = 0;  // parts of a surface farther apart than this are kept apart: world units of
                   // depth, at depth 1 and growing with it unless rays are parallel
};
void upsample_row(const UpsamplingRow& row, int width);

}  // namespace obscura

#endif  // OBSCURA_SRC_FILTERS_UPSAMPLING_KERNEL_H_
