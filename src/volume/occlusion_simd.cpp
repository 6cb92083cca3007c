#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "volume/occlusion_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/occlusion_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/cache_control.h"
#include "hwy/highway.h"
#include "volume/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// Visibility is a 15-bit fraction; kOne is 1.
using D = hn::CappedTag<std::int16_t, 32>;
using V = hn::Vec<D>;
constexpr int kLanes = std::min(32, static_cast<int>(HWY_LANES(std::int16_t)));
// Rows of a strip. Wider vectors hold an order and its mirror image side by side.
constexpr int kRows = std::min(16, kLanes), kSides = kLanes / kRows;
using RowsTag = hn::CappedTag<std::int16_t, 16>;
constexpr std::int16_t kOne = 32767;
constexpr int kBlock = 16;  // bytes transposed at a time

template <class T>
T* Aligned(std::vector<T>& storage) {
  const auto address = reinterpret_cast<std::uintptr_t>(storage.data());
  return storage.data() + (64 - address % 64) % 64 / sizeof(T);
}

// Order 0 and 1 of the four within a plane read it as it is, 2 and 3 mirrored in x; odd ones go
// backward, from the last row's end. A lane group is an order, or with two sides 0 and 2 or 1
// and 3.
constexpr int kGroups = 4 / kSides;

// One direction of a lane group, as its strips are swept.
struct Order {
  std::int16_t* now;            // W = V tau of this plane, skewed
  const std::int16_t* before;   // of the plane before along z; may be `now` for the upwind stencil
  const std::int16_t* opacity;  // 1 - tau, skewed
  std::uint8_t* out[2];         // V, skewed, of either side
};
struct Layout {
  int strips, steps;
  std::ptrdiff_t strip_size() const { return static_cast<std::ptrdiff_t>(steps) * kRows; }
};

// On either side, v0 v1 ... -> edge's last, v0, v1, ... forward; v1, v2, ..., edge's first
// backward.
template <bool kForward>
HWY_INLINE V Beside(V v, V edge) {
  const D d;
  constexpr int kBytes = static_cast<int>(sizeof(std::int16_t));
  V other = edge;  // blocks of 16 bytes that lanes move in from
  if constexpr (kRows == 16) {
    other =
        hn::SwapAdjacentBlocks(kForward ? hn::OddEvenBlocks(edge, v) : hn::OddEvenBlocks(v, edge));
  }
  return kForward ? hn::CombineShiftRightBytes<16 - kBytes>(d, v, other)
                  : hn::CombineShiftRightBytes<kBytes>(d, other, v);
}

HWY_INLINE V Between(V a, V b, V share) {
  return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), share));
}

// An order within one strip, vector by vector. The row beside the strip belongs to the one swept
// before, whose vector at the same x lies kRows - 1 vectors further on.
// kAxis -1: upwind; else the characteristic through the face across that axis.
template <bool kForward, int kAxis>
class StripWalk {
 public:
  void start(const Layout& layout, const Order& o, const SweepDirection& direction, int strip) {
    const D d;
    auto share = [&](float s) HWY_ATTR {
      return hn::Set(d, static_cast<std::int16_t>(std::min(32767.0f, s * 32768.0f)));
    };
    first_ = share(direction.first);
    second_ = share(direction.second);
    const V one = hn::Set(d, kOne);
    c10_ = c01_ = b00_ = b01_ = one;
    now_ = o.now;
    before_ = o.before;
    opacity_ = o.opacity;
    for (int side = 0; side < kSides; ++side) out_[side] = o.out[side];
    const std::ptrdiff_t size = layout.strip_size() * kSides;
    at_ = (kForward ? strip : layout.strips - 1 - strip) * size;
    other_ = kForward ? at_ - size : at_ + size;
    if (!kForward) {
      at_ += size - kLanes;
      other_ += size - kLanes;
    }
    other_ += kStep * (kRows - 1);
  }

