#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>

#include "volume/distance_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/distance_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "volume/distance_quadratic-inl.h"
#include "volume/transpose-inl.h"

#ifndef OBSCURA_DISTANCE_SIMD_ONCE
#define OBSCURA_DISTANCE_SIMD_ONCE
namespace obscura {
// Lanes of a vector, strips swept together, steps from one to the next, steps between two looks at
// the gate.
struct DistanceShape {
  int lanes, together, lag, chunk;
};
// What the kernel sees of a stage.
struct DistancePlane {
  float* grid;
  std::ptrdiff_t stride_x, stride_y;
  int width, height;
  float spacing[3];
  bool mirrored;
  int strips, steps;
  std::ptrdiff_t row_pitch;
  float *plane, *before, *rows;
};

// What one group of strips has swept, and what it waits for: vectors of the group before it, from
// `begin` on.
struct DistanceGate {
  const WaitCount* before = nullptr;  // null: the first group
  WaitCount* done = nullptr;
  int begin = 0;
};
}  // namespace obscura
#endif

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

constexpr int kLanes = HWY_LANES(float) < 16 ? HWY_LANES(float) : 16;
// Strips swept at the same time, each a little behind the one before it. An update waits for the
// result of the vector before; four independent strips hide this latency.
constexpr int kTogether = 4;

// [edge's last lane, v0, v1, ...] or, backward, [v1, ..., edge's first lane].
template <bool kForward, class Indices>
HWY_INLINE V Neighbours(V v, V edge, M edge_lane, Indices turn) {
  return hn::TableLookupLanes(hn::IfThenElse(edge_lane, edge, v), turn);
}

constexpr int kLag = kLanes + 1;
constexpr int kChunk = 32;  // vectors between two looks at the gate

// Strips of a group, and steps until its last strip is swept.
HWY_INLINE int StripsOf(const DistancePlane& p, int group) {
  return std::min(kTogether, p.strips - group * kTogether);
}
HWY_INLINE int CountOf(const DistancePlane& p, int group) {
  return p.steps + kLag * (StripsOf(p, group) - 1);
}

// Sweeps a group of strips of the skewed plane in the order of rising t and rows, or of falling
// ones.
template <bool kForward, bool kCubic>
bool SweepGroup(const DistancePlane& p, int group, const DistanceGate& gate) {
  const D d;
  const hn::RebindToSigned<D> di;
  HWY_ALIGN std::int32_t turn_lanes[kLanes];
  for (int i = 0; i < kLanes; ++i) turn_lanes[i] = (i + (kForward ? kLanes - 1 : 1)) % kLanes;
  const auto turn = hn::SetTableIndices(d, turn_lanes);
  const M edge_lane =
      hn::RebindMask(d, hn::Eq(hn::Iota(di, 0), hn::Set(di, kForward ? kLanes - 1 : 0)));
  const Quadratic<kCubic> quadratic(p.spacing);
  float inverse = 0;
  for (float h : p.spacing) inverse += 1 / (h * h);
  // No estimate is nearer to the smallest neighbour than this.
  const V least_step = hn::Set(d, 0.999f / std::sqrt(inverse));
  const V outside = hn::Set(d, kOutsideDistance);
  const std::ptrdiff_t strip_size = static_cast<std::ptrdiff_t>(p.steps) * kLanes;
  M changed = hn::MaskFromVec(hn::Zero(d));
  const int first = group * kTogether, together = StripsOf(p, group);
  V previous[kTogether] = {outside, outside, outside, outside};
  const int count = CountOf(p, group);
  // The row beside the group's first strip belongs to the last strip of the group before it.
  const int neighbour = kForward ? group - 1 : group + 1;
  const int all = gate.before ? CountOf(p, neighbour) : 0;
  const int ahead = gate.before ? kLanes - 1 + kLag * (StripsOf(p, neighbour) - 1) : 0;
  for (int chunk = 0; chunk < count; chunk += kChunk) {
    const int end = std::min(chunk + kChunk, count);
    if (gate.before) gate.before->wait_for(gate.begin + std::min(end + ahead, all));
    for (int i = chunk; i < end; ++i) {
      for (int q = 0; q < kTogether; ++q) {
        const int step = i - kLag * q;
        if (q >= together || step < 0 || step >= p.steps) continue;
        const int strip = kForward ? first + q : first + together - 1 - q;
        const int t = kForward ? step : p.steps - 1 - step;
        const std::ptrdiff_t at = strip * strip_size + t * static_cast<std::ptrdiff_t>(kLanes);
        // The row beside this strip, at the same x, belongs to the strip swept before.
        const int across = kForward ? t + kLanes - 1 : t - kLanes + 1;
        const bool inside =
            kForward ? strip > 0 && across < p.steps : strip + 1 < p.strips && across >= 0;
        const std::ptrdiff_t other = (kForward ? strip - 1 : strip + 1) * strip_size +
                                     across * static_cast<std::ptrdiff_t>(kLanes);
        const V edge = inside ? hn::Load(d, p.plane + other) : outside;
        const V x = previous[q];
        const V y = Neighbours<kForward>(x, edge, edge_lane, turn);
        const V z = hn::Load(d, p.before + at);
        const V current = hn::Load(d, p.plane + at);
        const V least = hn::Min(x, hn::Min(y, z));
        const M may =
            hn::AndNot(hn::Eq(current, outside), hn::Gt(current, hn::Add(least, least_step)));
        V value = current;
        if (!hn::AllFalse(d, may)) {
          const V estimate = hn::Add(least, quadratic(x, y, z, least));
          const M better = hn::And(may, hn::Lt(estimate, current));
          value = hn::IfThenElse(better, estimate, current);
          changed = hn::Or(changed, better);
          hn::Store(value, d, p.plane + at);
        }
        previous[q] = value;
      }
    }
    gate.done->set(gate.begin + end);
  }
  return !hn::AllFalse(d, changed);
}

