// The obscurance of one azimuthal slice, piece by piece (far-field ambient obscurance, equations 2
// and 3), over Highway lanes; included once per SIMD target.
//
// The slice is the half-plane of the receiver (the origin), its zenith (towards the camera) and a
// tangent: a point is (x, y), x >= 0 along the tangent, y along the zenith. theta is measured from
// the zenith, so the direction theta is (sin theta, cos theta). Points come from the receiver
// outwards; one is visible when its theta is smaller than every earlier one's. It then fills the
// directions from its own theta up to the smallest before it.
#if defined(OBSCURA_SRC_MATH_SLAB_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_SLAB_INL_H_
#undef OBSCURA_SRC_MATH_SLAB_INL_H_
#else
#define OBSCURA_SRC_MATH_SLAB_INL_H_
#endif

#include "hwy/highway.h"
#include "math/falloff-inl.h"
#include "math/fast-inl.h"
#include "math/leaf-inl.h"
#include "math/slice_sums.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// What a slice is before any point is seen.
template <class V>
struct Slice {
  V nz, nt;  // the normal along zenith and tangent; n.w = nz cos theta + nt sin theta
  V edge_sine, edge_cosine, edge_angle;  // where n.w = 0
  V edge_integral;                       // F(edge)
  V camera;                              // distance to the camera; 1 where view rays are parallel
  V perspective;                         // 1, or 0 where view rays are parallel
};

// Antiderivatives at theta of the summed directions, along the tangent and the zenith.
template <SliceSums kSums, class V>
HWY_INLINE void DirectionIntegral(V nz, V nt, V sine, V cosine, V angle, V& x, V& y) {
  if constexpr (kSums == SliceSums::kUniform) {
    x = leaf::uniform_along(sine, cosine, angle);
    y = leaf::uniform_zenith(sine);
  } else if constexpr (kSums == SliceSums::kCosine) {
    x = leaf::weighted_along(nz, nt, sine, cosine);
    y = leaf::weighted_zenith(nz, nt, sine, cosine);
  }
}

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE Slice<V> MakeSlice(D d, V nz, V nt, V camera, V perspective) {
  namespace hn = hwy::HWY_NAMESPACE;
  Slice<V> s;
  s.nz = nz;
  s.nt = nt;
  s.camera = camera;
  s.perspective = perspective;
  const V square = hn::Max(hn::MulAdd(nz, nz, hn::Mul(nt, nt)), hn::Set(d, 1e-30f));
  const V inverse = hn::Div(hn::Set(d, 1.0f), hn::Sqrt(square));
  s.edge_sine = hn::Mul(hn::Abs(nz), inverse);
  // -nt for a normal that faces the camera, nt for one that has turned away.
  s.edge_cosine = hn::Mul(hn::IfThenElse(hn::Lt(nz, hn::Zero(d)), nt, hn::Neg(nt)), inverse);
  s.edge_angle = leaf::fast_acos(s.edge_cosine);
  s.edge_integral = leaf::cosine_integral(nz, nt, s.edge_sine, s.edge_cosine, s.edge_angle);
  return s;
}

// The smallest theta so far, and what stands above it.
template <class D>
struct Horizon {
  using V = hwy::HWY_NAMESPACE::Vec<D>;
  using M = hwy::HWY_NAMESPACE::Mask<D>;
  V cosine;  // of the smallest theta, less kHorizonSlack; -2 before the first point
  V sine_c, cosine_c, angle_c;  // the same clipped to the hemisphere
  V integral;                   // F at the clipped theta
  V x, y;                       // the point before
  M chord;                      // the point before was visible
  V sum;                        // obscurance of the slice
  // Directions, see SliceSums.
  V integral_x, integral_y;   // at the clipped theta
  V sum_x, sum_y, sum_solid;  // along the tangent, the zenith; solid angle
};

template <SliceSums kSums = SliceSums::kVisibility, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE Horizon<D> StartHorizon(D d, const Slice<V>& s, bool from_receiver) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V zero = hn::Zero(d), pi = hn::Set(d, 3.14159265f);
  const auto away = hn::Lt(s.nz, zero);
  Horizon<D> h;
  h.cosine = hn::Set(d, -2.0f);
  h.sine_c = hn::IfThenElse(away, zero, s.edge_sine);
  h.cosine_c = hn::IfThenElse(away, hn::Set(d, -1.0f), s.edge_cosine);
  h.angle_c = hn::IfThenElse(away, pi, s.edge_angle);
  h.integral = hn::IfThenElse(away, hn::Mul(s.nt, hn::Set(d, 1.57079633f)), s.edge_integral);
  h.x = h.y = h.sum = h.sum_x = h.sum_y = h.sum_solid = zero;
  DirectionIntegral<kSums>(s.nz, s.nt, h.sine_c, h.cosine_c, h.angle_c, h.integral_x, h.integral_y);
  h.chord = from_receiver ? hn::Ge(zero, zero) : hn::Lt(zero, zero);
  return h;
}

