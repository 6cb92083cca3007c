// The obscurance of one azimuthal slice whose matter has an end, over Highway lanes; included once
// per SIMD target. The slice's hemisphere is cut into 32 sectors of equal cosine-weighted size, one
// bit each; points may come in any number of separate pieces, and light passes between and below
// them. Frame and symbols as in math/slab-inl.h.
#if defined(OBSCURA_SRC_MATH_MATTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_MATTER_INL_H_
#undef OBSCURA_SRC_MATH_MATTER_INL_H_
#else
#define OBSCURA_SRC_MATH_MATTER_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"
#include "math/slab-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// A clipped direction and its place on the scale of sectors, 0 to 32.
template <class V>
struct SectorEdge {
  V sine, cosine, angle, place;
};

template <class D>
struct Sectors {
  using V = hwy::HWY_NAMESPACE::Vec<D>;
  using M = hwy::HWY_NAMESPACE::Mask<D>;
  using VU = hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToUnsigned<D>>;
  VU covered;
  V first, span;        // F where the hemisphere begins, and over it
  V x, y, depth, back;  // the point before: its place, and where its matter begins and ends
  SectorEdge<V> last;   // its direction
  M joined;             // there is a point before
  V sum;
  V sum_x, sum_y, sum_solid;  // directions, see SliceSums
  SectorEdge<V> top;          // for them: nearest to the zenith so far
};

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE SectorEdge<V> FindSector(D d, const Slice<V>& s, const Sectors<D>& m, V x, V y) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V one = hn::Set(d, 1.0f);
  const V square = hn::Max(hn::MulAdd(x, x, hn::Mul(y, y)), hn::Set(d, 1e-30f));
  const V inverse = FastInverseSqrt(d, square);
  const V c = hn::Min(hn::Max(hn::Mul(y, inverse), hn::Neg(one)), one);
  const V sine = hn::Mul(x, inverse);
  const V angle = leaf::fast_acos(c);
  const V own = leaf::cosine_integral(s.nz, s.nt, sine, c, angle);
  const auto clipped = hn::Xor(hn::Lt(s.nz, hn::Zero(d)), hn::Le(c, s.edge_cosine));
  const V f = hn::IfThenElse(clipped, s.edge_integral, own);
  const V unit = hn::Mul(hn::Sub(f, m.first), FastReciprocal(d, m.span));
  return {hn::IfThenElse(clipped, s.edge_sine, sine), hn::IfThenElse(clipped, s.edge_cosine, c),
          hn::IfThenElse(clipped, s.edge_angle, angle),
          hn::Mul(hn::Set(d, 32.0f), hn::Min(hn::Max(unit, hn::Zero(d)), one))};
}

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE Sectors<D> StartSectors(D d, const Slice<V>& s, bool from_receiver, V depth, V back) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V zero = hn::Zero(d);
  const auto away = hn::Lt(s.nz, zero);
  Sectors<D> m;
  m.covered = hn::Zero(hn::RebindToUnsigned<D>());
  m.first = hn::IfThenElse(away, s.edge_integral, zero);
  const V end = hn::IfThenElse(away, hn::Mul(s.nt, hn::Set(d, 1.57079633f)), s.edge_integral);
  m.span = hn::Max(hn::Sub(end, m.first), hn::Set(d, 1e-12f));
  m.x = m.y = m.sum = m.sum_x = m.sum_y = m.sum_solid = zero;
  m.depth = depth;
  m.back = back;
  // What joins the receiver's own surface fills the slice down to its end.
  m.last = {hn::IfThenElse(away, zero, s.edge_sine),
            hn::IfThenElse(away, hn::Set(d, -1.0f), s.edge_cosine),
            hn::IfThenElse(away, hn::Set(d, 3.14159265f), s.edge_angle), hn::Set(d, 32.0f)};
  m.top = m.last;
  m.joined = from_receiver ? hn::Ge(zero, zero) : hn::Lt(zero, zero);
  return m;
}

