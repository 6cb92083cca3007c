#include <limits>

#include "screen/hemisphere/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/hemisphere/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "view/taps_leaf.h"
// After taps_leaf.h.
#include "screen/hemisphere/hemisphere_leaf.h"
}  // namespace leaf

namespace {

namespace hn = hwy::HWY_NAMESPACE;
using hemisphere::Frame;
using hemisphere::Sums;
using interleaved::kChannels;
using Receiver = leaf::HemisphereReceiver;
using Vector = leaf::EyeDirection;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;
constexpr int kMaxLanes = HWY_MAX_BYTES / sizeof(float);
constexpr float kInf = std::numeric_limits<float>::infinity();

HWY_INLINE Receiver MakeReceiver(const Frame& f, int x, float ray_y, V z, const Vector& n) {
  const D d;
  const V u = hn::ConvertTo(d, hn::Iota(DI(), x));
  const V a = hn::Mul(hn::Add(u, hn::Set(d, 0.5f - f.center_u)), hn::Set(d, f.scale_x));
  return leaf::hemisphere_receiver(a, hn::Set(d, ray_y), z, n, f.orthographic);
}

// Whether the point at distance t along w lies behind what the depth image holds there.
HWY_INLINE M Behind(const Frame& f, const Receiver& r, const Vector& w, V cosine, V t, M valid) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), half = hn::Set(d, 0.5f);
  const leaf::Seen seen =
      leaf::image_of_point(r, w, t, hn::Set(d, 1 / f.scale_x), hn::Set(d, 1 / f.scale_y),
                           hn::Set(d, f.center_u), hn::Set(d, f.center_v), f.orthographic);
  const V uf = hn::Floor(seen.u), vf = hn::Floor(seen.v);
  // What lies behind the camera or outside the image is open.
  M inside = hn::And(hn::Ge(uf, zero), hn::Lt(uf, hn::Set(d, static_cast<float>(f.width))));
  inside = hn::And(inside,
                   hn::And(hn::Ge(vf, zero), hn::Lt(vf, hn::Set(d, static_cast<float>(f.height)))));
  inside = hn::And(hn::And(inside, hn::Gt(seen.z, zero)), valid);
  const VI ix = hn::ConvertTo(di, hn::IfThenElseZero(inside, uf));
  const VI iy =
      hn::Sub(hn::ConvertTo(di, hn::IfThenElseZero(inside, vf)), hn::Set(di, f.height / 2));
  // Indices count from the middle row: 65535 rows of 65536 floats just fit 32 bits.
  HWY_ALIGN std::int32_t index[kMaxLanes];
  hn::Store(hn::Add(hn::Mul(iy, hn::Set(di, static_cast<std::int32_t>(f.stride))), ix), di, index);
  const V depth = GatherLanes(d, f.depth + (f.height / 2) * f.stride, index);

  const V a = hn::Mul(hn::Sub(hn::Add(uf, half), hn::Set(d, f.center_u)), hn::Set(d, f.scale_x));
  const V b = hn::Mul(hn::Sub(hn::Set(d, f.center_v - 0.5f), vf), hn::Set(d, f.scale_y));
  V back = depth;
  if (f.matter == view::Matter::kThickness) {
    back = leaf::back_of_thickness(depth, hn::Set(d, f.thickness), a, b, f.orthographic);
  } else if (f.matter == view::Matter::kWithBack) {
    back = GatherLanes(d, f.back + (f.height / 2) * f.stride, index);
  }
  const M behind = leaf::is_behind(r, cosine, t, seen.z, a, b, depth, f.orthographic,
                                   f.matter != view::Matter::kSolid, back);
  return hn::And(behind, inside);
}

