#include "screen/reference/rays.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/reference/rays_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "math/falloff-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// [0, 1) from the upper bits.
HWY_INLINE V Unit(VU bits) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V whole = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(bits)));
  return hn::Mul(whole, hn::Set(d, 0x1p-24f));
}

HWY_INLINE VU ReverseBits(VU x) {
  const DU du;
  auto swap = [&](VU shifted_left, VU shifted_right, std::uint32_t mask) HWY_ATTR {
    const VU m = hn::Set(du, mask);
    return hn::Or(hn::AndNot(m, shifted_left), hn::And(m, shifted_right));
  };
  x = swap(hn::ShiftLeft<1>(x), hn::ShiftRight<1>(x), 0x55555555);
  x = swap(hn::ShiftLeft<2>(x), hn::ShiftRight<2>(x), 0x33333333);
  x = swap(hn::ShiftLeft<4>(x), hn::ShiftRight<4>(x), 0x0f0f0f0f);
  x = swap(hn::ShiftLeft<8>(x), hn::ShiftRight<8>(x), 0x00ff00ff);
  return hn::Or(hn::ShiftLeft<16>(x), hn::ShiftRight<16>(x));
}

// An Owen scrambling of the bit-reversed argument: each bit is flipped by a hash of the bits below
// it (Laine and Karras 2011, with Vegdahl's constants).
HWY_INLINE VU Scramble(VU x, std::uint32_t seed) {
  const DU du;
  x = hn::Xor(x, hn::Mul(x, hn::Set(du, 0x3d20adeau)));
  x = hn::Add(x, hn::Set(du, seed));
  x = hn::Mul(x, hn::Set(du, (seed >> 16) | 1));
  x = hn::Xor(x, hn::Mul(x, hn::Set(du, 0x05526c56u)));
  return hn::Xor(x, hn::Mul(x, hn::Set(du, 0x53a22864u)));
}

// MurmurHash3's finaliser.
HWY_INLINE VU Hash(VU x) {
  const DU du;
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<16>(x)), hn::Set(du, 0x85ebca6bu));
  x = hn::Mul(hn::Xor(x, hn::ShiftRight<13>(x)), hn::Set(du, 0xc2b2ae35u));
  return hn::Xor(x, hn::ShiftRight<16>(x));
}

// Unit directions in the receiver's frame: z along the normal.
struct Directions {
  V x, y, z;
};

// Points of a Hammersley net, (i / size, radical inverse of i), the first coordinate jittered, the
// second scrambled. Neighbours in i are neighbours in azimuth, which keeps the rays of a batch in
// the same part of the image.
HWY_INLINE Directions NetDirections(const RaySet& set, VU i) {
  const D d;
  const DU du;
  const hn::RebindToSigned<D> di;
  const V one = hn::Set(d, 1.0f);
  const V jitter = Unit(Hash(hn::Xor(hn::Mul(i, hn::Set(du, 0x9e3779b9u)),
                                     hn::Set(du, set.seed * 0x2c1b3c6du + 0x297a2d39u))));
  const V index = hn::ConvertTo(d, hn::BitCast(di, i));
  const V azimuth =
      hn::Mul(hn::Add(index, jitter), hn::Set(d, 6.28318530718f / static_cast<float>(set.size)));
  const V v = hn::Add(Unit(ReverseBits(Scramble(i, set.seed))), hn::Set(d, 0x1p-25f));
  const V rest = hn::Sub(one, v);
  // Cosine: sin^2 is uniform. Uniform: cos is.
  const V cosine = set.uniform ? rest : hn::Sqrt(rest);
  const V sine = hn::Sqrt(set.uniform ? hn::Mul(v, hn::Add(one, rest)) : v);
  return {hn::Mul(sine, hn::Cos(d, azimuth)), hn::Mul(sine, hn::Sin(d, azimuth)), cosine};
}

