#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "volume/occlusion_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/occlusion_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "volume/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// Visibility is a 15-bit fraction; kOne is 1.
using D = hn::CappedTag<std::int16_t, 16>;
using V = hn::Vec<D>;
constexpr int kRows = HWY_LANES(std::int16_t) < 16 ? HWY_LANES(std::int16_t) : 16;
constexpr std::int16_t kOne = 32767;
constexpr int kBlock = 16;  // bytes transposed at a time

template <class T>
T* Aligned(std::vector<T>& storage) {
  const auto address = reinterpret_cast<std::uintptr_t>(storage.data());
  return storage.data() + (64 - address % 64) % 64 / sizeof(T);
}

// One direction of one of the four orders within a plane, as its strips are swept. Order 0 and 1
// read the plane as it is, 2 and 3 mirrored in x; odd ones go backward, from the last row's end.
struct Order {
  std::int16_t* now;            // W = V tau of this plane, skewed
  const std::int16_t* before;   // of the plane before along z; may be `now` for the upwind stencil
  const std::int16_t* opacity;  // 1 - tau, skewed
  std::uint8_t* out;            // V, skewed
};
struct Layout {
  int strips, steps;
  std::ptrdiff_t strip_size() const { return static_cast<std::ptrdiff_t>(steps) * kRows; }
};

// v0 v1 ... -> edge's last, v0, v1, ... forward; v1, v2, ..., edge's first backward.
template <bool kForward>
HWY_INLINE V Beside(V v, V edge) {
  const D d;
  constexpr int kBytes = static_cast<int>(sizeof(std::int16_t));
  if constexpr (kForward) {
    V low = edge;
    if constexpr (kRows == 16) low = hn::ConcatLowerUpper(d, v, edge);
    return hn::CombineShiftRightBytes<16 - kBytes>(d, v, low);
  } else {
    V high = edge;
    if constexpr (kRows == 16) high = hn::ConcatLowerUpper(d, edge, v);
    return hn::CombineShiftRightBytes<kBytes>(d, high, v);
  }
}

HWY_INLINE V Between(V a, V b, V share) {
  return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), share));
}

// What one order keeps from step to step. `c` are values of this plane, `b` of the one before; the
// digits say how far back along x and y.
struct Walk {
  V c10, c01, b00, b01;
};

// kAxis -1: upwind; else the characteristic through the face across that axis.
template <bool kForward, int kAxis>
HWY_INLINE void Step(const Layout& layout, const Order& o, int strip, int t, V first, V second,
                     Walk& w) {
  const D d;
  const V one = hn::Set(d, kOne);
  const std::ptrdiff_t at = strip * layout.strip_size() + t * static_cast<std::ptrdiff_t>(kRows);
  // The row beside this strip, at the same x, belongs to the strip swept before.
  const int across = kForward ? t + kRows - 1 : t - kRows + 1;
  const bool inside =
      kForward ? strip > 0 && across < layout.steps : strip + 1 < layout.strips && across >= 0;
  const std::ptrdiff_t other = (kForward ? strip - 1 : strip + 1) * layout.strip_size() +
                               across * static_cast<std::ptrdiff_t>(kRows);
  const V b00 = hn::Load(d, o.before + at);
  V c01 = one, b01 = one, visibility;
  if constexpr (kAxis != 2) {
    c01 = Beside<kForward>(w.c10, inside ? hn::Load(d, o.now + other) : one);
  }
  if constexpr (kAxis >= 0) {
    b01 = Beside<kForward>(w.b00, inside ? hn::Load(d, o.before + other) : one);
  }
  if constexpr (kAxis < 0) {
    visibility = hn::Add(b00, hn::Add(hn::MulFixedPoint15(hn::Sub(w.c10, b00), first),
                                      hn::MulFixedPoint15(hn::Sub(c01, b00), second)));
  } else if constexpr (kAxis == 0) {
    visibility = Between(Between(w.c10, w.c01, first), Between(w.b00, w.b01, first), second);
  } else if constexpr (kAxis == 1) {
    visibility = Between(Between(c01, w.c01, first), Between(b01, w.b01, first), second);
  } else {
    visibility = Between(Between(b00, w.b00, first), Between(b01, w.b01, first), second);
  }
  const V opacity = hn::Load(d, o.opacity + at);
  const V onward = hn::Sub(visibility, hn::MulFixedPoint15(visibility, opacity));
  hn::Store(onward, d, o.now + at);
  const hn::Rebind<std::uint8_t, D> d8;
  hn::Store(hn::DemoteTo(d8, hn::ShiftRight<7>(visibility)), d8, o.out + at);
  w = {onward, c01, b00, b01};
}

