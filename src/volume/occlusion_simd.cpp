#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "volume/occlusion_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/occlusion_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "volume/strip_store-inl.h"
#include "volume/strip_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

template <class T>
T* Aligned(std::vector<T>& storage) {
  const auto address = reinterpret_cast<std::uintptr_t>(storage.data());
  return storage.data() + (64 - address % 64) % 64 / sizeof(T);
}

void SweepOcclusion(const OcclusionSweep& sweep) {
  const int width = sweep.size[0], height = sweep.size[1], depth = sweep.size[2];
  const int channels = 4 * sweep.count;
  const Layout layout{(height + kRows - 1) / kRows,
                      (width + kRows - 1 + kBlock - 1) / kBlock * kBlock};
  const std::ptrdiff_t plane = layout.strips * layout.strip_size();
  const std::ptrdiff_t pitch = layout.steps + 3 * kBlock;
  const std::size_t spare = 64;
  std::vector<std::uint8_t> tau_rows(static_cast<std::size_t>(kRows * pitch) + spare, 255);
  std::vector<std::int16_t> opacity_storage(static_cast<std::size_t>(2 * plane) + spare);
  // The previous plane needs memory of its own if the stencil reads more of it than the voxel's own
  // value.
  const bool apart = sweep.directions[0].stencil == Stencil::kCharacteristic;
  std::vector<std::int16_t> state(
      (apart ? 2 : 1) * static_cast<std::size_t>(channels * plane) + spare, kOne);
  std::vector<std::uint8_t> out_storage(static_cast<std::size_t>(channels * plane) + spare);
  std::vector<std::uint8_t> rows_storage(static_cast<std::size_t>(4 * kRows * pitch) + spare);
  std::uint8_t* plain_rows = Aligned(tau_rows);
  std::int16_t* opacity = Aligned(opacity_storage);
  std::int16_t* now = Aligned(state);
  std::int16_t* before = apart ? now + channels * plane : now;
  std::uint8_t* out = Aligned(out_storage);
  std::uint8_t* out_rows = Aligned(rows_storage);

  for (int k = 0; k < depth; ++k) {
    const int z = sweep.rising ? k : depth - 1 - k;
    const std::ptrdiff_t voxels = static_cast<std::ptrdiff_t>(width) * height;
    for (int m = 0; m < 2; ++m) {
      SkewPlane(layout, sweep.tau + z * voxels, width, height, m == 1, plain_rows, pitch,
                opacity + m * (kSides == 2 ? kRows : plane));
    }
    Order orders[kMaxDirections * kGroups];
    for (int i = 0; i < sweep.count; ++i) {
      for (int g = 0; g < kGroups; ++g) {
        const std::ptrdiff_t at = (i * kGroups + g) * plane * kSides;
        Order& o = orders[i * kGroups + g];
        o = {now + at, before + at, opacity + g / 2 * plane, {}};
        for (int side = 0; side < kSides; ++side) {
          o.out[side] = out + ((g + 2 * side) * sweep.count + i) * plane;
        }
      }
    }
    for (int i = 0, together = 1; i < sweep.count; i += together) {
      const SweepDirection* dir = sweep.directions + i;
      // The upwind stencil needs few registers and has a long latency, so three directions are
      // swept together in wide registers.
      const bool three = kSides == 2 && dir->stencil == Stencil::kUpwind && i + 3 <= sweep.count;
      together = three ? 3 : 1;
      (three ? SweepAlike<3> : SweepAlike<1>)(layout, orders + i * kGroups, dir);
    }
    if (apart) std::swap(now, before);

    // Orders 0 ... 3 sweep x and y up, both down, x down and y up, x up and y down.
    for (int s = 0; s < layout.strips; ++s) {
      const std::uint8_t* skewed[4 * kMaxDirections];
      for (int c = 0; c < channels; ++c) skewed[c] = out + c * plane + s * layout.strip_size();
      const int rows = std::min(kRows, height - s * kRows);
      std::uint8_t* to = sweep.visibility +
                         (z * voxels + static_cast<std::ptrdiff_t>(s) * kRows * width) * channels;
      const std::uint8_t* next = to + static_cast<std::ptrdiff_t>(rows) * width * channels;
      const Strip strip{skewed, layout.steps, rows, width, to, channels, next};
      switch (sweep.count) {
        case 1:
          StoreRows(layout, skewed, rows, width, out_rows, pitch, to);
          break;
        case 3:
          StoreHalves<3>(strip);
          break;
        case 6:
          StoreHalves<6>(strip);
          break;
        case 10:
          StoreHalves<10>(strip);
          break;
        default:
          HWY_ABORT("no transport has %d directions", sweep.count);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
HWY_EXPORT(SweepOcclusion);

void sweep_occlusion_u8(const OcclusionSweep& sweep) {
  HWY_DYNAMIC_DISPATCH(SweepOcclusion)(sweep);
}

}  // namespace obscura
#endif  // HWY_ONCE
