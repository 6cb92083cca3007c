#ifndef OBSCURA_SRC_VOLUME_RANGE_KERNEL_H_
#define OBSCURA_SRC_VOLUME_RANGE_KERNEL_H_

#include <cstdint>
#include <limits>

namespace obscura {

// Range of finite values.
struct PlaneRange {
  float min = std::numeric_limits<float>::infinity(), max = -min;
  double sum = 0;
  std::int64_t finite = 0;
};

void add_row_to_range(const float* row, int width, PlaneRange* range);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_RANGE_KERNEL_H_