// Between a row of the grid and a padded row of magnitudes, which is mirrored on demand.
void ReadRow(const DistancePlane& p, int y, float* HWY_RESTRICT row) {
  const float* HWY_RESTRICT grid = p.grid + y * p.stride_y;
  const int n = p.width;
  if (p.stride_x != 1) {
    for (int x = 0; x < n; ++x) row[p.mirrored ? n - 1 - x : x] = std::fabs(grid[x * p.stride_x]);
  } else if (p.mirrored) {
    for (int x = 0; x < n; ++x) row[x] = std::fabs(grid[n - 1 - x]);
  } else {
    for (int x = 0; x < n; ++x) row[x] = std::fabs(grid[x]);
  }
}
void WriteRow(const DistancePlane& p, int y, const float* HWY_RESTRICT row) {
  float* HWY_RESTRICT grid = p.grid + y * p.stride_y;
  const int n = p.width;
  if (p.stride_x != 1) {
    for (int x = 0; x < n; ++x) {
      float& g = grid[x * p.stride_x];
      g = std::copysign(row[p.mirrored ? n - 1 - x : x], g);
    }
  } else if (p.mirrored) {
    for (int x = 0; x < n; ++x) grid[x] = std::copysign(row[n - 1 - x], grid[x]);
  } else {
    for (int x = 0; x < n; ++x) grid[x] = std::copysign(row[x], grid[x]);
  }
}

void ReadGroup(const DistancePlane& p, int group) {
  const std::ptrdiff_t strip_size = static_cast<std::ptrdiff_t>(p.steps) * kLanes;
  const int first = group * kTogether, end = first + StripsOf(p, group);
  for (int strip = first; strip < end; ++strip) {
    for (int j = 0; j < kLanes; ++j) {
      float* row = p.rows + j * p.row_pitch + kLanes;
      const int y = strip * kLanes + j;
      if (y < p.height) {
        ReadRow(p, y, row);
      } else {
        std::fill_n(row, p.width, kOutsideDistance);
      }
    }
    const float* from = p.rows + kLanes;
    for (int t = 0; t < p.steps; t += 4) {
      SkewFloats<kLanes>(from + t, p.row_pitch - 1, p.plane + strip * strip_size + t * kLanes);
    }
  }
}

void WriteGroup(const DistancePlane& p, int group) {
  const std::ptrdiff_t strip_size = static_cast<std::ptrdiff_t>(p.steps) * kLanes;
  const int first = group * kTogether, end = first + StripsOf(p, group);
  for (int strip = first; strip < end; ++strip) {
    float* to = p.rows + kLanes;
    for (int t = 0; t < p.steps; t += 4) {
      UnskewFloats<kLanes>(p.plane + strip * strip_size + t * kLanes, to + t, p.row_pitch - 1);
    }
    for (int j = 0; j < kLanes && strip * kLanes + j < p.height; ++j) {
      WriteRow(p, strip * kLanes + j, p.rows + j * p.row_pitch + kLanes);
    }
  }
}

bool SweepDistance(const DistancePlane& p, bool forward, int group, const DistanceGate& gate) {
  const bool cubic = p.spacing[0] == p.spacing[1] && p.spacing[1] == p.spacing[2];
  if (forward) {
    ReadGroup(p, group);
    return cubic ? SweepGroup<true, true>(p, group, gate) : SweepGroup<true, false>(p, group, gate);
  }
  const bool changed =
      cubic ? SweepGroup<false, true>(p, group, gate) : SweepGroup<false, false>(p, group, gate);
  WriteGroup(p, group);
  return changed;
}

// Between a plane of the grid and the skewed one.
void ReadPlane(const DistancePlane& p) {
  for (int g = 0; g * kTogether < p.strips; ++g) ReadGroup(p, g);
}
void WritePlane(const DistancePlane& p) {
  for (int g = 0; g * kTogether < p.strips; ++g) WriteGroup(p, g);
}

DistanceShape ShapeOf() { return {kLanes, kTogether, kLag, kChunk}; }

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
HWY_EXPORT(SweepDistance);
HWY_EXPORT(ReadPlane);
HWY_EXPORT(WritePlane);
HWY_EXPORT(ShapeOf);

namespace {
constexpr std::ptrdiff_t kAlign = 16;  // floats
}

