#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/wait_count.h"
#include "volume/occlusion_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/occlusion_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "volume/strip_store-inl.h"
#include "volume/strip_walk-inl.h"

#ifndef OBSCURA_OCCLUSION_SIMD_ONCE
#define OBSCURA_OCCLUSION_SIMD_ONCE
namespace obscura {

// Elements of the memory that a sweep needs.
struct OcclusionSizes {
  int strips = 0, groups = 0;   // of a plane; of directions swept together
  std::size_t plane_state = 0;  // of all channels
  std::size_t opacity = 0, out = 0, tau_rows = 0, out_rows = 0;  // of a worker
};
struct OcclusionMemory {
  std::int16_t *now, *before;  // the same where the stencil reads the voxel's own value only
  std::int16_t* opacity;
  std::uint8_t *out, *tau_rows, *out_rows;
};

}  // namespace obscura
#endif

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

Layout LayoutOf(const OcclusionSweep& sweep) {
  return {(sweep.size[1] + kRows - 1) / kRows,
          (sweep.size[0] + kRows - 1 + kBlock - 1) / kBlock * kBlock};
}

// How many directions from the i-th on are swept together. The upwind stencil needs few registers
// and has a long latency, so three directions share wide registers.
int Together(const OcclusionSweep& sweep, int i) {
  const bool upwind = sweep.directions[i].stencil == Stencil::kUpwind;
  return kSides == 2 && upwind && i + 3 <= sweep.count ? 3 : 1;
}

OcclusionSizes SizesOf(const OcclusionSweep& sweep) {
  const Layout layout = LayoutOf(sweep);
  const auto plane = static_cast<std::size_t>(layout.strips * layout.strip_size());
  const auto pitch = static_cast<std::size_t>(layout.steps + 3 * kBlock);
  const auto channels = static_cast<std::size_t>(4 * sweep.count);
  OcclusionSizes sizes;
  sizes.strips = layout.strips;
  for (int i = 0; i < sweep.count; i += Together(sweep, i)) ++sizes.groups;
  sizes.plane_state = channels * plane;
  sizes.opacity = 2 * plane;
  sizes.out = channels * plane;
  sizes.tau_rows = kRows * pitch;
  sizes.out_rows = 4 * kRows * pitch;
  return sizes;
}