  // kEdge: there is a vector beside the strip; else it is open.
  template <bool kEdge>
  HWY_INLINE void step() {
    const D d;
    const V one = hn::Set(d, kOne), first = first_, second = second_;
    const V b00 = hn::Load(d, before_ + at_);
    V c01 = one, b01 = one, visibility;
    if constexpr (kAxis != 2) {
      c01 = Beside<kForward>(c10_, kEdge ? hn::Load(d, now_ + other_) : one);
    }
    if constexpr (kAxis >= 0) {
      b01 = Beside<kForward>(b00_, kEdge ? hn::Load(d, before_ + other_) : one);
    }
    if constexpr (kAxis < 0) {
      visibility = hn::Add(b00, hn::Add(hn::MulFixedPoint15(hn::Sub(c10_, b00), first),
                                        hn::MulFixedPoint15(hn::Sub(c01, b00), second)));
    } else if constexpr (kAxis == 0) {
      visibility = Between(Between(c10_, c01_, first), Between(b00_, b01_, first), second);
    } else if constexpr (kAxis == 1) {
      visibility = Between(Between(c01, c01_, first), Between(b01, b01_, first), second);
    } else {
      visibility = Between(Between(b00, b00_, first), Between(b01, b01_, first), second);
    }
    const V opacity = hn::Load(d, opacity_ + at_);
    const V onward = hn::Sub(visibility, hn::MulFixedPoint15(visibility, opacity));
    hn::Store(onward, d, now_ + at_);
    const hn::Rebind<std::uint8_t, D> d8;
    const auto bytes = hn::DemoteTo(d8, hn::ShiftRight<7>(visibility));
    if constexpr (kSides == 1) {
      hn::Store(bytes, d8, out_[0] + at_);
    } else {
      const hn::Half<decltype(d8)> dh;
      hn::Store(hn::LowerHalf(dh, bytes), dh, out_[0] + at_ / kSides);
      hn::Store(hn::UpperHalf(dh, bytes), dh, out_[1] + at_ / kSides);
    }
    c10_ = onward;
    c01_ = c01;
    b00_ = b00;
    b01_ = b01;
    at_ += kStep;
    other_ += kStep;
  }

 private:
  static constexpr std::ptrdiff_t kStep = kForward ? kLanes : -kLanes;
  V first_, second_;
  // What it keeps from step to step. `c` are values of this plane, `b` of the one before; the
  // digits say how far back along x and y.
  V c10_, c01_, b00_, b01_;
  std::int16_t* now_;
  const std::int16_t *before_, *opacity_;
  std::uint8_t* out_[kSides];
  std::ptrdiff_t at_, other_;
};

// Directions with one stencil in all four orders, in step: each waits for its own last vector, and
// the others fill the time.
template <int kAxis, std::size_t... kWalks>
void SweepDirections(const Layout& layout, const Order* orders, const SweepDirection* directions,
                     std::index_sequence<kWalks...>) {
  const int steps = layout.steps;
  for (int s = 0; s < layout.strips; ++s) {
    // Walk i is of direction i / pairs and of the lane groups 2 (i % pairs) and one more.
    constexpr int kPairs = kGroups / 2;
    StripWalk<true, kAxis> up[sizeof...(kWalks)];
    StripWalk<false, kAxis> down[sizeof...(kWalks)];
    (up[kWalks].start(layout, orders[2 * kWalks], directions[kWalks / kPairs], s), ...);
    (down[kWalks].start(layout, orders[2 * kWalks + 1], directions[kWalks / kPairs], s), ...);
    int t = 0;
    if (s > 0) {
      for (; t < steps - kRows + 1; ++t) {
        ((up[kWalks].template step<true>(), down[kWalks].template step<true>()), ...);
      }
    }
    for (; t < steps; ++t) {
      ((up[kWalks].template step<false>(), down[kWalks].template step<false>()), ...);
    }
  }
}

