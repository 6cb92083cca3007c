#include "screen/horizon/horizon_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/horizon/horizon_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "math/fast-inl.h"
#include "math/slab-inl.h"
#include "view/taps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::horizon {
namespace HWY_NAMESPACE {

using namespace obscura::HWY_NAMESPACE::taps;
namespace om = obscura::HWY_NAMESPACE;
using M = hn::Mask<D>;

// The least n.zenith: a visible surface does not turn farther away from the camera.
constexpr float kEdgeOnNormal = 1e-3f;

// A vector of receivers in the frame of math/azimuth-inl.h (u right, v down, w along the view) with
// two tangents at right angles to the zenith. Directions are spread evenly around the zenith, so
// that each stands for the same azimuth w_k = 2 pi / K of equation 2.
struct Receiver {
  V z, distance;                     // depth; depth, or 1 where rays are parallel
  V a, b, length;                    // the ray (a, b, 1) or (0, 0, 1)
  V t1u, t1w, t2u, t2v, t2w;         // the tangents; t1v = 0
  V nu, nv, nw, nz, inverse_nz, nr;  // normal; along the zenith; n.ray
  V u, v;                            // pixel of the whole image
};

HWY_INLINE Receiver MakeReceiver(const Frame& f, const RowLoader& loader, int i, V z) {
  const D d;
  const Camera& c = f.view.camera;
  const V one = hn::Set(d, 1.0f), perspective = hn::Set(d, c.orthographic ? 0.0f : 1.0f);
  Receiver r;
  r.z = hn::IfThenElse(hn::Lt(z, hn::Inf(d)), z, one);
  r.distance = c.orthographic ? one : r.z;
  r.u = hn::Iota(d, static_cast<float>(f.view.left + i));
  r.v = hn::Set(d, static_cast<float>(loader.y));
  r.a = hn::Mul(perspective,
                hn::Mul(hn::Sub(r.u, hn::Set(d, c.center_u - 0.5f)), hn::Set(d, c.scale_x)));
  r.b = hn::Mul(perspective,
                hn::Mul(hn::Sub(r.v, hn::Set(d, c.center_v - 0.5f)), hn::Set(d, c.scale_y)));
  const V across = hn::Sqrt(hn::MulAdd(r.a, r.a, one));
  r.length = hn::Sqrt(hn::MulAdd(r.a, r.a, hn::MulAdd(r.b, r.b, one)));
  r.t1u = hn::Div(one, across);
  r.t1w = hn::Neg(hn::Mul(r.a, r.t1u));
  const V scale = hn::Div(r.t1u, r.length);
  r.t2u = hn::Neg(hn::Mul(hn::Mul(r.a, r.b), scale));
  r.t2v = hn::Div(across, r.length);
  r.t2w = hn::Neg(hn::Mul(r.b, scale));

  const Vec3 n = loader.Normal(i);
  r.nu = n.x;
  r.nv = hn::Neg(n.y);
  r.nw = hn::Neg(n.z);
  const V inverse = hn::Div(one, r.length);
  r.nr = hn::MulAdd(r.nu, r.a, hn::MulAdd(r.nv, r.b, r.nw));
  r.nz = hn::Neg(hn::Mul(r.nr, inverse));
  const V bend = hn::Mul(hn::Max(hn::Sub(hn::Set(d, kEdgeOnNormal), r.nz), hn::Zero(d)), inverse);
  r.nu = hn::NegMulAdd(bend, r.a, r.nu);
  r.nv = hn::NegMulAdd(bend, r.b, r.nv);
  r.nw = hn::Sub(r.nw, bend);
  r.nz = hn::Max(r.nz, hn::Set(d, kEdgeOnNormal));
  r.nr = hn::Neg(hn::Mul(r.nz, r.length));
  r.inverse_nz = hn::Div(one, r.nz);
  return r;
}

// One direction around the zenith and its line in the image.
struct Line {
  V tu, tv, tw;    // the tangent
  V nt;            // the normal along it
  V du, dv, last;  // pixels: unit step, and how far the samples go
};

HWY_INLINE Line MakeLine(const Frame& f, const Receiver& r, V cosine, V sine) {
  const D d;
  const Camera& c = f.view.camera;
  Line line;
  line.tu = hn::MulAdd(cosine, r.t1u, hn::Mul(sine, r.t2u));
  line.tv = hn::Mul(sine, r.t2v);
  line.tw = hn::MulAdd(cosine, r.t1w, hn::Mul(sine, r.t2w));
  line.nt = hn::MulAdd(r.nu, line.tu, hn::MulAdd(r.nv, line.tv, hn::Mul(r.nw, line.tw)));
  // The half-plane of zenith and tangent holds the camera: the image of all of it is a line.
  const V gu = hn::Mul(hn::NegMulAdd(r.a, line.tw, line.tu), hn::Set(d, 1 / c.scale_x));
  const V gv = hn::Mul(hn::NegMulAdd(r.b, line.tw, line.tv), hn::Set(d, 1 / c.scale_y));
  const V square = hn::MulAdd(gu, gu, hn::Mul(gv, gv));
  const V inverse = hn::Div(hn::Set(d, 1.0f), hn::Sqrt(square));
  line.du = hn::Mul(gu, inverse);
  line.dv = hn::Mul(gv, inverse);
  const V reach = hn::Div(hn::Mul(hn::Set(d, f.reach), hn::Mul(square, inverse)), r.distance);
  // No farther than the last texels of the image.
  auto border = [&](V at, V step, int size) HWY_ATTR {
    const V tiny = hn::Set(d, 1e-6f), end = hn::Set(d, static_cast<float>(size - 1));
    const V room = hn::IfThenElse(hn::Gt(step, hn::Zero(d)), hn::Sub(end, at), at);
    return hn::Div(room, hn::Max(hn::Abs(step), tiny));
  };
  line.last = hn::Min(hn::Min(reach, border(r.u, line.du, f.view.width)),
                      border(r.v, line.dv, f.view.height));
  return line;
}

// A surface point in the half-plane of zenith and tangent: x along the tangent, y along the zenith.
struct Point {
  V x, y;
  M valid;
};

// The texel at `pixels` along the line. It is moved parallel to the tangent plane from where its
// centre lies into the half-plane, so that planes of any tilt stay planes.
HWY_INLINE Point Fetch(const Frame& f, const Receiver& r, const Line& line, V pixels) {
  const D d;
  const DI di;
  const Camera& c = f.view.camera;
  const V round = hn::Set(d, kRound);
  const V kx = hn::Sub(hn::Add(hn::Mul(pixels, line.du), round), round);
  const V ky = hn::Sub(hn::Add(hn::Mul(pixels, line.dv), round), round);
  const V zero = hn::Zero(d);
  const V x = hn::Min(hn::Max(hn::Add(r.u, kx), zero), hn::Set(d, f.view.width - 1.0f));
  const V y = hn::Min(hn::Max(hn::Add(r.v, ky), zero), hn::Set(d, f.view.height - 1.0f));
  HWY_ALIGN std::int32_t index[kMaxLanes];
  // Counts from the image's middle row, as taps do.
  const VI row = hn::Sub(hn::ConvertTo(di, y), hn::Set(di, f.view.height / 2));
  const VI stride = hn::Set(di, static_cast<std::int32_t>(f.view.stride));
  hn::Store(hn::Add(hn::Mul(row, stride), hn::ConvertTo(di, x)), di, index);
  const V q = om::GatherLanes(d, Base(f.view), index);
  const V ku = hn::Mul(hn::Sub(x, r.u), hn::Set(d, c.scale_x));
  const V kv = hn::Mul(hn::Sub(y, r.v), hn::Set(d, c.scale_y));
  Point p;
  p.valid = hn::Lt(q, hn::Inf(d));
  const V depth = hn::IfThenElse(p.valid, q, r.z);
  const V away = c.orthographic ? r.distance : depth;
  // With k = (ku, kv, 0) the point is at q (r + k) - z r from the receiver; r.t = 0.
  p.x = hn::Mul(away, hn::MulAdd(ku, line.tu, hn::Mul(kv, line.tv)));
  const V nk = hn::MulAdd(ku, r.nu, hn::Mul(kv, r.nv));
  const V height = hn::MulAdd(away, nk, hn::Mul(hn::Sub(depth, r.z), r.nr));
  p.y = hn::Mul(hn::NegMulAdd(line.nt, p.x, height), r.inverse_nz);
  p.valid = hn::And(p.valid, hn::Gt(p.x, zero));
  return p;
}

// The rotation of direction k, and its samples' shift, for pixels from column i of a row on.
struct Turn {
  V cosine, sine, shift;
};
HWY_INLINE Turn MakeTurn(const Frame& f, int row, int i, int k) {
  const D d;
  auto tile = [&](int value) HWY_ATTR {
    return hn::LoadU(d, &f.tile[value][row % f.interleave][i % f.interleave]);
  };
  const V c = hn::Set(d, f.cosine[k]), s = hn::Set(d, f.sine[k]);
  const V tc = tile(kTileCos), ts = tile(kTileSin);
  const V shift = hn::Add(tile(kTileShift), hn::Set(d, f.shift[k]));
  return {hn::MulSub(c, tc, hn::Mul(s, ts)), hn::MulAdd(s, tc, hn::Mul(c, ts)),
          hn::Sub(shift, hn::Floor(shift))};
}

// Distance of sample j in pixels: at least one more than the one before, as far as there are any.
template <bool kSquared>
HWY_INLINE V SampleAt(const Frame& f, const Line& line, V shift, int j) {
  const D d;
  V share = hn::Mul(hn::Add(shift, hn::Set(d, static_cast<float>(j))),
                    hn::Set(d, 1.0f / static_cast<float>(f.steps)));
  if constexpr (kSquared) share = hn::Mul(share, share);
  const V least = hn::Set(d, static_cast<float>(j + 1));
  return hn::Min(hn::Max(hn::Mul(share, line.last), least), line.last);
}

// rho = 1 up to R: cos of the zenith angle down to which the matter below a sample, which hangs
// along the sample's view ray, reaches within the sphere of radius R; -2 where it does not. With
// gamma the angle at the camera, C its distance and D = C sin gamma the distance of the ray, the
// ray enters the sphere at the zenith angle asin(D / R) - gamma.
HWY_INLINE V CutCosine(V x, V y, V camera, V perspective, V radius, V inverse_radius) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), none = hn::Set(d, -2.0f);
  const V square = hn::MulAdd(x, x, hn::Mul(y, y));
  const V cosine = hn::Mul(y, om::FastInverseSqrt(d, hn::Max(square, hn::Set(d, 1e-37f))));
  const M inside = hn::Le(square, hn::Mul(radius, radius));
  if (hn::AllTrue(d, inside)) return cosine;
  const V ex = hn::Mul(x, perspective), ey = hn::MulSub(y, perspective, camera);
  const V e =
      om::FastInverseSqrt(d, hn::Max(hn::MulAdd(ex, ex, hn::Mul(ey, ey)), hn::Set(d, 1e-37f)));
  const V distance =
      hn::Mul(hn::Abs(hn::MulSub(x, ey, hn::Mul(y, ex))), hn::Mul(e, inverse_radius));
  const V rest = hn::NegMulAdd(distance, distance, one);
  const V entry = hn::MulAdd(distance, hn::Mul(ex, e),
                             hn::Neg(hn::Mul(hn::Sqrt(hn::Max(rest, zero)), hn::Mul(ey, e))));
  // Only a sample between camera and sphere hangs its matter through it.
  const M in_front = hn::Lt(hn::MulAdd(x, ex, hn::Mul(y, ey)), zero);
  const V cut = hn::IfThenElse(hn::And(in_front, hn::Gt(rest, zero)), entry, none);
  return hn::IfThenElse(inside, cosine, cut);
}

