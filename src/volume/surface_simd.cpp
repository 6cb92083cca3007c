#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "volume/surface_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/surface_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr int kMaxLanes = HWY_MAX_BYTES / sizeof(float);
static_assert(kSurfaceRayGroup % kMaxLanes == 0 || kMaxLanes > kSurfaceRayGroup);

constexpr float kMaxValue = 1e18f;      // as where the distances start
constexpr float kDistanceTrust = 0.9f;  // swept distances are too long by some per cent
constexpr float kLeastStep = 0.4f;      // voxels
constexpr int kRefinements = 6;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Point {
  V x, y, z;
};

// What a packet of rays reads, with everything that does not depend on the ray made once.
template <class T>
class Tracer {
 public:
  explicit Tracer(const SurfaceGrid& g) : g_(g) {
    float diagonal2 = 0;
    least_step_ = g.spacing[0];
    for (int a = 0; a < 3; ++a) {
      diagonal2 += g.spacing[a] * g.spacing[a];
      least_step_ = std::min(least_step_, g.spacing[a]);
      last_[a] = static_cast<float>(g.size[a] - 1);
      most_[a] = static_cast<float>(std::max(0, g.size[a] - 2));
      step_[a] = g.size[a] > 1 ? g.stride[a] : 0;
    }
    least_step_ *= kLeastStep;
    half_diagonal_ = 0.5f * std::sqrt(diagonal2);
  }