// Four orders in step: each waits for its own last vector, and the others fill the time.
template <int kAxis>
void SweepDirectionOf(const Layout& layout, const Order orders[4], float first_share,
                      float second_share) {
  const D d;
  auto share = [&](float s) HWY_ATTR {
    return hn::Set(d, static_cast<std::int16_t>(std::min(32767.0f, s * 32768.0f)));
  };
  const V first = share(first_share), second = share(second_share);
  const V one = hn::Set(d, kOne);
  for (int s = 0; s < layout.strips; ++s) {
    Walk w0{one, one, one, one}, w1 = w0, w2 = w0, w3 = w0;
    const int last = layout.strips - 1 - s;
    for (int t = 0; t < layout.steps; ++t) {
      const int back = layout.steps - 1 - t;
      Step<true, kAxis>(layout, orders[0], s, t, first, second, w0);
      Step<false, kAxis>(layout, orders[1], last, back, first, second, w1);
      Step<true, kAxis>(layout, orders[2], s, t, first, second, w2);
      Step<false, kAxis>(layout, orders[3], last, back, first, second, w3);
    }
  }
}

// Opacities of a plane as skewed vectors; rows beside the plane's are open.
void SkewPlane(const Layout& layout, const std::uint8_t* tau, int width, int height, bool mirrored,
               std::uint8_t* rows, std::ptrdiff_t pitch, std::int16_t* opacity) {
  const D d;
  const hn::Rebind<std::uint8_t, D> d8;
  const hn::RebindToUnsigned<D> du;
  HWY_ALIGN std::uint8_t columns[kBlock * kRows];
  for (int s = 0; s < layout.strips; ++s) {
    for (int j = 0; j < kRows; ++j) {
      std::uint8_t* row = rows + j * pitch + kBlock;
      const int y = s * kRows + j;
      if (y >= height) {
        std::memset(row, 255, static_cast<std::size_t>(width));
      } else if (mirrored) {
        const std::uint8_t* from = tau + static_cast<std::ptrdiff_t>(y) * width;
        std::reverse_copy(from, from + width, row);
      } else {
        std::memcpy(row, tau + static_cast<std::ptrdiff_t>(y) * width,
                    static_cast<std::size_t>(width));
      }
    }
    std::int16_t* to = opacity + s * layout.strip_size();
    for (int t = 0; t < layout.steps; t += kBlock) {
      SkewBytes<kRows>(rows + kBlock + t, pitch - 1, columns);
      for (int i = 0; i < kBlock; ++i, to += kRows) {
        const auto bytes = hn::Load(d8, columns + i * kRows);
        const auto v = hn::Sub(hn::Set(du, 255), hn::PromoteTo(du, bytes));
        // 255 becomes 32767, 0 stays.
        const auto wide = hn::Add(hn::ShiftLeft<7>(v), hn::ShiftRight<1>(v));
        hn::Store(hn::BitCast(d, wide), d, to);
      }
    }
  }
}

