#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_KERNEL_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_KERNEL_H_

#include <cstdint>

namespace obscura {

// Mean and deviation of depth and the share of surface: of a level and, at the same place, of the
// next; of the last level twice.
struct alignas(16) MomentTexel {
  float mean[2];
  // A float's bits: the deviation, its lowest 8 bits replaced by the share times 255.
  std::uint32_t deviation_and_share[2];
};

// Share of surface, mean and variance of depth along a row.
struct MomentRow {
  const float* share;
  const float* mean;
  const float* variance;
};

// `slack`: see MomentPyramid::build. Merges five rows with weights 1 4 6 4 1 by the law of total
// variance. The outputs are rows of `width`; whole vectors are read and written past the end.
void merge_moments(const MomentRow rows[5], int width, float slack, float* share, float* mean,
                   float* variance);

// Packs a row of a level and of the next one. Where `now` has no share, or lies apart from `next`
// (math/apart_leaf.h), mean and deviation are those of `next`. Whole vectors are read past the end,
// none is written.
void pack_moments(const MomentRow& now, const MomentRow& next, int width, float slack,
                  MomentTexel* out);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_MOMENTS_KERNEL_H_
