// The walk of a sweep through the strips of a plane; included once per SIMD target.
#if defined(OBSCURA_SRC_VOLUME_STRIP_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_VOLUME_STRIP_WALK_INL_H_
#undef OBSCURA_SRC_VOLUME_STRIP_WALK_INL_H_
#else
#define OBSCURA_SRC_VOLUME_STRIP_WALK_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwy/highway.h"
#include "volume/occlusion_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// Visibility is a 15-bit fraction; kOne is 1.
using D = hn::CappedTag<std::int16_t, 32>;
using V = hn::Vec<D>;
constexpr int kLanes = std::min(32, static_cast<int>(HWY_LANES(std::int16_t)));
// Rows of a strip. Wider vectors hold two sides: an order and its mirror image.
constexpr int kRows = std::min(16, kLanes), kSides = kLanes / kRows;
using RowsTag = hn::CappedTag<std::int16_t, 16>;
constexpr std::int16_t kOne = 32767;

// There are four orders within a plane. 0 and 1 read the plane as it is, 2 and 3 mirrored in x; 1
// and 3 go backward, from the end of the last row. A lane group is one order, or with two sides
// orders 0 and 2, or 1 and 3.
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
  V other = edge;  // the blocks of 16 bytes from which lanes are shifted in
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
  // Values kept from step to step: `c` of this plane, `b` of the previous plane. The digits say how
  // many voxels back they are along x and y.
  V c10_, c01_, b00_, b01_;
  std::int16_t* now_;
  const std::int16_t *before_, *opacity_;
  std::uint8_t* out_[kSides];
  std::ptrdiff_t at_, other_;
};

// Sweeps directions with one stencil in all four orders at the same time, each through one strip:
// those that go forward through strip s, those that go backward through the s-th from the end. Each
// waits for its own previous vector, and meanwhile the others are computed.
template <int kAxis, std::size_t... kWalks>
void SweepDirections(const Layout& layout, const Order* orders, const SweepDirection* directions,
                     int s, std::index_sequence<kWalks...>) {
  const int steps = layout.steps;
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

// kTogether directions with the stencil of the first.
template <int kTogether>
void SweepAlike(const Layout& layout, const Order* orders, const SweepDirection* directions,
                int strip) {
  constexpr std::make_index_sequence<kTogether * kGroups / 2> kWalks;
  if (directions->stencil == Stencil::kUpwind) {
    SweepDirections<-1>(layout, orders, directions, strip, kWalks);
  } else if (directions->axis == 0) {
    SweepDirections<0>(layout, orders, directions, strip, kWalks);
  } else if (directions->axis == 1) {
    SweepDirections<1>(layout, orders, directions, strip, kWalks);
  } else {
    SweepDirections<2>(layout, orders, directions, strip, kWalks);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