// The light from direction w, of the nearest vertex.
HWY_INLINE Vector Light(const Frame& f, const Vector& w) {
  const D d;
  const DI di;
  const V ax = hn::Abs(w.x), ay = hn::Abs(w.y), az = hn::Abs(w.z);
  const M is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), is_y = hn::Ge(ay, az);
  auto choose = [&](V on_x, V on_y, V on_z) HWY_ATTR {
    return hn::IfThenElse(is_x, on_x, hn::IfThenElse(is_y, on_y, on_z));
  };
  const V major = choose(w.x, w.y, w.z), half = hn::Set(d, 0.5f);
  const V scale = hn::Div(half, hn::Abs(major));
  const V cells = hn::Set(d, static_cast<float>(f.light_cells));
  auto nearest = [&](V component) HWY_ATTR {
    const V at = hn::MulAdd(hn::MulAdd(component, scale, half), cells, half);
    return hn::Floor(hn::Min(hn::Max(at, hn::Zero(d)), cells));
  };
  const V i = nearest(choose(w.y, w.z, w.x)), j = nearest(choose(w.z, w.x, w.y));
  const V negative = hn::IfThenElseZero(hn::Lt(major, hn::Zero(d)), hn::Set(d, 1.0f));
  const V face = hn::Add(choose(hn::Zero(d), hn::Set(d, 2.0f), hn::Set(d, 4.0f)), negative);
  const V side = hn::Set(d, static_cast<float>(f.light_cells + 1));
  HWY_ALIGN std::int32_t index[kMaxLanes];
  hn::Store(hn::ConvertTo(di, hn::MulAdd(hn::MulAdd(face, side, j), side, i)), di, index);
  return {GatherLanes(d, f.light[0], index), GatherLanes(d, f.light[1], index),
          GatherLanes(d, f.light[2], index)};
}