template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>, class M = hwy::HWY_NAMESPACE::Mask<D>>
HWY_INLINE SectorEdge<V> SelectEdge(D, M mask, const SectorEdge<V>& yes, const SectorEdge<V>& no) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::IfThenElse(mask, yes.sine, no.sine), hn::IfThenElse(mask, yes.cosine, no.cosine),
          hn::IfThenElse(mask, yes.angle, no.angle), hn::IfThenElse(mask, yes.place, no.place)};
}

// Directions between two edges, per unit of the obscurance between them: of the whole piece, or at
// its middle where it is so thin that differences are noise.
template <SliceSums kSums, class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE void DirectionsBetween(D d, const Slice<V>& s, const SectorEdge<V>& low,
                                  const SectorEdge<V>& high, V& x, V& y, V& solid) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V tiny = hn::Set(d, 1e-30f);
  V mx = hn::Add(low.sine, high.sine), my = hn::Add(low.cosine, high.cosine);
  const V length =
      FastInverseSqrt(d, hn::Max(hn::MulAdd(mx, mx, hn::Mul(my, my)), hn::Set(d, 1e-12f)));
  mx = hn::Mul(mx, length);
  my = hn::Mul(my, length);
  V scale = hn::Set(d, 1.0f);
  if constexpr (kSums == SliceSums::kUniform) {
    const V lobe = hn::MulAdd(s.nz, my, hn::Mul(s.nt, mx));
    scale = FastReciprocal(d, hn::Max(lobe, hn::Set(d, 0.05f)));
  }
  V low_x, low_y, high_x, high_y;
  DirectionIntegral<kSums>(s.nz, s.nt, low.sine, low.cosine, low.angle, low_x, low_y);
  DirectionIntegral<kSums>(s.nz, s.nt, high.sine, high.cosine, high.angle, high_x, high_y);
  const V between = hn::Sub(leaf::cosine_integral(s.nz, s.nt, high.sine, high.cosine, high.angle),
                            leaf::cosine_integral(s.nz, s.nt, low.sine, low.cosine, low.angle));
  const auto thin = hn::Lt(between, hn::Set(d, 1e-3f));
  const V inverse = FastReciprocal(d, hn::Max(between, tiny));
  x = hn::IfThenElse(thin, hn::Mul(mx, scale), hn::Mul(hn::Sub(high_x, low_x), inverse));
  y = hn::IfThenElse(thin, hn::Mul(my, scale), hn::Mul(hn::Sub(high_y, low_y), inverse));
  solid = hn::IfThenElse(thin, scale, hn::Mul(hn::Sub(low.cosine, high.cosine), inverse));
}

// Adds the next point outwards: matter on its view ray from depth `depth` to `back`, `(bx, by)`
// being the place of its end. It fills what is between them, and where it touches the matter of the
// point before (within `slack` of depth), what is between the two points. `dither` in [-0.5, 0.5)
// moves the rounding of edges to sectors, so that many slices round without bias.
template <FalloffKind kKind, SliceSums kSums = SliceSums::kVisibility, class D,
          class V = hwy::HWY_NAMESPACE::Vec<D>, class M = hwy::HWY_NAMESPACE::Mask<D>>