template <FalloffKind kKind, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V RhoOf(D d, const math::Rho& rho, V distance) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (kKind == FalloffKind::kExponential) {
    return FastExpNegative(d, hn::Mul(distance, hn::Set(d, rho.inverse_radius)));
  } else {
    return EvaluateRho<kKind>(d, rho, distance);
  }
}

// Of the horizon's cosine.
inline constexpr float kLeastRise = 5e-4f;
// What lies this little below the horizon is visible: of a plane every point, whatever rounding
// does.
inline constexpr float kHorizonSlack = 1e-5f;
// Half the angle of pieces for which the middle alone is enough.
inline constexpr float kSmallPiece = 0.25f;

// Of an adaptive chord that rises by more than it goes outwards: an edge stands between its ends,
// most likely halfway, and matter hangs below it away from the camera. Where along the tangent it
// stands; elsewhere x.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE V EdgeBefore(D d, V x, V y, const Horizon<D>& h) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V outwards = hn::Sub(x, h.x), rise = hn::Sub(y, h.y);
  const auto edge =
      hn::And(h.chord, hn::And(hn::Gt(outwards, hn::Zero(d)), hn::Gt(rise, outwards)));
  return hn::IfThenElse(edge, hn::NegMulAdd(hn::Set(d, 0.5f), outwards, x), x);
}

// Adds the next point outwards. `share` is the part of the slice's width in which the point stands,
// 1 unless kPartial: the rest stays open, and the horizon moves by that part only.
template <FalloffKind kKind, bool kChord, bool kPartial, SliceSums kSums = SliceSums::kVisibility,
          class D, class V = hwy::HWY_NAMESPACE::Vec<D>, class M = hwy::HWY_NAMESPACE::Mask<D>>