// Sweeps plane k. Every strip waits for `before`, unless null, to be two strips ahead.
void SweepPlane(const OcclusionSweep& sweep, int k, const OcclusionMemory& memory,
                const WaitCount* before, WaitCount* done) {
  const int width = sweep.size[0], height = sweep.size[1], depth = sweep.size[2];
  const int channels = 4 * sweep.count;
  const Layout layout = LayoutOf(sweep);
  const std::ptrdiff_t plane = layout.strips * layout.strip_size();
  const std::ptrdiff_t pitch = layout.steps + 3 * kBlock;
  std::int16_t* const opacity = memory.opacity;
  std::uint8_t* const out = memory.out;
  const int z = sweep.rising ? k : depth - 1 - k;
  const std::ptrdiff_t voxels = static_cast<std::ptrdiff_t>(width) * height;
  for (int m = 0; m < 2; ++m) {
    SkewPlane(layout, sweep.tau + z * voxels, width, height, m == 1, memory.tau_rows, pitch,
              opacity + m * (kSides == 2 ? kRows : plane));
  }
  Order orders[kMaxDirections * kGroups];
  for (int i = 0; i < sweep.count; ++i) {
    for (int g = 0; g < kGroups; ++g) {
      const std::ptrdiff_t at = (i * kGroups + g) * plane * kSides;
      Order& o = orders[i * kGroups + g];
      o = {memory.now + at, memory.before + at, opacity + g / 2 * plane, {}};
      for (int side = 0; side < kSides; ++side) {
        o.out[side] = out + ((g + 2 * side) * sweep.count + i) * plane;
      }
    }
  }
  int finished = 0;
  for (int i = 0, together = 1; i < sweep.count; i += together) {
    together = Together(sweep, i);
    const auto sweep_strip = together == 3 ? SweepAlike<3> : SweepAlike<1>;
    const int all = finished + layout.strips;
    for (int s = 0; s < layout.strips; ++s) {
      if (before) before->wait_for(std::min(finished + 2, all));
      sweep_strip(layout, orders + i * kGroups, sweep.directions + i, s);
      done->set(++finished);
    }
  }

  // Orders 0 ... 3 sweep x and y up, both down, x down and y up, x up and y down.
  for (int s = 0; s < layout.strips; ++s) {
    const std::uint8_t* skewed[4 * kMaxDirections];
    for (int c = 0; c < channels; ++c) skewed[c] = out + c * plane + s * layout.strip_size();
    const int rows = std::min(kRows, height - s * kRows);
    std::uint8_t* to =
        sweep.visibility + (z * voxels + static_cast<std::ptrdiff_t>(s) * kRows * width) * channels;
    const std::uint8_t* next = to + static_cast<std::ptrdiff_t>(rows) * width * channels;
    const Strip strip{skewed, layout.steps, rows, width, to, channels, next};
    switch (sweep.count) {
      case 1:
        StoreRows(layout, skewed, rows, width, memory.out_rows, pitch, to);
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

// Calls body(index in the skewed state, index in the plain plane) for every voxel of a plane in
// every direction and quadrant.
template <class Body>
void ForFace(const OcclusionSweep& sweep, const Body& body) {
  const Layout layout = LayoutOf(sweep);
  const std::ptrdiff_t width = sweep.size[0], height = sweep.size[1];
  for (int i = 0; i < sweep.count; ++i) {
    for (int order = 0; order < 4; ++order) {
      const int group = order % kGroups, side = order / kGroups;
      const std::ptrdiff_t to =
          (i * kGroups + group) * layout.strips * layout.strip_size() * kSides +
          std::ptrdiff_t{side} * kRows;
      const std::ptrdiff_t from = (i * 4 + kQuadrantOfSlot[order]) * width * height;
      for (std::ptrdiff_t y = 0; y < height; ++y) {
        const std::ptrdiff_t strip = y / kRows, lane = y % kRows;
        for (std::ptrdiff_t x = 0; x < width; ++x) {
          const std::ptrdiff_t column = order >= 2 ? width - 1 - x : x;
          body(to + (strip * layout.steps + x + lane) * kLanes + lane, from + y * width + column);
        }
      }
    }
  }
}
void ReadFace(const OcclusionSweep& sweep, std::int16_t* state) {
  ForFace(sweep, [&](std::ptrdiff_t at, std::ptrdiff_t plain) { state[at] = sweep.upwind[plain]; });
}
void WriteFace(const OcclusionSweep& sweep, const std::int16_t* state) {
  ForFace(sweep,
          [&](std::ptrdiff_t at, std::ptrdiff_t plain) { sweep.downwind[plain] = state[at]; });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
HWY_EXPORT(SizesOf);
HWY_EXPORT(SweepPlane);
HWY_EXPORT(ReadFace);
HWY_EXPORT(WriteFace);

namespace {

// Elements on a cache line of their own.
template <class T>
class Lines {
 public:
  Lines(std::size_t count, T value) : storage_(count + kLine, value) {}
  T* data() {
    const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
    return storage_.data() + (64 - address % 64) % 64 / sizeof(T);
  }

 private:
  static constexpr std::size_t kLine = 64;
  std::vector<T> storage_;
};

}  // namespace

struct OcclusionPipeline::Half {
  Half(const OcclusionSweep& s, const OcclusionSizes& sizes)
      : sweep(s),
        // The previous plane needs memory of its own if the stencil reads more of it than the
        // voxel's own value.
        apart(s.directions[0].stencil == Stencil::kCharacteristic),
        plane(sizes.plane_state),
        state((apart ? 2 : 1) * sizes.plane_state, 32767),
        counts(static_cast<std::size_t>(s.size[2])) {
    if (sweep.upwind) HWY_DYNAMIC_DISPATCH(ReadFace)(sweep, after(-1));
  }

  // W after plane k.
  std::int16_t* after(int k) { return state.data() + (apart && k % 2 ? plane : 0); }

  OcclusionSweep sweep;
  bool apart;
  std::size_t plane;
  Lines<std::int16_t> state;
  std::vector<WaitCount> counts;  // of each plane's strips
  std::atomic<int> next{0};
};

struct OcclusionPipeline::Scratch {
  explicit Scratch(const OcclusionSizes& sizes)
      : opacity(sizes.opacity, 0),
        out(sizes.out, 0),
        tau_rows(sizes.tau_rows, 255),
        out_rows(sizes.out_rows, 0) {}

  Lines<std::int16_t> opacity;
  Lines<std::uint8_t> out, tau_rows, out_rows;
};

OcclusionPipeline::OcclusionPipeline(std::span<const OcclusionSweep> sweeps, int workers) {
  const OcclusionSizes sizes = HWY_DYNAMIC_DISPATCH(SizesOf)(sweeps[0]);
  for (const OcclusionSweep& s : sweeps) halves_.push_back(std::make_unique<Half>(s, sizes));
  for (int i = 0; i < workers; ++i) scratch_.emplace_back(sizes);
}
OcclusionPipeline::~OcclusionPipeline() = default;

int OcclusionPipeline::most_workers(const OcclusionSweep& sweep) {
  const OcclusionSizes sizes = HWY_DYNAMIC_DISPATCH(SizesOf)(sweep);
  return std::min(sweep.size[2], sizes.strips * sizes.groups + 2);
}

void OcclusionPipeline::work(int worker, FunctionRef<bool()> done) {
  Scratch& mine = scratch_[static_cast<std::size_t>(worker)];
  const std::size_t count = halves_.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Workers stay with one half as long as it has planes.
    Half& half = *halves_[(static_cast<std::size_t>(worker) + i) % count];
    // A plane that is taken is swept to its end, as the next one may wait for it.
    for (int k = half.next++; k < half.sweep.size[2]; k = half.next++) {
      const OcclusionMemory memory{half.after(k),   half.after(k - 1),    mine.opacity.data(),
                                   mine.out.data(), mine.tau_rows.data(), mine.out_rows.data()};
      const auto at = static_cast<std::size_t>(k);
      HWY_DYNAMIC_DISPATCH(SweepPlane)
      (half.sweep, k, memory, k > 0 ? &half.counts[at - 1] : nullptr, &half.counts[at]);
      if (!done()) return;
    }
  }
}

void OcclusionPipeline::finish() {
  for (const std::unique_ptr<Half>& half : halves_) {
    if (!half->sweep.downwind) continue;
    HWY_DYNAMIC_DISPATCH(WriteFace)(half->sweep, half->after(half->sweep.size[2] - 1));
  }
}

OcclusionPipeline::Count OcclusionPipeline::count() const {
  const OcclusionSweep& sweep = halves_[0]->sweep;
  const OcclusionSizes sizes = HWY_DYNAMIC_DISPATCH(SizesOf)(sweep);
  const std::int64_t plane = std::int64_t{sizes.strips} * sizes.groups, depth = sweep.size[2];
  // Each plane begins two strips after the one before; the last is swept to its end.
  return {plane * depth * static_cast<std::int64_t>(halves_.size()),
          std::min<std::int64_t>(2, plane) * (depth - 1) + plane};
}

void sweep_occlusion_u8(const OcclusionSweep& sweep) {
  OcclusionPipeline(std::span(&sweep, 1), 1).work(0, [] { return true; });
}

}  // namespace obscura
#endif  // HWY_ONCE