template <bool kUniform, bool kCosine, bool kLight>  // what is wanted beside visibility
void SumPixels(const Frame& f, int row, int width, const Sums& out) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const int y = f.top + row;
  const float ray_y = (f.center_v - (static_cast<float>(y) + 0.5f)) * f.scale_y;
  const std::ptrdiff_t row_at = y * f.stride + f.left;
  const int tile_y = row % f.interleave;
  const V stratum = hn::Set(d, 1.0f / static_cast<float>(f.samples));
  const V step = hn::Set(d, 1.0f / static_cast<float>(f.tests));
  const V radius = hn::Set(d, f.radius);
  const V inverse_radius = hn::Set(d, 1 / f.radius);
  for (int x = 0; x < width; x += lanes) {
    const V z = hn::LoadU(d, f.depth + row_at + x);
    const M valid = hn::And(hn::Lt(z, hn::Set(d, kInf)), hn::Gt(z, zero));
    const Vector n{hn::LoadU(d, f.normal[0] + row_at + x), hn::LoadU(d, f.normal[1] + row_at + x),
                   hn::LoadU(d, f.normal[2] + row_at + x)};
    const Receiver r = MakeReceiver(f, f.left + x, ray_y, hn::IfThenElse(valid, z, one), n);
    const int tile_x = x % f.interleave;
    auto tile = [&](int value) HWY_ATTR { return hn::LoadU(d, f.tile[value][tile_y] + tile_x); };
    const V tile_cos = tile(hemisphere::kTileCos), tile_sin = tile(hemisphere::kTileSin);
    const V shift = tile(hemisphere::kTileShift), tile_offset = tile(hemisphere::kTileOffset);

    V open = zero, open_cosine = zero;
    Vector sum{zero, zero, zero}, sum_cosine{zero, zero, zero}, light{zero, zero, zero};
    for (int i = 0; i < f.samples; ++i) {
      // The golden angle in azimuth.
      const V cosine = leaf::stratum_cosine(hn::Set(d, static_cast<float>(i)), shift, stratum);
      const V sine = leaf::sine_of(cosine);
      const V c = hn::Set(d, f.cosine[i]), s = hn::Set(d, f.sine[i]);
      const V lx = hn::Mul(sine, hn::MulSub(c, tile_cos, hn::Mul(s, tile_sin)));
      const V ly = hn::Mul(sine, hn::MulAdd(s, tile_cos, hn::Mul(c, tile_sin)));
      const Vector w = leaf::in_eye_space(r, lx, ly, cosine);
      V offset = hn::Add(hn::Set(d, f.offset[i]), tile_offset);
      offset = hn::Sub(offset, hn::Floor(offset));

      V visible = one;
      M free = valid;
      for (int k = 0; k < f.tests; ++k) {
        const V t = leaf::test_distance(hn::Set(d, static_cast<float>(k)), offset, step, radius);
        const M behind = Behind(f, r, w, cosine, t, free);
        const V rest = leaf::visible_beyond(t, inverse_radius, f.quadratic);
        visible = hn::IfThenElse(behind, rest, visible);
        free = hn::AndNot(behind, free);
      }
      const V weighted = hn::Mul(visible, cosine);
      open = hn::Add(open, visible);
      open_cosine = hn::Add(open_cosine, weighted);
      if constexpr (kUniform) {
        sum = {hn::MulAdd(visible, w.x, sum.x), hn::MulAdd(visible, w.y, sum.y),
               hn::MulAdd(visible, w.z, sum.z)};
      }
      if constexpr (kLight) {
        const Vector l = Light(f, w);
        light = {hn::MulAdd(weighted, l.x, light.x), hn::MulAdd(weighted, l.y, light.y),
                 hn::MulAdd(weighted, l.z, light.z)};
      }
      if constexpr (kCosine) {
        sum_cosine = {hn::MulAdd(weighted, w.x, sum_cosine.x),
                      hn::MulAdd(weighted, w.y, sum_cosine.y),
                      hn::MulAdd(weighted, w.z, sum_cosine.z)};
      }
    }
    auto store = [&](float* const to[kChannels], V whole, const Vector& v, V by,
                     int means) HWY_ATTR {
      const V mean = hn::Mul(whole, by);
      if (to[0]) hn::StoreU(mean, d, to[0] + x);
      if (!to[1]) return;
      const V a = hn::Mul(mean, tile(means)), b = hn::Mul(mean, tile(means + 1));
      const V c = hn::Mul(mean, tile(means + 2));
      auto rest = [&](V total, V along_t, V along_b, V along_n) HWY_ATTR {
        return hn::NegMulAdd(
            a, along_t, hn::NegMulAdd(b, along_b, hn::NegMulAdd(c, along_n, hn::Mul(total, by))));
      };
      hn::StoreU(rest(v.x, r.t.x, r.b.x, n.x), d, to[1] + x);
      hn::StoreU(rest(v.y, r.t.y, r.b.y, n.y), d, to[2] + x);
      hn::StoreU(rest(v.z, r.t.z, r.b.z, n.z), d, to[3] + x);
    };
    if constexpr (kLight) {
      const V by = hn::Div(one, tile(hemisphere::kTileCosineSum));
      hn::StoreU(hn::Mul(light.x, by), d, out.radiance[0] + x);
      hn::StoreU(hn::Mul(light.y, by), d, out.radiance[1] + x);
      hn::StoreU(hn::Mul(light.z, by), d, out.radiance[2] + x);
    }
    store(out.uniform, open, sum, stratum, hemisphere::kTileMean);
    store(out.cosine, open_cosine, sum_cosine, hn::Div(one, tile(hemisphere::kTileCosineSum)),
          hemisphere::kTileCosineMean);
  }
}

void SumRow(const Frame& f, int row, int width, const Sums& sums) {
  if (sums.radiance[0]) return SumPixels<false, false, true>(f, row, width, sums);
  if (sums.cosine[1]) return SumPixels<false, true, false>(f, row, width, sums);
  sums.uniform[1] ? SumPixels<true, false, false>(f, row, width, sums)
                  : SumPixels<false, false, false>(f, row, width, sums);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
namespace {
HWY_EXPORT(SumRow);
}  // namespace

namespace hemisphere {

void sum_row(const Frame& frame, int row, int width, const Sums& sums) {
  HWY_DYNAMIC_DISPATCH(SumRow)(frame, row, width, sums);
}

}  // namespace hemisphere
}  // namespace obscura
#endif