DistanceStage::DistanceStage(int width, int height, const float spacing[3], bool mirrored,
                             int workers)
    : width_(width), height_(height), mirrored_(mirrored) {
  std::copy_n(spacing, 3, spacing_);
  const DistanceShape shape = HWY_DYNAMIC_DISPATCH(ShapeOf)();
  lanes_ = shape.lanes;
  strips_ = (height + lanes_ - 1) / lanes_;
  steps_ = (width + lanes_ - 1 + 3) / 4 * 4;
  groups_ = groups_of(height);
  // One plane's count of steps ends before the next plane's begins.
  span_ = steps_ + shape.lag * shape.together;
  forward_ = std::vector<WaitCount>(static_cast<std::size_t>(groups_));
  backward_ = std::vector<WaitCount>(static_cast<std::size_t>(groups_));
  const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(strips_) * steps_ * lanes_;
  row_pitch_ = steps_ + 2 * lanes_;
  rows_size_ = (lanes_ * row_pitch_ + kAlign - 1) / kAlign * kAlign;
  storage_.assign(static_cast<std::size_t>(2 * plane + workers * rows_size_ + 3 * kAlign),
                  kOutsideDistance);
  const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
  const auto lead = (kAlign - address / sizeof(float) % kAlign) % kAlign;
  planes_[0] = storage_.data() + lead;
  planes_[1] = planes_[0] + plane;
  rows_ = planes_[1] + plane;
}

int DistanceStage::groups_of(int height) {
  const DistanceShape shape = HWY_DYNAMIC_DISPATCH(ShapeOf)();
  const int rows = shape.lanes * shape.together;
  return (height + rows - 1) / rows;
}

DistancePlane DistanceStage::view(const Plane& plane, int k, int worker) const {
  DistancePlane p{plane.data,
                  plane.stride_x,
                  plane.stride_y,
                  width_,
                  height_,
                  {},
                  mirrored_,
                  strips_,
                  steps_,
                  row_pitch_,
                  planes_[k % 2],
                  planes_[(k + 1) % 2],
                  rows_ + worker * rows_size_};
  std::copy_n(spacing_, 3, p.spacing);
  return p;
}

void DistanceStage::begin_pass(const float* face) {
  next_ = 0;
  if (face) {
    // A face is read only, and ReadPlane writes to the skewed plane only.
    HWY_DYNAMIC_DISPATCH(ReadPlane)(view({const_cast<float*>(face), 1, width_}, 1, 0));
  } else {
    std::fill_n(planes_[1], static_cast<std::size_t>(strips_) * steps_ * lanes_, kOutsideDistance);
  }
  for (int g = 0; g < groups_; ++g) {
    forward_[static_cast<std::size_t>(g)].set(0);
    backward_[static_cast<std::size_t>(g)].set(0);
  }
}

void DistanceStage::end_pass(int planes, float* face) const {
  std::fill_n(face, static_cast<std::ptrdiff_t>(width_) * height_, 0.0f);
  HWY_DYNAMIC_DISPATCH(WritePlane)(view({face, 1, width_}, planes - 1, 0));
}

void DistanceStage::sweep_group(const Plane& plane, int k, bool forward, int group, int worker) {
  const auto g = static_cast<std::size_t>(group);
  std::vector<WaitCount>& counts = forward ? forward_ : backward_;
  DistanceGate gate{nullptr, &counts[g], k * span_};
  if (forward) {
    if (group > 0) gate.before = &counts[g - 1];
    backward_[g].wait_for(k * span_);  // the plane before
  } else {
    if (group + 1 < groups_) gate.before = &counts[g + 1];
    forward_[g].wait_for((k + 1) * span_);
  }
  if (HWY_DYNAMIC_DISPATCH(SweepDistance)(view(plane, k, worker), forward, group, gate)) {
    changed_.store(true, std::memory_order_relaxed);
  }
  counts[g].set((k + 1) * span_);
}

void DistanceStage::sweep(float* plane, std::ptrdiff_t stride_x, std::ptrdiff_t stride_y) {
  const Plane p{plane, stride_x, stride_y};
  for (int g = 0; g < groups_; ++g) sweep_group(p, next_, true, g, 0);
  for (int g = groups_; g-- > 0;) sweep_group(p, next_, false, g, 0);
  ++next_;
}

void DistanceStage::follow(const DistanceStage& ahead, int k, int group) const {
  ahead.backward_[static_cast<std::size_t>(group)].wait_for((k + 1) * ahead.span_);
}

DistanceStage::Count DistanceStage::count(int depth) const {
  const DistanceShape shape = HWY_DYNAMIC_DISPATCH(ShapeOf)();
  const std::int64_t group = steps_ + std::int64_t{shape.lag} * (shape.together - 1);
  const std::int64_t behind = shape.chunk + shape.lanes - 1 + shape.lag * (shape.together - 1);
  // Two stages, forward and backward through every group; the second stage runs a plane behind.
  return {4 * group * groups_ * depth, 2 * (group + behind * (groups_ - 1)) * (depth + 1)};
}

bool DistanceStage::take_changed() { return changed_.exchange(false, std::memory_order_relaxed); }

}  // namespace obscura
#endif  // HWY_ONCE
