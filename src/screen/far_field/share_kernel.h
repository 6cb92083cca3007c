#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_SHARE_KERNEL_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_SHARE_KERNEL_H_

#include <cstdint>

#include "screen/far_field/plane.h"

namespace obscura::far_field {

// Part of a row of pixels that take their neighbours' slices; see share.h.
struct ShareJob {
  static constexpr int kMaxCount = 128, kRoom = kMaxCount + 2 + 16;  // and a vector more
  struct View {
    float scale_x, scale_y;
    bool parallel;
  };
  // Entry 0 is left of the first pixel.
  struct Row {
    float depth[kRoom] = {}, normal[3][kRoom] = {}, sums[kMaxChannels][kRoom] = {};
    float shares[kRoom] = {};  // in the sums
  };

  int side = 2, channels = 0, count = 0;
  View view{};
  float axis_x = 0, axis_y = 0;  // from the camera's axis to the first pixel, in pixels
  Row rows[3];                   // above, own, below
  float* out[kMaxChannels] = {};
  std::int32_t known[kRoom] = {};  // shares that reach a pixel, in 1/kKnownUnits; all, of none
};
// Reads rows, writes `out`.
void share_row(ShareJob* job);
// Reads depths and normals, writes `known`.
void find_known(ShareJob* job);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_SHARE_KERNEL_H_
