#include <algorithm>
#include <cmath>
#include <numbers>

#include "screen/mipmap/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/mipmap/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "math/slice-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "math/apart_leaf.h"
// After apart_leaf.h.
#include "screen/mipmap/mipmap_leaf.h"
}  // namespace leaf

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;

HWY_INLINE V Fetch(const MipmapLevel& level, VI x, VI y) {
  const DI di;
  HWY_ALIGN std::int32_t index[HWY_MAX_BYTES / sizeof(float)];
  x = hn::Min(hn::Max(x, hn::Zero(di)), hn::Set(di, level.width - 1));
  y = hn::Min(hn::Max(y, hn::Zero(di)), hn::Set(di, level.height - 1));
  hn::Store(hn::Add(hn::Mul(y, hn::Set(di, static_cast<std::int32_t>(level.stride))), x), di,
            index);
  return GatherLanes(D(), level.depth, index);
}

// Depth of a level at pixel coordinates (u, v), 0 where any texel read is background.
HWY_INLINE V ReadLevel(const MipmapFrame& f, int i, V u, V v) {
  const D d;
  const DI di;
  const MipmapLevel& level = f.levels[i];
  const float scale = 1.0f / static_cast<float>(1 << i);
  const V half = hn::Set(d, f.interpolate ? -0.5f : 0.0f);
  const V x = hn::MulAdd(u, hn::Set(d, scale), half), y = hn::MulAdd(v, hn::Set(d, scale), half);
  const V fx = hn::Floor(x), fy = hn::Floor(y);
  const VI ix = hn::ConvertTo(di, fx), iy = hn::ConvertTo(di, fy), one = hn::Set(di, 1);
  const V a = Fetch(level, ix, iy);
  if (!f.interpolate) return a;
  const V b = Fetch(level, hn::Add(ix, one), iy), c = Fetch(level, ix, hn::Add(iy, one));
  const V e = Fetch(level, hn::Add(ix, one), hn::Add(iy, one));
  const V s = hn::Sub(x, fx), t = hn::Sub(y, fy);
  return leaf::between_depths(a, b, c, e, s, t);
}

template <FalloffKind kKind>
void MipmapRow(const MipmapFrame& f, int row, float* HWY_RESTRICT out) {
  const D d;
  const view::Geometry& g = *f.geometry;
  const Camera& c = g.camera;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  const int y = row + g.guard_band.top;
  const float v0 = static_cast<float>(y) + 0.5f;
  const V perspective = hn::Set(d, c.orthographic ? 0.0f : 1.0f);
  const float last_u = static_cast<float>(g.width) - 0.5f, last_v = g.height - 0.5f;
  constexpr float kPi = std::numbers::pi_v<float>;
  for (int x = 0; x < g.visible().width; x += static_cast<int>(hn::Lanes(d))) {
    const int at = x + g.guard_band.left;
    const V depth = hn::LoadU(d, g.depth.row(y) + at);
    const auto surface = hn::Lt(depth, hn::Inf(d));
    const V p = hn::IfThenElse(surface, depth, one);
    const V u0 = hn::Add(hn::Iota(d, static_cast<float>(at)), half);
    const V a =
        hn::Mul(perspective, hn::Mul(hn::Sub(u0, hn::Set(d, c.center_u)), hn::Set(d, c.scale_x)));
    const V b = hn::Mul(perspective, hn::Set(d, (v0 - c.center_v) * c.scale_y));
    const leaf::ViewRay ray = leaf::make_ray(a, b);
    const V camera = c.orthographic ? one : hn::Mul(p, ray.ray_length);
    const V nu = hn::LoadU(d, g.normal_x.row(y) + at);
    const V nv = hn::Neg(hn::LoadU(d, g.normal_y.row(y) + at));
    const V nw = hn::Neg(hn::LoadU(d, g.normal_z.row(y) + at));
    leaf::SliceIntegral<kKind, false, SliceSums::kVisibility> slices(*f.rho);
    const V limit = slices.depth_without_effect(p);
    V sum = zero;
    for (const MipmapDirection& direction : f.directions) {
      auto scaled_u = [&](float u) HWY_ATTR { return hn::Set(d, u * c.scale_x); };
      auto scaled_v = [&](float v) HWY_ATTR { return hn::Set(d, v * c.scale_y); };
      const float du = direction.u, dv = direction.v;
      const leaf::Azimuth azimuth = leaf::make_azimuth(ray, scaled_u(du), scaled_v(dv), nu, nv, nw);
      const leaf::Slice slice = leaf::make_slice(azimuth.nz, azimuth.nt, camera, perspective);
      leaf::Horizon h = slices.start_horizon(slice, true);
      // Distance to the image's last texel centres along the direction.
      V edge = hn::Set(d, 1e9f);
      if (du > 1e-6f) edge = hn::Mul(hn::Sub(hn::Set(d, last_u), u0), hn::Set(d, 1 / du));
      if (du < -1e-6f) edge = hn::Mul(hn::Sub(half, u0), hn::Set(d, 1 / du));
      const float reach = dv > 1e-6f ? (last_v - v0) / dv : dv < -1e-6f ? (0.5f - v0) / dv : 1e9f;
      edge = hn::Min(edge, hn::Set(d, reach));
      V before = zero;
      for (const MipmapStep& step : f.steps) {
        const V t = hn::Min(hn::Set(d, step.distance), edge);
        const auto fresh = hn::Gt(t, before);
        if (hn::AllFalse(d, fresh)) break;
        before = t;
        const V u = hn::MulAdd(t, hn::Set(d, du), u0);
        const V v = hn::MulAdd(t, hn::Set(d, dv), hn::Set(d, v0));
        const int level = step.level;
        V q = ReadLevel(f, level, u, v);
        if (f.interpolate && level + 1 < f.level_count) {
          q = leaf::between_levels(q, ReadLevel(f, level + 1, u, v), hn::Set(d, step.blend));
        }
        const auto found = hn::And(hn::Gt(q, zero), hn::Lt(q, limit));
        q = hn::IfThenElse(found, q, one);
        const leaf::PyramidPoint at = leaf::pyramid_point(t, q, p, ray.ray_length, azimuth.along,
                                                          azimuth.across, c.orthographic);
        slices.add_point(slice, at.x, at.y, hn::And(hn::And(found, fresh), surface), false, one, h);
      }
      const V w = leaf::azimuth_between(ray, scaled_u(direction.low_u), scaled_v(direction.low_v),
                                        scaled_u(direction.high_u), scaled_v(direction.high_v));
      sum = hn::MulAdd(w, h.sum, sum);
    }
    const V visibility = hn::NegMulAdd(sum, hn::Set(d, 1 / kPi), one);
    hn::StoreU(hn::Min(hn::Max(visibility, zero), one), d, out + x);
  }
}

void MipmapRowAny(const MipmapFrame& f, int row, float* out) {
  math::with_falloff_kind(f.rho->kind, [&]<FalloffKind kKind>() { MipmapRow<kKind>(f, row, out); });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(MipmapRowAny);

void mipmap_row(const MipmapFrame& frame, int row, float* out) {
  HWY_DYNAMIC_DISPATCH(MipmapRowAny)(frame, row, out);
}

}  // namespace obscura
#endif