// kChannels rows of bytes, one per channel, become voxels of interleaved channels.
template <int kChannels>
void InterleaveRow(const std::uint8_t* const* channels, const bool* mirrored, int count, int width,
                   std::uint8_t* out, std::ptrdiff_t voxel) {
  const hn::Full128<std::uint8_t> d;
  HWY_ALIGN static constexpr std::uint8_t kBackward[16] = {15, 14, 13, 12, 11, 10, 9, 8,
                                                           7,  6,  5,  4,  3,  2,  1, 0};
  const auto backward = hn::Load(d, kBackward);
  HWY_ALIGN std::uint8_t block[kBlock * kChannels];
  for (int x = 0; x < width; x += kBlock) {
    hn::Vec<hn::Full128<std::uint8_t>> v[kChannels];
    for (int c = 0; c < kChannels; ++c) {
      if (c >= count) {
        v[c] = hn::Zero(d);
      } else if (mirrored[c]) {
        v[c] = hn::TableLookupBytes(hn::LoadU(d, channels[c] + width - kBlock - x), backward);
      } else {
        v[c] = hn::LoadU(d, channels[c] + x);
      }
    }
    PerfectShuffle<kChannels, Log2(kChannels)>(d, v);
    std::uint8_t* to = out + x * voxel;
    if constexpr (kChannels == kBlock) {
      if (count == kBlock / 2) {
        const hn::Half<decltype(d)> half;
        for (int i = 0; i < std::min(kBlock, width - x); ++i) {
          hn::StoreU(hn::LowerHalf(half, v[i]), half, to + i * voxel);
        }
        continue;
      }
      // A whole vector may run into the next voxel, which is written after it; not the last.
      const int whole = std::min(kBlock, width - 1 - x);
      for (int i = 0; i < whole; ++i) hn::StoreU(v[i], d, to + i * voxel);
      if (whole < kBlock) {
        hn::Store(v[whole], d, block);
        std::memcpy(to + whole * voxel, block, static_cast<std::size_t>(count));
      }
    } else if (voxel == kChannels && x + kBlock <= width) {
      for (int c = 0; c < kChannels; ++c) hn::StoreU(v[c], d, to + c * kBlock);
    } else {
      for (int c = 0; c < kChannels; ++c) hn::Store(v[c], d, block + c * kBlock);
      for (int i = 0; i < kBlock && x + i < width; ++i) {
        std::memcpy(to + i * voxel, block + i * kChannels, static_cast<std::size_t>(count));
      }
    }
  }
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
  // The plane before is kept apart where the stencil reads more of it than the voxel's own.
  const bool apart = sweep.directions[0].stencil == Stencil::kCharacteristic;
  std::vector<std::int16_t> state(
      (apart ? 2 : 1) * static_cast<std::size_t>(channels * plane) + spare, kOne);
  std::vector<std::uint8_t> out_storage(static_cast<std::size_t>(channels * plane) + spare);
  std::vector<std::uint8_t> rows_storage(static_cast<std::size_t>(channels) * kRows * pitch +
                                         spare);
  std::uint8_t* rows = Aligned(tau_rows);
  std::int16_t* opacity = Aligned(opacity_storage);
  std::int16_t* now = Aligned(state);
  std::int16_t* before = apart ? now + channels * plane : now;
  std::uint8_t* out = Aligned(out_storage);
  std::uint8_t* out_rows = Aligned(rows_storage);

  for (int k = 0; k < depth; ++k) {
    const int z = sweep.rising ? k : depth - 1 - k;
    const std::ptrdiff_t voxels = static_cast<std::ptrdiff_t>(width) * height;
    for (int m = 0; m < 2; ++m) {
      SkewPlane(layout, sweep.tau + z * voxels, width, height, m == 1, rows, pitch,
                opacity + m * plane);
    }
    for (int i = 0; i < sweep.count; ++i) {
      const SweepDirection& dir = sweep.directions[i];
      Order orders[4];
      for (int o = 0; o < 4; ++o) {
        const std::ptrdiff_t at = (o * sweep.count + i) * plane;
        orders[o] = {now + at, before + at, opacity + o / 2 * plane, out + at};
      }
      if (dir.stencil == Stencil::kUpwind) {
        SweepDirectionOf<-1>(layout, orders, dir.first, dir.second);
      } else if (dir.axis == 0) {
        SweepDirectionOf<0>(layout, orders, dir.first, dir.second);
      } else if (dir.axis == 1) {
        SweepDirectionOf<1>(layout, orders, dir.first, dir.second);
      } else {
        SweepDirectionOf<2>(layout, orders, dir.first, dir.second);
      }
    }
    if (apart) std::swap(now, before);

    // Orders 0 ... 3 sweep x and y up, both down, x down and y up, x up and y down; light comes
    // from the side that they leave.
    static constexpr int kOrderOf[4] = {0, 2, 3, 1};
    for (int s = 0; s < layout.strips; ++s) {
      for (int c = 0; c < channels; ++c) {
        const std::uint8_t* from = out + c * plane + s * layout.strip_size();
        std::uint8_t* to = out_rows + c * kRows * pitch + kBlock;
        for (int t = 0; t < layout.steps; t += kBlock) {
          UnskewBytes<kRows>(from + t * kRows, to + t, pitch - 1);
        }
      }
      for (int j = 0; j < kRows && s * kRows + j < height; ++j) {
        const std::uint8_t* channel_rows[4 * kMaxDirections];
        bool mirrored[4 * kMaxDirections];
        for (int c = 0; c < channels; ++c) {
          const int order = kOrderOf[c / sweep.count];
          channel_rows[c] =
              out_rows + ((order * sweep.count + c % sweep.count) * kRows + j) * pitch + kBlock;
          mirrored[c] = order >= 2;
        }
        std::uint8_t* to =
            sweep.visibility +
            (z * voxels + (s * kRows + j) * static_cast<std::ptrdiff_t>(width)) * channels;
        if (channels == 4) {
          InterleaveRow<4>(channel_rows, mirrored, 4, width, to, channels);
          continue;
        }
        for (int c = 0; c < channels; c += kBlock) {
          InterleaveRow<kBlock>(channel_rows + c, mirrored + c, std::min(kBlock, channels - c),
                                width, to + c, channels);
        }
      }
    }
  }
}