template <FalloffKind kKind, bool kChord>
void Slices(const Frame& f, int row, int begin, int end, float* HWY_RESTRICT out) {
  const D d;
  const RowLoader loader(f.view, row, end);
  const bool orthographic = f.view.camera.orthographic;
  const V one = hn::Set(d, 1.0f), perspective = hn::Set(d, orthographic ? 0.0f : 1.0f);
  const V radius = hn::Set(d, f.rho->radius), inverse_radius = hn::Set(d, f.rho->inverse_radius);
  for (int i = begin; i < end; i += static_cast<int>(hn::Lanes(d))) {
    const V z = loader.Depth(i);
    const Receiver r = MakeReceiver(f, loader, i, z);
    const V camera = orthographic ? one : hn::Mul(r.z, r.length);
    V sum = hn::Zero(d);
    for (int k = 0; k < f.directions; ++k) {
      const Turn turn = MakeTurn(f, row, i, k);
      const Line line = MakeLine(f, r, turn.cosine, turn.sine);
      const om::Slice<V> slice = om::MakeSlice(d, r.nz, line.nt, camera, perspective);
      if constexpr (kKind == FalloffKind::kConstant) {
        V cosine = slice.edge_cosine;
        for (int j = 0; j < f.steps; ++j) {
          const Point p = Fetch(f, r, line, SampleAt<true>(f, line, turn.shift, j));
          const V c = CutCosine(p.x, p.y, camera, perspective, radius, inverse_radius);
          cosine = hn::IfThenElse(p.valid, hn::Max(cosine, c), cosine);
        }
        cosine = hn::Min(cosine, one);
        const V sine = hn::Sqrt(hn::NegMulAdd(cosine, cosine, one));
        const V open =
            om::CosineIntegral(d, slice.nz, slice.nt, sine, cosine, om::FastAcos(d, cosine));
        sum = hn::Add(sum, hn::Sub(slice.edge_integral, open));
      } else {
        om::Horizon<D> h = om::StartHorizon(d, slice, true);
        for (int j = 0; j < f.steps; ++j) {
          const Point p = Fetch(f, r, line, SampleAt<true>(f, line, turn.shift, j));
          om::AddPoint<kKind, kChord, false>(d, *f.rho, slice, p.x, p.y, p.valid, one, h);
        }
        sum = hn::Add(sum, h.sum);
      }
    }
    const V scale = hn::Set(d, 2.0f / static_cast<float>(f.directions));
    loader.Store(hn::NegMulAdd(sum, scale, one), z, i, out + (i - begin));
  }
}