// kTogether directions with the stencil of the first.
template <int kTogether>
void SweepAlike(const Layout& layout, const Order* orders, const SweepDirection* directions) {
  constexpr std::make_index_sequence<kTogether * kGroups / 2> kWalks;
  if (directions->stencil == Stencil::kUpwind) {
    SweepDirections<-1>(layout, orders, directions, kWalks);
  } else if (directions->axis == 0) {
    SweepDirections<0>(layout, orders, directions, kWalks);
  } else if (directions->axis == 1) {
    SweepDirections<1>(layout, orders, directions, kWalks);
  } else {
    SweepDirections<2>(layout, orders, directions, kWalks);
  }
}

// Opacities of a plane as skewed vectors; rows beside the plane's are open.
void SkewPlane(const Layout& layout, const std::uint8_t* tau, int width, int height, bool mirrored,
               std::uint8_t* rows, std::ptrdiff_t pitch, std::int16_t* opacity) {
  const RowsTag d;
  const hn::Rebind<std::uint8_t, RowsTag> d8;
  const hn::RebindToUnsigned<RowsTag> du;
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
    std::int16_t* to = opacity + s * layout.strip_size() * kSides;
    for (int t = 0; t < layout.steps; t += kBlock) {
      SkewBytes<kRows>(rows + kBlock + t, pitch - 1, columns);
      for (int i = 0; i < kBlock; ++i, to += kLanes) {
        const auto bytes = hn::Load(d8, columns + i * kRows);
        const auto v = hn::Sub(hn::Set(du, 255), hn::PromoteTo(du, bytes));
        // 255 becomes 32767, 0 stays.
        const auto wide = hn::Add(hn::ShiftLeft<7>(v), hn::ShiftRight<1>(v));
        hn::Store(hn::BitCast(d, wide), d, to);
      }
    }
  }
}

// One strip's visibilities as they are swept and the voxels that they become.
struct Strip {
  const std::uint8_t* const* channels;  // skewed
  int steps, rows, width;
  std::uint8_t* voxels;  // the channels' first in the first voxel of the strip
  std::ptrdiff_t voxel;  // bytes from voxel to voxel
  // The strip after this one, for the cache: sixteen rows at a time are more than it foresees.
  const std::uint8_t* next;
};
constexpr int kCacheLine = 64;

// Writes the kUsed bytes of a turned voxel. A loose one may be followed by bytes that are yet to be
// written.
template <int kUsed, bool kLoose>
HWY_INLINE void CopyVoxel(const std::uint8_t* from, std::ptrdiff_t next, std::uint8_t* to) {
  constexpr int kFirst = kUsed <= 8 ? (kLoose ? 8 : 4) : std::min(16, kLoose ? 16 : kUsed);
  std::memcpy(to, from, kFirst);
  if constexpr (kUsed > 16) {
    std::memcpy(to + 16, from + next, kUsed - 16);
  } else if constexpr (kUsed > kFirst) {
    std::memcpy(to + kFirst, from + kFirst, kUsed - kFirst);
  }
}