HWY_INLINE void AddPoint(D d, const math::Rho& rho, const Slice<V>& s, V x, V y, M valid, V share,
                         Horizon<D>& h) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0f), zero = hn::Zero(d), tiny = hn::Set(d, 1e-30f);
  const V square = hn::Max(hn::MulAdd(x, x, hn::Mul(y, y)), tiny);
  const V inverse = FastInverseSqrt(d, square);
  const V cosine = hn::Mul(y, inverse);
  const M visible = hn::And(valid, hn::Gt(cosine, h.cosine));
  // What hardly raises the horizon, as all of a plane does, is left to the next point that does;
  // but a share of the width must move it by that share.
  M raises = hn::Gt(cosine, hn::Add(h.cosine_c, hn::Set(d, kLeastRise)));
  if constexpr (kPartial) raises = hn::Or(raises, hn::Lt(share, one));
  const M moves = hn::And(visible, raises);
  const V slack = hn::Set(d, kHorizonSlack);
  if (hn::AllFalse(d, moves)) {
    h.cosine = hn::IfThenElse(visible, hn::Sub(cosine, slack), h.cosine);
    h.x = x;
    h.y = y;
    h.chord = visible;
    return;
  }
  const V c = hn::Min(cosine, one);
  const V sine = hn::Mul(x, inverse);
  const V angle = leaf::fast_acos(c);
  const M clipped = hn::Xor(hn::Lt(s.nz, zero), hn::Le(c, s.edge_cosine));
  V sine_c = hn::IfThenElse(clipped, s.edge_sine, sine);
  V cosine_c = hn::IfThenElse(clipped, s.edge_cosine, c);
  V angle_c = hn::IfThenElse(clipped, s.edge_angle, angle);
  V integral =
      hn::IfThenElse(clipped, s.edge_integral, leaf::cosine_integral(s.nz, s.nt, sine, c, angle));
  V integral_x, integral_y;
  DirectionIntegral<kSums>(s.nz, s.nt, sine_c, cosine_c, angle_c, integral_x, integral_y);
  const V weight = hn::IfThenElseZero(moves, hn::Max(hn::Sub(h.integral, integral), zero));
  if (!hn::AllFalse(d, hn::Gt(weight, zero))) {
    // rho averaged over the piece by three Gauss points, each with its share of the integral. The
    // distance to a line through the point along e is |p x e| / |w x e|.
    V px = x;
    if constexpr (kChord) px = EdgeBefore(d, x, y, h);
    V ex = hn::Mul(px, s.perspective), ey = hn::MulSub(y, s.perspective, s.camera);
    if constexpr (kChord) {
      const M chord = hn::And(h.chord, hn::Eq(px, x));
      ex = hn::IfThenElse(chord, hn::Sub(x, h.x), ex);
      ey = hn::IfThenElse(chord, hn::Sub(y, h.y), ey);
    }
    const V numerator = hn::Abs(hn::MulSub(px, ey, hn::Mul(y, ex)));
    V mx = hn::Add(h.sine_c, sine_c), my = hn::Add(h.cosine_c, cosine_c);
    const V m2 = hn::Max(hn::MulAdd(mx, mx, hn::Mul(my, my)), tiny);
    const V im = FastInverseSqrt(d, m2);
    mx = hn::Mul(mx, im);
    my = hn::Mul(my, im);
    auto node = [&](V wx, V wy, V gauss, V& weights, V& values) HWY_ATTR {
      const V denominator = hn::Max(hn::Abs(hn::MulSub(wx, ey, hn::Mul(wy, ex))), tiny);
      const V distance =
          hn::Min(hn::Mul(numerator, FastReciprocal(d, denominator)), hn::Set(d, 1e30f));
      const V lobe = hn::Mul(wx, hn::MulAdd(s.nz, wy, hn::Mul(s.nt, wx)));
      const V w = hn::Mul(hn::Max(lobe, hn::Set(d, 1e-12f)), gauss);
      weights = hn::Add(weights, w);
      values = hn::MulAdd(w, RhoOf<kKind>(d, rho, distance), values);
    };
    const V half_piece = hn::Mul(hn::Set(d, 0.5f), hn::Sub(h.angle_c, angle_c));
    V weights = zero, values = zero;
    node(mx, my, hn::Set(d, 8.0f / 9), weights, values);
    const M large = hn::Ge(half_piece, hn::Set(d, kSmallPiece));
    if (!hn::AllFalse(d, large)) {
      // Nothing in the other lanes, which the middle serves: no pixel depends on its neighbours.
      const V side = hn::IfThenElseZero(large, hn::Set(d, 5.0f / 9));
      V ds, dc;
      FastSinCos(d, hn::Mul(half_piece, hn::Set(d, 0.774596669f)), ds, dc);
      node(hn::MulAdd(mx, dc, hn::Mul(my, ds)), hn::NegMulAdd(mx, ds, hn::Mul(my, dc)), side,
           weights, values);
      node(hn::NegMulAdd(my, ds, hn::Mul(mx, dc)), hn::MulAdd(mx, ds, hn::Mul(my, dc)), side,
           weights, values);
    }
    V mean = hn::Mul(values, FastReciprocal(d, weights));
    if constexpr (kPartial) mean = hn::Mul(mean, share);
    const M counts = hn::Gt(weight, zero);
    auto add = [&](V& sum, V amount) HWY_ATTR {
      sum = hn::Add(sum, hn::IfThenElseZero(counts, hn::Mul(amount, mean)));
    };
    add(h.sum, weight);
    if constexpr (kSums != SliceSums::kVisibility) {
      add(h.sum_x, hn::Sub(h.integral_x, integral_x));
      add(h.sum_y, hn::Sub(h.integral_y, integral_y));
    }
    if constexpr (kSums == SliceSums::kUniform) add(h.sum_solid, hn::Sub(cosine_c, h.cosine_c));
  }
  V new_cosine = c;
  if constexpr (kPartial) {
    if (!hn::AllFalse(d, hn::And(visible, hn::Lt(share, one)))) {
      // The horizon of the slice as a whole: the mean angle of its covered and its open part.
      const V old_angle = leaf::fast_acos(hn::Max(hn::Add(h.cosine, slack), hn::Set(d, -1.0f)));
      const M part = hn::Lt(share, one);
      const V mean = hn::MulAdd(share, hn::Sub(angle, old_angle), old_angle);
      V half_sine, half_cosine;
      FastSinCos(d, hn::Mul(hn::Set(d, 0.5f), mean), half_sine, half_cosine);
      const V two = hn::Set(d, 2.0f);
      const V mean_cosine = hn::NegMulAdd(two, hn::Mul(half_sine, half_sine), one);
      const V mean_sine = hn::Mul(two, hn::Mul(half_sine, half_cosine));
      const M outside = hn::Xor(hn::Lt(s.nz, zero), hn::Le(mean_cosine, s.edge_cosine));
      const V mean_integral =
          hn::IfThenElse(outside, s.edge_integral,
                         leaf::cosine_integral(s.nz, s.nt, mean_sine, mean_cosine, mean));
      new_cosine = hn::IfThenElse(part, mean_cosine, c);
      sine_c = hn::IfThenElse(part, hn::IfThenElse(outside, s.edge_sine, mean_sine), sine_c);
      cosine_c =
          hn::IfThenElse(part, hn::IfThenElse(outside, s.edge_cosine, mean_cosine), cosine_c);
      angle_c = hn::IfThenElse(part, hn::IfThenElse(outside, s.edge_angle, mean), angle_c);
      integral = hn::IfThenElse(part, mean_integral, integral);
      DirectionIntegral<kSums>(s.nz, s.nt, sine_c, cosine_c, angle_c, integral_x, integral_y);
    }
  }
  if constexpr (kSums != SliceSums::kVisibility) {
    h.integral_x = hn::IfThenElse(moves, integral_x, h.integral_x);
    h.integral_y = hn::IfThenElse(moves, integral_y, h.integral_y);
  }
  h.cosine = hn::IfThenElse(visible, hn::Sub(new_cosine, slack), h.cosine);
  h.sine_c = hn::IfThenElse(moves, sine_c, h.sine_c);
  h.cosine_c = hn::IfThenElse(moves, cosine_c, h.cosine_c);
  h.angle_c = hn::IfThenElse(moves, angle_c, h.angle_c);
  h.integral = hn::IfThenElse(moves, integral, h.integral);
  h.x = x;
  h.y = y;
  h.chord = visible;
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
