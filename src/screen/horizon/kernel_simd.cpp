#include "screen/horizon/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/horizon/kernel_simd.cpp"
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

  // Beyond the row's end lanes follow the view: what neighbours skip depends on all lanes.
  const Vec3 n = loader.Normal(i);
  const M inside = hn::FirstN(d, std::min(loader.end - i, static_cast<int>(hn::Lanes(d))));
  r.nu = hn::IfThenElseZero(inside, n.x);
  r.nv = hn::Neg(hn::IfThenElseZero(inside, n.y));
  r.nw = hn::Neg(hn::IfThenElse(inside, n.z, one));
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

// The surface points at the samples along a line, one after the other, for add(point). Their texels
// are found a batch at a time, so that no load waits for the index that was stored just before it.
// A texel is moved parallel to the tangent plane from where its centre lies into the half-plane, so
// that planes of any tilt stay planes.
constexpr int kBatch = 8;
template <bool kSquared, class Add>
HWY_INLINE void ForPoints(const Frame& f, const Receiver& r, const Line& line, V shift, Add add) {
  const D d;
  const DI di;
  const Camera& c = f.view.camera;
  const V zero = hn::Zero(d), round = hn::Set(d, kRound);
  const V last_u = hn::Set(d, f.view.width - 1.0f), last_v = hn::Set(d, f.view.height - 1.0f);
  const V scale_u = hn::Set(d, c.scale_x), scale_v = hn::Set(d, c.scale_y);
  const VI stride = hn::Set(di, static_cast<std::int32_t>(f.view.stride));
  const VI middle = hn::Set(di, f.view.height / 2);  // rows count from there, as taps' do
  HWY_ALIGN std::int32_t index[kBatch][kMaxLanes];
  HWY_ALIGN float offset[2][kBatch][kMaxLanes];
  for (int first = 0; first < f.steps; first += kBatch) {
    const int count = std::min(kBatch, f.steps - first);
    for (int j = 0; j < count; ++j) {
      const V pixels = SampleAt<kSquared>(f, line, shift, first + j);
      const V kx = hn::Sub(hn::MulAdd(pixels, line.du, round), round);
      const V ky = hn::Sub(hn::MulAdd(pixels, line.dv, round), round);
      const V x = hn::Min(hn::Max(hn::Add(r.u, kx), zero), last_u);
      const V y = hn::Min(hn::Max(hn::Add(r.v, ky), zero), last_v);
      const VI row = hn::Sub(hn::ConvertTo(di, y), middle);
      hn::Store(hn::Add(hn::Mul(row, stride), hn::ConvertTo(di, x)), di, index[j]);
      hn::Store(hn::Mul(hn::Sub(x, r.u), scale_u), d, offset[0][j]);
      hn::Store(hn::Mul(hn::Sub(y, r.v), scale_v), d, offset[1][j]);
    }
    for (int j = 0; j < count; ++j) {
      const V q = om::GatherLanes(d, Base(f.view), index[j]);
      const V ku = hn::Load(d, offset[0][j]), kv = hn::Load(d, offset[1][j]);
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
      add(p);
    }
  }
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

// Sums over the directions of what is obscured, along the tangents and the zenith.
struct Obscured {
  V visibility, solid, t1, t2, zenith;
};
HWY_INLINE Obscured NothingObscured() {
  const V zero = hn::Zero(D());
  return {zero, zero, zero, zero, zero};
}
HWY_INLINE void AddDirection(const Turn& turn, V along, V zenith, Obscured* sum) {
  sum->t1 = hn::MulAdd(along, turn.cosine, sum->t1);
  sum->t2 = hn::MulAdd(along, turn.sine, sum->t2);
  sum->zenith = hn::Add(zenith, sum->zenith);
}

// The channels of directions: `whole` n - each * sum, in eye space (x right, y up, z to the
// camera).
HWY_INLINE void StoreDirections(const Receiver& r, const Vec3& n, const Obscured& sum, V whole,
                                V each, Rows out, int i) {
  const D d;
  const V zenith = hn::Div(sum.zenith, r.length);
  const V u = hn::MulAdd(sum.t1, r.t1u, hn::NegMulAdd(zenith, r.a, hn::Mul(sum.t2, r.t2u)));
  const V v = hn::NegMulAdd(zenith, r.b, hn::Mul(sum.t2, r.t2v));
  const V w = hn::MulAdd(sum.t1, r.t1w, hn::MulSub(sum.t2, r.t2w, zenith));
  hn::StoreU(hn::NegMulAdd(each, u, hn::Mul(whole, n.x)), d, out[1] + i);
  hn::StoreU(hn::MulAdd(each, v, hn::Mul(whole, n.y)), d, out[2] + i);
  hn::StoreU(hn::MulAdd(each, w, hn::Mul(whole, n.z)), d, out[3] + i);
}

// rho = 1 up to R: only the highest sample counts.
template <SliceSums kSums>
HWY_INLINE void AddConstantSlice(const Frame& f, const Receiver& r, const Line& line,
                                 const Turn& turn, const om::Slice<V>& slice, Obscured* sum) {
  const D d;
  const V one = hn::Set(d, 1.0f);
  const V radius = hn::Set(d, f.rho->radius), inverse_radius = hn::Set(d, f.rho->inverse_radius);
  V cosine = slice.edge_cosine;
  ForPoints<true>(f, r, line, turn.shift, [&](const Point& p) HWY_ATTR {
    const V c = CutCosine(p.x, p.y, slice.camera, slice.perspective, radius, inverse_radius);
    cosine = hn::IfThenElse(p.valid, hn::Max(cosine, c), cosine);
  });
  cosine = hn::Min(cosine, one);
  const V sine = hn::Sqrt(hn::NegMulAdd(cosine, cosine, one));
  const V angle = om::leaf::fast_acos(cosine);
  const V open = om::leaf::cosine_integral(slice.nz, slice.nt, sine, cosine, angle);
  sum->visibility = hn::Add(sum->visibility, hn::Sub(slice.edge_integral, open));
  if constexpr (kSums != SliceSums::kVisibility) {
    V x, y, edge_x, edge_y;
    om::DirectionIntegral<kSums>(slice.nz, slice.nt, sine, cosine, angle, x, y);
    om::DirectionIntegral<kSums>(slice.nz, slice.nt, slice.edge_sine, slice.edge_cosine,
                                 slice.edge_angle, edge_x, edge_y);
    AddDirection(turn, hn::Sub(edge_x, x), hn::Sub(edge_y, y), sum);
    sum->solid = hn::Add(sum->solid, hn::Sub(cosine, slice.edge_cosine));
  }
}

template <FalloffKind kKind, bool kChord, SliceSums kSums>
HWY_INLINE void AddSlice(const Frame& f, const Receiver& r, const Line& line, const Turn& turn,
                         const om::Slice<V>& slice, Obscured* sum) {
  const D d;
  om::Horizon<D> h = om::StartHorizon<kSums>(d, slice, true);
  ForPoints<true>(f, r, line, turn.shift, [&](const Point& p) HWY_ATTR {
    om::AddPoint<kKind, kChord, false, kSums>(d, *f.rho, slice, p.x, p.y, p.valid, hn::Set(d, 1.0f),
                                              h);
  });
  sum->visibility = hn::Add(sum->visibility, h.sum);
  if constexpr (kSums != SliceSums::kVisibility) AddDirection(turn, h.sum_x, h.sum_y, sum);
  if constexpr (kSums == SliceSums::kUniform) sum->solid = hn::Add(sum->solid, h.sum_solid);
}

template <FalloffKind kKind, bool kChord, SliceSums kSums>
void Slices(const Frame& f, int row, int width, Rows out) {
  const D d;
  const RowLoader loader(f.view, row, width);
  const bool orthographic = f.view.camera.orthographic;
  const V one = hn::Set(d, 1.0f), perspective = hn::Set(d, orthographic ? 0.0f : 1.0f);
  const V each = hn::Set(d, 1.0f / static_cast<float>(f.directions)), twice = hn::Add(each, each);
  for (int i = 0; i < width; i += static_cast<int>(hn::Lanes(d))) {
    const Receiver r = MakeReceiver(f, loader, i, loader.Depth(i));
    const V camera = orthographic ? one : hn::Mul(r.z, r.length);
    Obscured sum = NothingObscured();
    for (int k = 0; k < f.directions; ++k) {
      const Turn turn = MakeTurn(f, row, i, k);
      const Line line = MakeLine(f, r, turn.cosine, turn.sine);
      const om::Slice<V> slice = om::MakeSlice(d, r.nz, line.nt, camera, perspective);
      if constexpr (kKind == FalloffKind::kConstant) {
        AddConstantSlice<kSums>(f, r, line, turn, slice, &sum);
      } else {
        AddSlice<kKind, kChord, kSums>(f, r, line, turn, slice, &sum);
      }
    }
    // w_k = 2 pi / K.
    const V visibility = hn::NegMulAdd(sum.visibility, twice, one);
    hn::StoreU(visibility, d, out[0] + i);
    if constexpr (kSums == SliceSums::kUniform) {
      const V whole = hn::Mul(hn::Mul(sum.solid, each), hn::Set(d, 0.5f));
      StoreDirections(r, loader.Normal(i), sum, whole, each, out, i);
    } else if constexpr (kSums == SliceSums::kCosine) {
      const V whole = hn::Mul(hn::Sub(one, visibility), hn::Set(d, 2.0f / 3));
      StoreDirections(r, loader.Normal(i), sum, whole, twice, out, i);
    }
  }
}

template <SliceSums kSums>
void SlicesOf(const Frame& f, int row, int width, Rows out) {
  math::with_falloff_kind(f.rho->kind, [&]<FalloffKind kKind>() {
    if (kKind == FalloffKind::kConstant || !f.chord) {
      Slices<kKind, false, kSums>(f, row, width, out);
    } else {
      Slices<kKind, kKind != FalloffKind::kConstant, kSums>(f, row, width, out);
    }
  });
}

void SlicesAny(const Frame& f, SliceSums sums, int row, int width, Rows out) {
  switch (sums) {
    case SliceSums::kVisibility:
      return SlicesOf<SliceSums::kVisibility>(f, row, width, out);
    case SliceSums::kUniform:
      return SlicesOf<SliceSums::kUniform>(f, row, width, out);
    case SliceSums::kCosine:
      return SlicesOf<SliceSums::kCosine>(f, row, width, out);
  }
}

// Bavoil et al.: elevations h over the plane at right angles to the zenith, from the tangent
// plane's t on; AO = 1/(2 pi) integral of the sum of W(r_i) (sin h_i - sin h_(i-1)).
//
// Directions: what a slice has lost is taken to lie evenly over s = sin h from the tangent plane to
// the horizon, with mean s and mean square of cos h = 1 - (mean s)^2 - extent^2/12.
template <bool kDirections>
void Classic(const Frame& f, int row, int width, Rows out) {
  const D d;
  const RowLoader loader(f.view, row, width);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  const V inverse = hn::Set(d, 1 / (f.reach * f.reach));
  const V each = hn::Set(d, 1.0f / static_cast<float>(f.directions));
  for (int i = 0; i < width; i += static_cast<int>(hn::Lanes(d))) {
    const Receiver r = MakeReceiver(f, loader, i, loader.Depth(i));
    Obscured sum = NothingObscured();
    for (int k = 0; k < f.directions; ++k) {
      const Turn turn = MakeTurn(f, row, i, k);
      const Line line = MakeLine(f, r, turn.cosine, turn.sine);
      const V scale = om::FastInverseSqrt(d, hn::MulAdd(r.nz, r.nz, hn::Mul(line.nt, line.nt)));
      const V tangent_sine = hn::Neg(hn::Mul(line.nt, scale));
      const V start = hn::MulAdd(tangent_sine, hn::Set(d, f.bias_cosine),
                                 hn::Mul(hn::Mul(r.nz, scale), hn::Set(d, f.bias_sine)));
      V horizon = start, obscured = zero;
      ForPoints<false>(f, r, line, turn.shift, [&](const Point& p) HWY_ATTR {
        const V square = hn::Max(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)), hn::Set(d, 1e-37f));
        const V sine = hn::Mul(p.y, om::FastInverseSqrt(d, square));
        const V weight = hn::NegMulAdd(square, inverse, one);
        const M counts = hn::And(hn::And(p.valid, hn::Gt(weight, zero)), hn::Gt(sine, horizon));
        const V rise = hn::Mul(weight, hn::Sub(sine, horizon));
        obscured = hn::Add(obscured, hn::IfThenElseZero(counts, rise));
        horizon = hn::IfThenElse(counts, sine, horizon);
      });
      sum.solid = hn::Add(sum.solid, obscured);
      if constexpr (kDirections) {
        const V mean = hn::Mul(half, hn::Add(start, horizon)), extent = hn::Sub(horizon, start);
        const V spread = hn::Mul(hn::Mul(extent, extent), hn::Set(d, 1.0f / 12));
        const V rest = hn::Max(hn::NegMulAdd(mean, mean, hn::Sub(one, spread)), zero);
        AddDirection(turn, hn::Mul(obscured, hn::Sqrt(rest)), hn::Mul(obscured, mean), &sum);
      }
    }
    hn::StoreU(hn::NegMulAdd(sum.solid, each, one), d, out[0] + i);
    if constexpr (kDirections) {
      StoreDirections(r, loader.Normal(i), sum, hn::Mul(hn::Mul(sum.solid, each), half), each, out,
                      i);
    }
  }
}

void ClassicAny(const Frame& f, int row, int width, Rows out) {
  out[1] ? Classic<true>(f, row, width, out) : Classic<false>(f, row, width, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::horizon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::horizon {

HWY_EXPORT(SlicesAny);
HWY_EXPORT(ClassicAny);

void slices_row(const Frame& frame, SliceSums sums, int row, int width, Rows out) {
  HWY_DYNAMIC_DISPATCH(SlicesAny)(frame, sums, row, width, out);
}
void classic_row(const Frame& frame, int row, int width, Rows out) {
  HWY_DYNAMIC_DISPATCH(ClassicAny)(frame, row, width, out);
}

}  // namespace obscura::horizon
#endif