// Turns channels of voxels into voxels of kUsed channels.
template <int kUsed, bool kMirrored>
void StoreStrip(const Strip& strip) {
  constexpr int kRoom = kUsed <= 8 ? 8 : kUsed <= 16 ? 16 : 32;  // bytes of a turned voxel
  constexpr int kPerBlock = kRoom < 16 ? 16 / kRoom : 1, kBlocks = kRoom < 16 ? 1 : kRoom / 16;
  const hn::ScalableTag<std::uint8_t> d;
  using VB = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d)), together = lanes / kRows;
  HWY_ALIGN std::uint8_t turned[HWY_MAX_BYTES * kRoom];
  // Copies, as bytes are written that might be anything.
  const int steps = strip.steps, rows = strip.rows, width = strip.width;
  const std::ptrdiff_t voxel = strip.voxel, across = (kMirrored ? width + 1 : width - 1) * voxel;
  std::uint8_t* const voxels = strip.voxels;
  const std::uint8_t* channels[kUsed];
  std::copy_n(strip.channels, kUsed, channels);
  const std::ptrdiff_t ahead = kMirrored ? 0 : rows * width * voxel * together / steps + kCacheLine;
  const std::uint8_t* next = strip.next;
  for (int t = 0; t < steps; t += together) {
    for (std::ptrdiff_t i = 0; i < ahead; i += kCacheLine) hwy::Prefetch(next + i);
    next += ahead;
    VB v[kRoom];
    for (int c = 0; c < kRoom; ++c) {
      v[c] = c < kUsed ? hn::LoadU(d, channels[c] + t * kRows) : hn::Zero(d);
    }
    PerfectShuffle<kRoom, Log2(kRoom)>(d, v);
    for (int c = 0; c < kRoom; ++c) hn::Store(v[c], d, turned + c * lanes);
    // Shuffles stay within blocks of 16 bytes: such a block's voxels now stand in that block of one
    // vector after the other.
    for (int i = 0; i < together; ++i) {
      const int x = t + i;  // of lane 0; each lane is one behind the one before it
      const std::uint8_t* from = turned + i * kRows / 16 * 16 + i * kRows % 16 * kRoom / 16 * lanes;
      const std::ptrdiff_t column = kMirrored ? width - 1 - x : x;
      if (rows == kRows && x >= kRows - 1 && x < width - 1) {
        std::uint8_t* to = voxels + column * voxel;
        for (int j = 0; j < kRows; j += kPerBlock) {
          for (int b = 0; b < kPerBlock; ++b, to += across) {
            CopyVoxel<kUsed, !kMirrored>(from + b * kRoom, lanes, to);
          }
          from += kBlocks * lanes;
        }
        continue;
      }
      const int first = std::max(0, x - width + 1), last = std::min(rows - 1, x);
      for (int j = first; j <= last; ++j) {
        CopyVoxel<kUsed, false>(from + j / kPerBlock * kBlocks * lanes + j % kPerBlock * kRoom,
                                lanes, voxels + column * voxel + j * across);
      }
    }
  }
}

// Four rows of bytes, one per channel, become voxels of four bytes.
void InterleaveRow(const std::uint8_t* const channels[4], const bool mirrored[4], int width,
                   std::uint8_t* out) {
  constexpr int kChannels = 4;
  const hn::Full128<std::uint8_t> d;
  HWY_ALIGN static constexpr std::uint8_t kBackward[16] = {15, 14, 13, 12, 11, 10, 9, 8,
                                                           7,  6,  5,  4,  3,  2,  1, 0};
  const auto backward = hn::Load(d, kBackward);
  HWY_ALIGN std::uint8_t block[kBlock * kChannels];
  for (int x = 0; x < width; x += kBlock) {
    hn::Vec<hn::Full128<std::uint8_t>> v[kChannels];
    for (int c = 0; c < kChannels; ++c) {
      v[c] = mirrored[c]
                 ? hn::TableLookupBytes(hn::LoadU(d, channels[c] + width - kBlock - x), backward)
                 : hn::LoadU(d, channels[c] + x);
    }
    PerfectShuffle<kChannels, Log2(kChannels)>(d, v);
    std::uint8_t* to = out + x * kChannels;
    if (x + kBlock <= width) {
      for (int c = 0; c < kChannels; ++c) hn::StoreU(v[c], d, to + c * kBlock);
    } else {
      for (int c = 0; c < kChannels; ++c) hn::Store(v[c], d, block + c * kBlock);
      std::memcpy(to, block, static_cast<std::size_t>(kChannels * (width - x)));
    }
  }
}