  void packet(const SurfaceRays& rays, int at) const {
    const D d;
    const Point o = load(rays.origin, at), w = load(rays.direction, at);
    V t, end;
    enter(o, w, &t, &end);
    const V start = t;
    V before = t;
    M active = hn::Le(t, end);
    M hit = hn::FirstN(d, 0);
    const V least = hn::Set(d, least_step_), half = hn::Set(d, half_diagonal_);
    while (!hn::AllFalse(d, active)) {
      const Point p = along(o, w, t);
      const V distance = nearest_distance(p, active);
      // A cell that the surface crosses has no corner farther from it than its diagonal.
      const M near = hn::And(active, hn::Lt(distance, hn::Set(d, 2.1f * half_diagonal_)));
      if (!hn::AllFalse(d, near)) {
        const M inside = hn::And(near, hn::Ge(field(p, near), hn::Zero(d)));
        hit = hn::Or(hit, inside);
        active = hn::AndNot(inside, active);
      }
      const V step = hn::Max(least, hn::Sub(hn::Mul(distance, hn::Set(d, kDistanceTrust)), half));
      // The last point is on the border, where a ray ends.
      active = hn::AndNot(hn::Ge(t, end), active);
      before = hn::IfThenElse(active, t, before);
      t = hn::IfThenElse(active, hn::Min(hn::Add(t, step), end), t);
    }
    const M inside_at_start = hn::And(hit, hn::Eq(t, start));
    V result = t;
    Point normal{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    if (!hn::AllFalse(d, hit)) {
      result = refine(o, w, before, t, hit);
      normal = normal_at(along(o, w, result), w, hit);
    }
    hn::StoreU(hn::IfThenElse(hit, result, hn::Set(d, kInfinity)), d, rays.hit + at);
    hn::StoreU(normal.x, d, rays.normal[0] + at);
    hn::StoreU(normal.y, d, rays.normal[1] + at);
    hn::StoreU(normal.z, d, rays.normal[2] + at);
    hn::StoreU(hn::IfThenElseZero(inside_at_start, hn::Set(d, 1.0f)), d, rays.began_inside + at);
  }

 private:
  static HWY_INLINE Point load(float* const* from, int at) {
    const D d;
    return {hn::LoadU(d, from[0] + at), hn::LoadU(d, from[1] + at), hn::LoadU(d, from[2] + at)};
  }
  static HWY_INLINE Point along(const Point& o, const Point& w, V t) {
    return {hn::MulAdd(t, w.x, o.x), hn::MulAdd(t, w.y, o.y), hn::MulAdd(t, w.z, o.z)};
  }

  // Where the ray is between the outermost voxels' centres; an axis of one voxel is one thick.
  HWY_INLINE void enter(const Point& o, const Point& w, V* begin, V* end) const {
    const D d;
    *begin = hn::Zero(d);
    *end = hn::Set(d, std::numeric_limits<float>::max());
    const V origin[3] = {o.x, o.y, o.z}, direction[3] = {w.x, w.y, w.z};
    for (int a = 0; a < 3; ++a) {
      const float margin = g_.size[a] == 1 ? 0.5f : 0.0f;
      const V tiny = hn::Set(d, 1e-20f);
      const V safe = hn::IfThenElse(hn::Lt(hn::Abs(direction[a]), tiny),
                                    hn::CopySign(tiny, direction[a]), direction[a]);
      const V low = hn::Div(hn::Sub(hn::Set(d, -margin), origin[a]), safe);
      const V high = hn::Div(hn::Sub(hn::Set(d, last_[a] + margin), origin[a]), safe);
      *begin = hn::Max(*begin, hn::Min(low, high));
      *end = hn::Min(*end, hn::Max(low, high));
    }
  }

  HWY_INLINE V clamped(V v, int axis) const {
    const D d;
    return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, last_[axis]));
  }

  // Distance stored at the voxel beside each point.
  HWY_INLINE V nearest_distance(const Point& p, M active) const {
    const D d;
    const DI di;
    HWY_ALIGN std::int32_t i[3][kMaxLanes];
    HWY_ALIGN std::int32_t wanted[kMaxLanes];
    const V half = hn::Set(d, 0.5f);
    hn::Store(hn::ConvertTo(di, hn::Add(clamped(p.x, 0), half)), di, i[0]);
    hn::Store(hn::ConvertTo(di, hn::Add(clamped(p.y, 1), half)), di, i[1]);
    hn::Store(hn::ConvertTo(di, hn::Add(clamped(p.z, 2), half)), di, i[2]);
    hn::Store(hn::BitCast(di, hn::VecFromMask(d, active)), di, wanted);
    HWY_ALIGN float values[kMaxLanes];
    const std::ptrdiff_t* s = g_.distance_stride;
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      values[lane] = wanted[lane]
                         ? g_.distance[i[0][lane] * s[0] + i[1][lane] * s[1] + i[2][lane] * s[2]]
                         : 0.0f;
    }
    return hn::Load(d, values);
  }

  // The scalar field, trilinear, positive in matter.
  HWY_INLINE V field(const Point& p, M active) const {
    const D d;
    const DI di;
    HWY_ALIGN std::int32_t i[3][kMaxLanes];
    HWY_ALIGN std::int32_t wanted[kMaxLanes];
    const V at[3] = {clamped(p.x, 0), clamped(p.y, 1), clamped(p.z, 2)};
    V fraction[3];
    for (int a = 0; a < 3; ++a) {
      const auto index = hn::ConvertTo(di, hn::Min(at[a], hn::Set(d, most_[a])));
      fraction[a] = hn::Sub(at[a], hn::ConvertTo(d, index));
      hn::Store(index, di, i[a]);
    }
    hn::Store(hn::BitCast(di, hn::VecFromMask(d, active)), di, wanted);
    HWY_ALIGN float corners[8][kMaxLanes];
    const T* samples = static_cast<const T*>(g_.samples);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      if (!wanted[lane]) {
        for (auto& corner : corners) corner[lane] = 0;
        continue;
      }
      const T* q = samples + i[0][lane] * g_.stride[0] + i[1][lane] * g_.stride[1] +
                   i[2][lane] * g_.stride[2];
      const T* r = q + step_[2];
      corners[0][lane] = static_cast<float>(q[0]);
      corners[1][lane] = static_cast<float>(q[step_[0]]);
      corners[2][lane] = static_cast<float>(q[step_[1]]);
      corners[3][lane] = static_cast<float>(q[step_[0] + step_[1]]);
      corners[4][lane] = static_cast<float>(r[0]);
      corners[5][lane] = static_cast<float>(r[step_[0]]);
      corners[6][lane] = static_cast<float>(r[step_[1]]);
      corners[7][lane] = static_cast<float>(r[step_[0] + step_[1]]);
    }
    V v[8];
    const V scale = hn::Set(d, g_.scale), offset = hn::Set(d, g_.offset);
    for (int k = 0; k < 8; ++k) {
      const V value = hn::Add(hn::Mul(hn::Load(d, corners[k]), scale), offset);
      // NaN is open.
      const V limited = hn::IfThenElse(hn::Eq(value, value), value, hn::Set(d, -kMaxValue));
      v[k] = hn::Min(hn::Max(limited, hn::Set(d, -kMaxValue)), hn::Set(d, kMaxValue));
    }
    for (int k = 0; k < 4; ++k) v[k] = mix(v[2 * k], v[2 * k + 1], fraction[0]);
    for (int k = 0; k < 2; ++k) v[k] = mix(v[2 * k], v[2 * k + 1], fraction[1]);
    return mix(v[0], v[1], fraction[2]);
  }
  static HWY_INLINE V mix(V a, V b, V t) { return hn::Add(a, hn::Mul(t, hn::Sub(b, a))); }

  // The zero between `low`, in the open, and `high`, in matter: false position, where an end that
  // stays twice has its value halved (Illinois), so that both ends close in.
  HWY_INLINE V refine(const Point& o, const Point& w, V low, V high, M hit) const {
    const D d;
    V f_low = field(along(o, w, low), hit), f_high = field(along(o, w, high), hit);
    const V half = hn::Set(d, 0.5f);
    for (int i = 0; i < kRefinements; ++i) {
      const V span = hn::Sub(f_high, f_low);
      const V share =
          hn::IfThenElse(hn::Gt(span, hn::Zero(d)), hn::Div(hn::Neg(f_low), span), hn::Zero(d));
      const V limited = hn::Min(hn::Max(share, hn::Set(d, 0.02f)), hn::Set(d, 0.98f));
      const V t = mix(low, high, limited);
      const V f = field(along(o, w, t), hit);
      const M matter = hn::Ge(f, hn::Zero(d));
      high = hn::IfThenElse(matter, t, high);
      f_low = hn::IfThenElse(matter, hn::Mul(half, f_low), f_low);
      f_high = hn::IfThenElse(matter, f, hn::Mul(half, f_high));
      low = hn::IfThenElse(matter, low, t);
      f_low = hn::IfThenElse(matter, f_low, f);
    }
    return high;
  }

  // Minus the gradient by differences over `reach` voxels to either side, not normalised.
  HWY_INLINE Point downhill(const Point& p, float reach, M hit) const {
    const D d;
    V slope[3];
    for (int a = 0; a < 3; ++a) {
      Point low = p, high = p;
      V* from[3] = {&low.x, &low.y, &low.z};
      V* to[3] = {&high.x, &high.y, &high.z};
      *from[a] = clamped(hn::Sub(*from[a], hn::Set(d, reach)), a);
      *to[a] = clamped(hn::Add(*to[a], hn::Set(d, reach)), a);
      const V length = hn::Mul(hn::Sub(*to[a], *from[a]), hn::Set(d, g_.spacing[a]));
      const V difference = hn::Sub(field(low, hit), field(high, hit));
      slope[a] = hn::IfThenElseZero(hn::Gt(length, hn::Zero(d)), hn::Div(difference, length));
    }
    return {slope[0], slope[1], slope[2]};
  }

  static HWY_INLINE Point unit(Point n, M* good) {
    const D d;
    const V largest = hn::Max(hn::Max(hn::Abs(n.x), hn::Abs(n.y)), hn::Abs(n.z));
    *good = hn::And(hn::Gt(largest, hn::Zero(d)), hn::Lt(largest, hn::Set(d, kInfinity)));
    const V safe = hn::IfThenElse(*good, largest, hn::Set(d, 1.0f));
    n = {hn::Div(n.x, safe), hn::Div(n.y, safe), hn::Div(n.z, safe)};
    const V length =
        hn::Sqrt(hn::Add(hn::Add(hn::Mul(n.x, n.x), hn::Mul(n.y, n.y)), hn::Mul(n.z, n.z)));
    const V divisor = hn::IfThenElse(*good, length, hn::Set(d, 1.0f));
    return {hn::Div(n.x, divisor), hn::Div(n.y, divisor), hn::Div(n.z, divisor)};
  }
  static HWY_INLINE Point select(M m, const Point& a, const Point& b) {
    return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y), hn::IfThenElse(m, a.z, b.z)};
  }

  // Central differences over a voxel are smooth from cell to cell. In thinner sheets they can point
  // away from a ray that came from open space; then the gradient within the cell is used.
  HWY_INLINE Point normal_at(const Point& p, const Point& w, M hit) const {
    const D d;
    const Point direction{hn::Mul(w.x, hn::Set(d, g_.spacing[0])),
                          hn::Mul(w.y, hn::Set(d, g_.spacing[1])),
                          hn::Mul(w.z, hn::Set(d, g_.spacing[2]))};
    auto facing = [&](const Point& n, M good) HWY_ATTR {
      const V dot = hn::Add(hn::Add(hn::Mul(n.x, direction.x), hn::Mul(n.y, direction.y)),
                            hn::Mul(n.z, direction.z));
      return hn::And(good, hn::Lt(dot, hn::Zero(d)));
    };
    M good;
    Point n = unit(downhill(p, 1.0f, hit), &good);
    M bad = hn::AndNot(facing(n, good), hit);
    if (hn::AllFalse(d, bad)) return n;
    const Point own = unit(downhill(p, 0.1f, bad), &good);
    const M better = hn::And(bad, facing(own, good));
    n = select(better, own, n);
    bad = hn::AndNot(better, bad);
    return select(bad, {hn::Neg(direction.x), hn::Neg(direction.y), hn::Neg(direction.z)}, n);
  }

  const SurfaceGrid& g_;
  float last_[3], most_[3];
  std::ptrdiff_t step_[3];
  float least_step_, half_diagonal_;
};

template <class T>
void TraceTyped(const SurfaceGrid& grid, const SurfaceRays& rays) {
  const Tracer<T> tracer(grid);
  const int lanes = static_cast<int>(hn::Lanes(D()));
  for (int at = 0; at < rays.count; at += lanes) tracer.packet(rays, at);
}

void Trace(const SurfaceGrid& grid, const SurfaceRays& rays) {
  switch (grid.type) {
    case VoxelType::kU8:
      return TraceTyped<std::uint8_t>(grid, rays);
    case VoxelType::kI16:
      return TraceTyped<std::int16_t>(grid, rays);
    case VoxelType::kU16:
      return TraceTyped<std::uint16_t>(grid, rays);
    case VoxelType::kF32:
      return TraceTyped<float>(grid, rays);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(Trace);

void trace_surface(const SurfaceGrid& grid, const SurfaceRays& rays) {
  HWY_DYNAMIC_DISPATCH(Trace)(grid, rays);
}

}  // namespace obscura
#endif
