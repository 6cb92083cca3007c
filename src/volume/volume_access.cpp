#include "volume/volume_access.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/guarded.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "volume/range_kernel.h"

namespace obscura {
namespace {

constexpr int kMaxSide = 8192;
constexpr const char* kAxis[] = {"x", "y", "z"};

template <class T>
void convert(const VolumeView& v, std::ptrdiff_t first, std::ptrdiff_t step, float* values) {
  const T* samples = static_cast<const T*>(v.data) + first;
  for (int x = 0; x < v.size[0]; ++x) {
    values[x] = v.slope * static_cast<float>(samples[x * step]) + v.intercept;
  }
}

}  // namespace

std::array<std::ptrdiff_t, 3> strides_of(const VolumeView& volume) {
  if (volume.stride[0] || volume.stride[1] || volume.stride[2]) return volume.stride;
  return {1, volume.size[0], static_cast<std::ptrdiff_t>(volume.size[0]) * volume.size[1]};
}

Status validate_grid(const char* name, const void* data, const std::array<int, 3>& size,
                     const std::array<float, 3>& spacing) {
  if (!data) return invalid_input(text(name, ".data is null; give the samples"));
  for (int a = 0; a < 3; ++a) {
    if (size[a] < 1 || size[a] > kMaxSide) {
      return invalid_input(text(name, ".size along ", kAxis[a], " is ", size[a],
                                "; it must be in [1, ", kMaxSide, "]"));
    }
    if (!(spacing[a] > 0 && std::isfinite(spacing[a]))) {
      return invalid_input(text(name, ".spacing along ", kAxis[a], " is ", spacing[a],
                                "; it must be positive and finite"));
    }
  }
  const auto [low, high] = std::minmax_element(spacing.begin(), spacing.end());
  if (*low < 1e-12f || *high > 1e12f || *high / *low > 1e4f) {
    return invalid_input(text(name, ".spacing goes from ", *low, " to ", *high,
                              "; it must lie in [1e-12, 1e12] with a ratio of at most 10000"));
  }
  return {};
}

Status validate(const VolumeView& volume) {
  if (static_cast<int>(volume.type) < 0 || volume.type > VoxelType::kF32) {
    return invalid_input(text("volume.type is ", static_cast<int>(volume.type),
                              "; it must be one of VoxelType's values"));
  }
  if (!std::isfinite(volume.slope) || volume.slope == 0 || !std::isfinite(volume.intercept)) {
    return invalid_input(text("volume.slope and intercept are ", volume.slope, " and ",
                              volume.intercept, "; they must be finite and the slope not 0"));
  }
  return validate_grid("volume", volume.data, volume.size, volume.spacing);
}

void volume_row(const VolumeView& volume, int y, int z, float* values) {
  const auto stride = strides_of(volume);
  const std::ptrdiff_t first = y * stride[1] + z * stride[2];
  switch (volume.type) {
    case VoxelType::kU8:
      return convert<std::uint8_t>(volume, first, stride[0], values);
    case VoxelType::kI16:
      return convert<std::int16_t>(volume, first, stride[0], values);
    case VoxelType::kU16:
      return convert<std::uint16_t>(volume, first, stride[0], values);
    case VoxelType::kF32:
      return convert<float>(volume, first, stride[0], values);
  }
}

Status volume_range(const VolumeView& volume, VolumeRange* range, const RunOptions& run) {
  return guarded("the range of a volume", [&]() -> Status {
    if (Status s = validate(volume); !s.ok()) return s;
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    std::vector<PlaneRange> planes(static_cast<std::size_t>(volume.size[2]));
    std::vector<std::vector<float>> rows(static_cast<std::size_t>(executor.thread_count()));
    for (auto& row : rows) row.resize(static_cast<std::size_t>(volume.size[0]));
    const auto stride = strides_of(volume);
    const bool plain = volume.type == VoxelType::kF32 && stride[0] == 1 && volume.slope == 1 &&
                       volume.intercept == 0;
    executor.parallel_for(volume.size[2], [&](int z, int worker) {
      float* converted = rows[static_cast<std::size_t>(worker)].data();
      for (int y = 0; y < volume.size[1]; ++y) {
        const float* row = converted;
        if (plain) {
          row = static_cast<const float*>(volume.data) + y * stride[1] + z * stride[2];
        } else {
          volume_row(volume, y, z, converted);
        }
        add_row_to_range(row, volume.size[0], &planes[static_cast<std::size_t>(z)]);
      }
    });
    // Planes are added in order, so that the result does not depend on the threads.
    PlaneRange all;
    for (const PlaneRange& plane : planes) {
      all.min = std::min(all.min, plane.min);
      all.max = std::max(all.max, plane.max);
      all.sum += plane.sum;
      all.finite += plane.finite;
    }
    if (all.finite == 0) return invalid_input("volume has no finite voxel; give one that has");
    range->min = all.min;
    range->max = all.max;
    range->mean = all.sum / static_cast<double>(all.finite);
    range->finite = all.finite;
    range->not_finite =
        std::int64_t{1} * volume.size[0] * volume.size[1] * volume.size[2] - all.finite;
    return {};
  });
}

}  // namespace obscura
