// Chains of horizon points, over Highway lanes; included once per SIMD target.
#if defined(OBSCURA_SRC_TERRAIN_CHAINS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_TERRAIN_CHAINS_INL_H_
#undef OBSCURA_SRC_TERRAIN_CHAINS_INL_H_
#else
#define OBSCURA_SRC_TERRAIN_CHAINS_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "terrain/sweep_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr int kLanes = HWY_LANES(float) < 16 ? HWY_LANES(float) : 16;
// Vectors in step: one waits for its gather while the other computes.
constexpr int kTogether = 2;
constexpr int kStep = kLanes * kTogether;
static_assert(kLines % kStep == 0);

// Pairs {height, slot} of a row of lines, kept so that storing, loading and gathering them are
// cheap: each 16 bytes hold two pairs, those of lanes 0 and 1 of every four lanes in a vector's
// first half, those of lanes 2 and 3 in its second.
HWY_INLINE void StorePairs(V height, V slot, float* HWY_RESTRICT to) {
  const D d;
  hn::StoreU(hn::InterleaveLower(d, height, slot), d, to);
  hn::StoreU(hn::InterleaveUpper(d, height, slot), d, to + kLanes);
}
HWY_INLINE void LoadPairs(const float* HWY_RESTRICT from, V* height, V* slot) {
  const D d;
  const V a = hn::LoadU(d, from), b = hn::LoadU(d, from + kLanes);
  const V even = hn::InterleaveLower(d, a, b), odd = hn::InterleaveUpper(d, a, b);
  *height = hn::InterleaveLower(d, even, odd);
  *slot = hn::InterleaveUpper(d, even, odd);
}
constexpr int PairOfLane(int lane) {
  return lane % 4 < 2 ? lane / 4 * 2 + lane % 4 : kLanes / 2 + lane / 4 * 2 + lane % 4 - 2;
}

// Chains of points that are horizons of one another. A line's point in a row has a slot, which
// counts rows in the order in which points were added, from 1. Stored with each point is its
// horizon among those added before it, so that from any point the chain leads along the upper hull
// of what lies before it. Slot 0 ends all chains.
class Chains {
 public:
  explicit Chains(float* pairs) : pairs_(pairs) {
    for (int i = 0; i < kLanes; ++i) pair_of_lane_[i] = PairOfLane(i);
    Clear(0);
  }

  // Ends the chains of all lines in a slot.
  void Clear(int slot) {
    for (int i = 0; i < kLines; i += kLanes) ClearLines(slot, i);
  }
  HWY_INLINE void ClearLines(int slot, int first) {
    StorePairs(hn::Set(D(), kChainEnd), hn::Zero(D()), At(slot, first));
  }

  // Ends one line's chain in a slot, or leads it on to the point `height` of another slot.
  void Set(int slot, int line, float height, int to) {
    float* pair = At(slot, line / kLanes * kLanes) + 2 * PairOfLane(line % kLanes);
    pair[0] = height;
    pair[1] = static_cast<float>(to);
  }
  // The next point of one line's chain; false at its end.
  bool Next(int slot, int line, float* height, int* to) const {
    const float* pair = At(slot, line / kLanes * kLanes) + 2 * PairOfLane(line % kLanes);
    *height = pair[0];
    *to = static_cast<int>(pair[1]);
    return *to > 0;
  }

  // Climbs from the points at `height` and `distance` (in rows, from the viewers at `z`) along the
  // chains stored in `slot`, as long as the next point has the larger slope. The next point is at
  // the distance `origin` - its slot if `kBack`, else `origin` + its slot.
  template <bool kBack>
  HWY_INLINE void Climb(int slot, int first, float origin, const V* z, V* height,
                        V* distance) const {
    const D d;
    const hn::RebindToSigned<D> di;
    const V from = hn::Set(d, origin);
    const auto lane = hn::Load(di, pair_of_lane_);
    V next[kTogether], next_slot[kTogether];
    for (int u = 0; u < kTogether; ++u) {
      LoadPairs(At(slot, first + u * kLanes), &next[u], &next_slot[u]);
    }
    for (;;) {
      M higher[kTogether];
      V far[kTogether];
      for (int u = 0; u < kTogether; ++u) {
        far[u] = kBack ? hn::Sub(from, next_slot[u]) : hn::Add(from, next_slot[u]);
        higher[u] = hn::Gt(hn::Mul(hn::Sub(next[u], z[u]), distance[u]),
                           hn::Mul(hn::Sub(height[u], z[u]), far[u]));
      }
      static_assert(kTogether == 2);
      if (hn::AllFalse(d, hn::Or(higher[0], higher[1]))) return;
      for (int u = 0; u < kTogether; ++u) {
        height[u] = hn::IfThenElse(higher[u], next[u], height[u]);
        distance[u] = hn::IfThenElse(higher[u], far[u], distance[u]);
        // A lane that stays finds what it has again: its next point is stored with the one it is
        // at.
        const V at = kBack ? hn::Sub(from, distance[u]) : hn::Sub(distance[u], from);
        HWY_ALIGN std::int32_t index[kLanes];
        hn::Store(hn::Add(hn::ShiftLeft<kLinesLog2>(hn::ConvertTo(di, at)), lane), di, index);
        GatherPairs(d, At(0, first + u * kLanes), index, &next[u], &next_slot[u]);
      }
    }
  }

  // Adds the points of a row, at `z`, whose neighbours in the row before are at `before`; leaves
  // their horizons' heights and distances.
  HWY_INLINE void Add(int slot, int first, const V* z, const float* HWY_RESTRICT before, V* height,
                      V* distance) {
    const D d;
    for (int u = 0; u < kTogether; ++u) {
      height[u] = hn::LoadU(d, before + first + u * kLanes);
      distance[u] = hn::Set(d, 1.0f);
    }
    const float origin = static_cast<float>(slot);
    Climb<true>(slot - 1, first, origin, z, height, distance);
    for (int u = 0; u < kTogether; ++u) {
      StorePairs(height[u], hn::Sub(hn::Set(d, origin), distance[u]), At(slot, first + u * kLanes));
    }
  }

 private:
  float* At(int slot, int line) const {
    return pairs_ + 2 * (static_cast<std::ptrdiff_t>(slot) * kLines + line);
  }

  float* pairs_;
  HWY_ALIGN std::int32_t pair_of_lane_[kLanes];
};

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