void AddRays(const TraceScene& scene, const Receiver& r, const RaySet& set, RayBatch* batch) {
  const D d;
  const DU du;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), inf = hn::Set(d, kInfinity);
  const V per_x = hn::Set(d, 1 / scene.scale_x), per_y = hn::Set(d, -1 / scene.scale_y);
  const V depth = hn::Set(d, r.depth);
  const V perspective = hn::Set(d, scene.orthographic ? 0.0f : 1.0f);
  const V tiny = hn::Set(d, 1e-20f);
  for (int done = 0; done < set.count; done += static_cast<int>(hn::Lanes(d))) {
    const Directions local =
        NetDirections(set, hn::Iota(du, static_cast<std::uint32_t>(set.first + done)));
    auto world = [&](int axis) HWY_ATTR {
      return hn::MulAdd(hn::Set(d, r.tangent[axis]), local.x,
                        hn::MulAdd(hn::Set(d, r.bitangent[axis]), local.y,
                                   hn::Mul(hn::Set(d, r.normal[axis]), local.z)));
    };
    const V wx = world(0), wy = world(1), wz = world(2);
    // The derivative of (x, y, height) by s, where s depth / (1 + s bend) is the distance: from
    // p + t w over the depth of p + t w.
    V gx = hn::Mul(per_x, hn::MulAdd(hn::Set(d, r.ray_x), wz, wx));
    V gy = hn::Mul(per_y, hn::MulAdd(hn::Set(d, r.ray_y), wz, wy));
    gx = hn::IfThenElse(hn::Lt(hn::Abs(gx), tiny), tiny, gx);
    gy = hn::IfThenElse(hn::Lt(hn::Abs(gy), tiny), tiny, gy);
    const V gh = hn::Div(wz, depth);
    const V bend = hn::Mul(perspective, wz);

    // Leaving the image; vanishing at height 0, infinitely far away; passing above everything.
    auto border = [&](float at, int cells, V g) HWY_ATTR {
      const V near = hn::Set(d, -at), far = hn::Set(d, static_cast<float>(cells) - at);
      return hn::Div(hn::IfThenElse(hn::Gt(g, zero), far, near), g);
    };
    const V leave =
        hn::Max(zero, hn::Min(border(r.x, scene.cells_x, gx), border(r.y, scene.cells_y, gy)));
    const V vanish = hn::IfThenElse(hn::Lt(bend, zero), hn::Div(one, hn::Neg(bend)), inf);
    const V above = hn::Div(hn::Set(d, scene.max_height - r.reference - r.height), gh);
    V end = hn::Min(leave, vanish);
    const V leave_distance = hn::Div(hn::Mul(leave, depth), hn::MulAdd(leave, bend, one));
    const V miss = hn::IfThenElse(hn::Lt(leave, vanish),
                                  hn::Add(leave_distance, hn::Set(d, scene.beyond_border)), inf);
    end = hn::IfThenElse(hn::Gt(gh, zero), hn::Min(end, hn::Max(above, zero)), end);
    // The s of the distance at which rho ends: t / (depth - t bend), never if that is negative.
    const V t = hn::Set(d, scene.max_distance);
    const V divisor = hn::NegMulAdd(t, bend, depth);
    const V cut = hn::Div(t, divisor);
    end = hn::IfThenElse(hn::And(hn::Gt(divisor, zero), hn::Lt(t, inf)), hn::Min(end, cut), end);

    // The batch's arrays are whole vectors long beyond `count`, and later rays overwrite the rest.
    const int at = batch->count + done;
    auto store = [&](V v, float* to) HWY_ATTR {
      if (at + static_cast<int>(hn::Lanes(d)) <= RayBatch::kCapacity) {
        hn::StoreU(v, d, to + at);
      } else {
        HWY_ALIGN float last[HWY_MAX_BYTES / sizeof(float)];
        hn::Store(v, d, last);
        std::copy_n(last, RayBatch::kCapacity - at, to + at);
      }
    };
    store(wx, batch->wx);
    store(wy, batch->wy);
    store(wz, batch->wz);
    store(depth, batch->depth);
    store(bend, batch->bend);
    store(hn::Set(d, r.x), batch->x);
    store(hn::Set(d, r.y), batch->y);
    store(hn::Set(d, r.height), batch->h);
    store(hn::Set(d, r.reference), batch->reference);
    store(gx, batch->gx);
    store(gy, batch->gy);
    store(gh, batch->gh);
    store(end, batch->end);
    store(miss, batch->distance);
  }
  batch->count += set.count;
}

void FinishRays(RayBatch* batch) {
  const D d;
  const V one = hn::Set(d, 1.0f), inf = hn::Set(d, kInfinity);
  for (int i = 0; i < batch->count; i += static_cast<int>(hn::Lanes(d))) {
    const V s = hn::Load(d, batch->hit + i);
    // At the vanishing point rounding can take the divisor past 0.
    const V divisor = hn::Max(hn::MulAdd(s, hn::Load(d, batch->bend + i), one), hn::Zero(d));
    const V t = hn::Div(hn::Mul(s, hn::Load(d, batch->depth + i)), divisor);
    const V missed = hn::Load(d, batch->distance + i);
    hn::Store(hn::IfThenElse(hn::Lt(s, inf), t, missed), d, batch->distance + i);
  }
}

template <FalloffKind kKind>
RaySums Sum(const math::Rho& rho, const RayBatch& batch, int begin, int end) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const V longest = hn::Set(d, std::numeric_limits<float>::max());
  V open = zero, x = zero, y = zero, z = zero;
  for (int i = begin / lanes * lanes; i < end; i += lanes) {
    // Without what the first and last vector hold beside the range.
    const V index = hn::Iota(d, static_cast<float>(i));
    const auto inside = hn::And(hn::Ge(index, hn::Set(d, static_cast<float>(begin))),
                                hn::Lt(index, hn::Set(d, static_cast<float>(end))));
    const V distance = hn::IfThenElseZero(inside, hn::Load(d, batch.distance + i));
    const V weight = EvaluateRho<kKind>(rho, hn::Min(distance, longest));
    const V all = hn::Sub(one, hn::IfThenElseZero(hn::Le(distance, longest), weight));
    const V v = hn::IfThenElseZero(inside, all);
    open = hn::Add(open, v);
    x = hn::IfThenElse(inside, hn::MulAdd(v, hn::Load(d, batch.wx + i), x), x);
    y = hn::IfThenElse(inside, hn::MulAdd(v, hn::Load(d, batch.wy + i), y), y);
    z = hn::IfThenElse(inside, hn::MulAdd(v, hn::Load(d, batch.wz + i), z), z);
  }
  auto total = [&](V v) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, v)); };
  return {total(open), total(x), total(y), total(z)};
}

RaySums SumRays(const math::Rho& rho, const RayBatch& batch, int begin, int end) {
  return math::with_falloff_kind(
      rho.kind, [&]<FalloffKind kKind>() { return Sum<kKind>(rho, batch, begin, end); });
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(AddRays);
HWY_EXPORT(FinishRays);
HWY_EXPORT(SumRays);

void add_rays(const TraceScene& scene, const Receiver& receiver, const RaySet& set,
              RayBatch* batch) {
  HWY_DYNAMIC_DISPATCH(AddRays)(scene, receiver, set, batch);
}
void finish_rays(RayBatch* batch) { HWY_DYNAMIC_DISPATCH(FinishRays)(batch); }
RaySums sum_rays(const math::Rho& rho, const RayBatch& batch, int begin, int end) {
  return HWY_DYNAMIC_DISPATCH(SumRays)(rho, batch, begin, end);
}

}  // namespace obscura
#endif