// The same for one direction: its voxels of four bytes are better written row by row.
void StoreRows(const Layout& layout, const std::uint8_t* const channels[4], int rows, int width,
               std::uint8_t* scratch, std::ptrdiff_t pitch, std::uint8_t* voxels) {
  for (int c = 0; c < 4; ++c) {
    std::uint8_t* to = scratch + c * kRows * pitch + kBlock;
    for (int t = 0; t < layout.steps; t += kBlock) {
      UnskewBytes<kRows>(channels[c] + t * kRows, to + t, pitch - 1);
    }
  }
  constexpr bool kMirrored[4] = {false, false, true, true};
  for (int j = 0; j < rows; ++j) {
    const std::uint8_t* of_row[4];
    for (int c = 0; c < 4; ++c) of_row[c] = scratch + (c * kRows + j) * pitch + kBlock;
    InterleaveRow(of_row, kMirrored, width, voxels + std::ptrdiff_t{4} * j * width);
  }
}

template <int kCount>
void StoreHalves(const Strip& strip) {
  StoreStrip<2 * kCount, false>(strip);
  Strip mirrored = strip;
  mirrored.channels += 2 * kCount;
  mirrored.voxels += 2 * kCount;
  StoreStrip<2 * kCount, true>(mirrored);
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
      // The upwind stencil keeps little and waits long: three directions fill wide registers.
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

// As many of a row's cells as fill vectors; returns how many that is.
template <int kCell>
int TransmittanceVectors(const float* const* rows, int width, float scale, float alpha,
                         std::uint8_t* HWY_RESTRICT tau) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  using VF = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const VF zero = hn::Zero(d), half = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f);
  const VF by = hn::Set(d, scale), opacity = hn::Set(d, alpha), full = hn::Set(d, 255.0f);
  auto down = [&](int x) HWY_ATTR {
    if constexpr (kCell == 1) return hn::LoadU(d, rows[0] + x);
    return hn::Add(hn::Add(hn::LoadU(d, rows[0] + x), hn::LoadU(d, rows[1] + x)),
                   hn::Add(hn::LoadU(d, rows[2] + x), hn::LoadU(d, rows[3] + x)));
  };
  int x = 0;
  const int floats_of_line = kCacheLine / static_cast<int>(sizeof(float));
  for (; (x + lanes) * kCell <= width; x += lanes) {
    // The rows after these come next.
    for (int r = 0; r < kCell * kCell; ++r) {
      for (int i = 0; i < kCell * lanes; i += floats_of_line) {
        hwy::Prefetch(rows[r] + kCell * (width + x) + i);
      }
    }
    VF sum = down(x * kCell);
    if constexpr (kCell == 2) {
      const VF next = down(x * kCell + lanes);
      sum = hn::Add(hn::ConcatEven(d, next, sum), hn::ConcatOdd(d, next, sum));
    }
    const VF t = hn::Min(hn::Max(hn::Add(hn::Mul(sum, by), half), zero), one);
    const VF open = hn::Sub(one, hn::Mul(hn::Sub(one, t), opacity));
    const auto byte = hn::ConvertTo(di, hn::Add(hn::Mul(open, full), half));
    hn::StoreU(hn::DemoteTo(d8, byte), d8, tau + x);
  }
  return x;
}

void TransmittanceRow(const float* const* rows, int row_count, std::ptrdiff_t stride, int width,
                      int cell, float scale, float alpha, std::uint8_t* HWY_RESTRICT tau) {
  auto byte = [=](float sum) {
    const float t = std::min(std::max(sum * scale + 0.5f, 0.0f), 1.0f);
    return static_cast<std::uint8_t>(255.0f * (1 - (1 - t) * alpha) + 0.5f);
  };
  int x = 0;
  if (stride == 1 && cell == 1 && row_count == 1) {
    x = TransmittanceVectors<1>(rows, width, scale, alpha, tau);
  } else if (stride == 1 && cell == 2 && row_count == 4) {
    x = TransmittanceVectors<2>(rows, width, scale, alpha, tau);
  }
  for (; x < (width + cell - 1) / cell; ++x) {
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
