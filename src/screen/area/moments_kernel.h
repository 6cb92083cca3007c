#ifndef OBSCURA_SRC_SCREEN_AREA_MOMENTS_KERNEL_H_
#define OBSCURA_SRC_SCREEN_AREA_MOMENTS_KERNEL_H_

namespace obscura {

// Share of surface, mean and variance of depth along a row.
struct MomentRow {
  const float* share;
  const float* mean;
  const float* variance;
};

// Merges five rows with weights 1 4 6 4 1 by the law of total variance. The outputs are rows of
// `width`; whole vectors are read and written past the end.
void merge_moments(const MomentRow rows[5], int width, float* share, float* mean, float* variance);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_AREA_MOMENTS_KERNEL_H_