void SlicesAny(const Frame& f, int row, int begin, int end, float* out) {
  math::with_falloff_kind(f.rho->kind, [&]<FalloffKind kKind>() {
    f.chord ? Slices<kKind, true>(f, row, begin, end, out)
            : Slices<kKind, false>(f, row, begin, end, out);
  });
}

// Bavoil et al.: elevations h over the plane at right angles to the zenith, from the tangent
// plane's t on; AO = 1/(2 pi) integral of the sum of W(r_i) (sin h_i - sin h_(i-1)).
void Classic(const Frame& f, int row, int begin, int end, float* HWY_RESTRICT out) {
  const D d;
  const RowLoader loader(f.view, row, end);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V inverse = hn::Set(d, 1 / (f.reach * f.reach));
  for (int i = begin; i < end; i += static_cast<int>(hn::Lanes(d))) {
    const V z = loader.Depth(i);
    const Receiver r = MakeReceiver(f, loader, i, z);
    V sum = zero;
    for (int k = 0; k < f.directions; ++k) {
      const Turn turn = MakeTurn(f, row, i, k);
      const Line line = MakeLine(f, r, turn.cosine, turn.sine);
      const V scale = om::FastInverseSqrt(d, hn::MulAdd(r.nz, r.nz, hn::Mul(line.nt, line.nt)));
      const V tangent_sine = hn::Neg(hn::Mul(line.nt, scale));
      V horizon = hn::MulAdd(tangent_sine, hn::Set(d, f.bias_cosine),
                             hn::Mul(hn::Mul(r.nz, scale), hn::Set(d, f.bias_sine)));
      for (int j = 0; j < f.steps; ++j) {
        const Point p = Fetch(f, r, line, SampleAt<false>(f, line, turn.shift, j));
        const V square = hn::Max(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)), hn::Set(d, 1e-37f));
        const V sine = hn::Mul(p.y, om::FastInverseSqrt(d, square));
        const V weight = hn::NegMulAdd(square, inverse, one);
        const M counts = hn::And(hn::And(p.valid, hn::Gt(weight, zero)), hn::Gt(sine, horizon));
        const V rise = hn::Mul(weight, hn::Sub(sine, horizon));
        sum = hn::Add(sum, hn::IfThenElseZero(counts, rise));
        horizon = hn::IfThenElse(counts, sine, horizon);
      }
    }
    const V scale = hn::Set(d, 1.0f / static_cast<float>(f.directions));
    loader.Store(hn::NegMulAdd(sum, scale, one), z, i, out + (i - begin));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::horizon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::horizon {

HWY_EXPORT(SlicesAny);
HWY_EXPORT(Classic);

void slices_row(const Frame& frame, int row, int begin, int end, float* out) {
  HWY_DYNAMIC_DISPATCH(SlicesAny)(frame, row, begin, end, out);
}
void classic_row(const Frame& frame, int row, int begin, int end, float* out) {
  HWY_DYNAMIC_DISPATCH(Classic)(frame, row, begin, end, out);
}

}  // namespace obscura::horizon
#endif