HWY_INLINE void AddMatter(D d, const math::Rho& rho, const Slice<V>& s, V x, V y, V bx, V by,
                          V depth, V back, V slack, float dither, M valid, Sectors<D>& m) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const V zero = hn::Zero(d), tiny = hn::Set(d, 1e-30f);
  const SectorEdge<V> front = FindSector(d, s, m, x, y);
  SectorEdge<V> low = front;  // nearest to the zenith
  SectorEdge<V> high = FindSector(d, s, m, bx, by);
  const V gap = hn::Sub(hn::Max(depth, m.depth), hn::Min(back, m.back));
  const M joined = hn::And(m.joined, hn::Le(gap, slack));
  low = SelectEdge(d, hn::And(joined, hn::Lt(m.last.place, low.place)), m.last, low);
  high = SelectEdge(d, hn::And(joined, hn::Gt(m.last.place, high.place)), m.last, high);
  // Bits [i, j) as the difference of two masks of low bits; a shift by 32 would be undefined.
  auto below = [&](V place) HWY_ATTR {
    const auto i = hn::NearestInt(hn::Add(place, hn::Set(d, dither)));
    const auto n = hn::Min(hn::Max(i, hn::Zero(di)), hn::Set(di, 32));
    const auto all = hn::Set(du, 0xFFFFFFFFu);
    const auto shifted = hn::Shl(all, hn::BitCast(du, hn::Min(n, hn::Set(di, 31))));
    return hn::IfThenElse(hn::Eq(n, hn::Set(di, 32)), hn::BitCast(di, all),
                          hn::BitCast(di, hn::Not(shifted)));
  };
  const auto bits = hn::AndNot(below(low.place), below(high.place));
  const auto mine = hn::IfThenElseZero(hn::RebindMask(di, valid), bits);
  const auto fresh = hn::AndNot(hn::BitCast(di, m.covered), mine);
  if (!hn::AllTrue(di, hn::Eq(fresh, hn::Zero(di)))) {
    const V count = hn::ConvertTo(d, hn::BitCast(di, hn::PopulationCount(hn::BitCast(du, fresh))));
    // The edge stands as with endless matter (EdgeBefore).
    const V outwards = hn::Sub(x, m.x), rise = hn::Sub(y, m.y);
    const M edge = hn::And(joined, hn::And(hn::Gt(outwards, zero), hn::Gt(rise, outwards)));
    const V px = hn::IfThenElse(edge, hn::NegMulAdd(hn::Set(d, 0.5f), outwards, x), x);
    const M chord = hn::AndNot(edge, joined);
    V ex = hn::Mul(px, s.perspective), ey = hn::MulSub(y, s.perspective, s.camera);
    ex = hn::IfThenElse(chord, outwards, ex);
    ey = hn::IfThenElse(chord, rise, ey);
    const V numerator = hn::Abs(hn::MulSub(px, ey, hn::Mul(y, ex)));
    // rho at two directions between the edges, a quarter and three quarters along the chord of
    // their unit vectors.
    auto rho_at = [&](float t) HWY_ATTR {
      const V wt = hn::Set(d, t);
      const V wx = hn::MulAdd(wt, hn::Sub(high.sine, low.sine), low.sine);
      const V wy = hn::MulAdd(wt, hn::Sub(high.cosine, low.cosine), low.cosine);
      const V length = FastInverseSqrt(d, hn::Max(hn::MulAdd(wx, wx, hn::Mul(wy, wy)), tiny));
      const V denominator =
          hn::Max(hn::Mul(length, hn::Abs(hn::MulSub(wx, ey, hn::Mul(wy, ex)))), tiny);
      return RhoOf<kKind>(
          d, rho, hn::Min(hn::Mul(numerator, FastReciprocal(d, denominator)), hn::Set(d, 1e30f)));
    };
    const V mean = hn::Mul(hn::Set(d, 0.5f / 32), hn::Add(rho_at(0.25f), rho_at(0.75f)));
    const V piece = hn::Mul(hn::Mul(count, m.span), mean);
    auto add = [&](V& sum, V amount) HWY_ATTR {
      sum = hn::Add(sum, hn::IfThenElseZero(hn::Gt(count, zero), amount));
    };
    add(m.sum, piece);
    if constexpr (kSums != SliceSums::kVisibility) {
      // What reaches above all before is new above that only.
      const M above = hn::And(hn::Lt(low.place, m.top.place), hn::Gt(high.place, m.top.place));
      V wx, wy, solid;
      DirectionsBetween<kSums>(d, s, low, SelectEdge(d, above, m.top, high), wx, wy, solid);
      add(m.sum_x, hn::Mul(piece, wx));
      add(m.sum_y, hn::Mul(piece, wy));
      add(m.sum_solid, hn::Mul(piece, solid));
    }
    m.covered = hn::Or(m.covered, hn::BitCast(du, fresh));
  }
  m.x = hn::IfThenElse(valid, x, m.x);
  m.y = hn::IfThenElse(valid, y, m.y);
  m.depth = hn::IfThenElse(valid, depth, m.depth);
  m.back = hn::IfThenElse(valid, back, m.back);
  m.last = SelectEdge(d, valid, front, m.last);
  if constexpr (kSums != SliceSums::kVisibility) {
    m.top = SelectEdge(d, hn::And(valid, hn::Lt(low.place, m.top.place)), low, m.top);
  }
  m.joined = valid;
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