void TransmittanceRow(const float* const* rows, int row_count, std::ptrdiff_t stride, int width,
                      int cell, float scale, float alpha, std::uint8_t* HWY_RESTRICT tau) {
  auto byte = [=](float sum) {
    const float t = std::min(std::max(sum * scale + 0.5f, 0.0f), 1.0f);
    return static_cast<std::uint8_t>(255.0f * (1 - (1 - t) * alpha) + 0.5f);
  };
  if (stride == 1 && cell == 1 && row_count == 1) {
    const float* HWY_RESTRICT row = rows[0];
    for (int x = 0; x < width; ++x) tau[x] = byte(row[x]);
    return;
  }
  if (stride == 1 && cell == 2 && row_count == 4) {
    const float *HWY_RESTRICT a = rows[0], *HWY_RESTRICT b = rows[1];
    const float *HWY_RESTRICT c = rows[2], *HWY_RESTRICT e = rows[3];
    const int pairs = width / 2;
    for (int x = 0; x < pairs; ++x) {
      const float left = (a[2 * x] + b[2 * x]) + (c[2 * x] + e[2 * x]);
      const float right = (a[2 * x + 1] + b[2 * x + 1]) + (c[2 * x + 1] + e[2 * x + 1]);
      tau[x] = byte(left + right);
    }
    if (width % 2) {
      const int x = width - 1;
      tau[pairs] = byte(2 * ((a[x] + b[x]) + (c[x] + e[x])));
    }
    return;
  }
  for (int x = 0; x < (width + cell - 1) / cell; ++x) {
    float sum = 0;
    for (int i = 0; i < cell; ++i) {
      const std::ptrdiff_t at = std::min(x * cell + i, width - 1) * stride;
      for (int r = 0; r < row_count; ++r) sum += rows[r][at];
    }
    tau[x] = byte(sum);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
HWY_EXPORT(SweepOcclusion);
HWY_EXPORT(TransmittanceRow);

void sweep_occlusion_u8(const OcclusionSweep& sweep) {
  HWY_DYNAMIC_DISPATCH(SweepOcclusion)(sweep);
}
void transmittance_row(const float* const* rows, int row_count, std::ptrdiff_t stride, int width,
                       int cell, float scale, float alpha, std::uint8_t* tau) {
  HWY_DYNAMIC_DISPATCH(TransmittanceRow)
  (rows, row_count, stride, width, cell, scale, alpha, tau);
}

}  // namespace obscura
#endif  // HWY_ONCE
