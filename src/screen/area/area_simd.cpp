#include "screen/area/area_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/area/area_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "math/sphere_line-inl.h"
#include "view/taps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::area {
namespace HWY_NAMESPACE {

using namespace obscura::HWY_NAMESPACE::taps;
using obscura::HWY_NAMESPACE::GatherPairs;
using obscura::HWY_NAMESPACE::QuadraticLine;

// Deviations below this many radii count as this: it keeps quotients finite.
constexpr float kLeastDeviation = 1e-3f;
constexpr float kMaxOffset = 1e30f;  // in radii

// Integral of rho and of z rho along a sample's line from the sphere's middle to z.
struct ConstantRho {
  HWY_INLINE ConstantRho(const AreaFrame&, int) {}
  // Integral of rho(z) times (end - z) / (2 sigma) from lo to hi.
  HWY_INLINE V Ramp(V lo, V hi, V end, V per_width) const {
    const V middle = hn::Mul(hn::Set(D(), 0.5f), hn::Add(lo, hi));
    return hn::Mul(hn::Mul(hn::Sub(hi, lo), hn::Sub(end, middle)), per_width);
  }
  HWY_INLINE V operator()(V z) const { return z; }
};
struct QuadraticRho {
  HWY_INLINE QuadraticRho(const AreaFrame& f, int i) : lateral(hn::Set(D(), f.lateral[i])) {}
  HWY_INLINE V operator()(V z) const { return QuadraticLine(D(), z, lateral); }
  // The integral of z (1 - s)^2 is s^2/2 - 2 s^3/3 + s^4/4 with s^2 = l^2 + z^2.
  HWY_INLINE V First(V z) const {
    const D d;
    const V square = hn::MulAdd(z, z, hn::Mul(lateral, lateral)), s = hn::Sqrt(square);
    const V inner = hn::MulAdd(square, hn::Set(d, 0.25f),
                               hn::NegMulAdd(s, hn::Set(d, 2.0f / 3), hn::Set(d, 0.5f)));
    return hn::Mul(square, inner);
  }
  HWY_INLINE V Ramp(V lo, V hi, V end, V per_width) const {
    const V zeroth = hn::Sub((*this)(hi), (*this)(lo)), first = hn::Sub(First(hi), First(lo));
    return hn::Mul(hn::MulSub(end, zeroth, first), per_width);
  }
  V lateral;
};

// Section 4.2: visibility is 1 up to mu - sigma and falls to 0 at mu + sigma, as a z + b with
// a = -1/(2 sigma), b = (mu + sigma)/(2 sigma). Integral of rho times it over [-zs, zs].
template <class Rho>
HWY_INLINE V Integral(const Rho& rho, V mu, V sigma, V zs, V half) {
  const D d;
  const V minus_zs = hn::Neg(zs);
  const V start = hn::Sub(mu, sigma), end = hn::Add(mu, sigma);
  const V lo = hn::Max(hn::Min(start, zs), minus_zs), hi = hn::Max(hn::Min(end, zs), minus_zs);
  const V per_width = hn::Div(hn::Set(d, 0.5f), sigma);
  return hn::Add(hn::Add(rho(lo), half), rho.Ramp(lo, hi, end, per_width));
}

template <bool kNormals, bool kThickness>
struct Block {
  // Two levels of each sample: texels, and how far the second counts.
  HWY_ALIGN std::int32_t index[kVectors][kMaxAreaSamples][2][kMaxLanes];
  HWY_ALIGN float blend[kVectors][kMaxAreaSamples][kMaxLanes];
  // In radii: the tangent plane's mean and deviation under the kernel, and the thickness in depth.
  HWY_ALIGN float plane[kNormals ? kVectors : 1][kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float slant[kNormals ? kVectors : 1][kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float behind[kThickness ? kVectors : 1][kMaxAreaSamples][kMaxLanes];
};

// 2^n for whole n in [-126, 127], given as float lanes.
HWY_INLINE V PowerOfTwo(VI n) {
  const DI di;
  return hn::BitCast(D(), hn::ShiftLeft<23>(hn::Add(n, hn::Set(di, 127))));
}

// The pyramid as the kernel addresses it.
struct Pyramid {
  HWY_INLINE Pyramid(const AreaFrame& f)
      : area(hn::Set(DI(), static_cast<std::int32_t>(f.area))),
        stride(hn::Set(DI(), f.stride)),
        last(hn::Set(DI(), f.levels - 1)) {}

  // The texel of `level` nearest to pixel (ix, iy), and the pixel at its centre.
  // With jitter in [-1/2, 1/2) of a texel, any of the four around, each as often as bilinear
  // interpolation would weigh it.
  template <bool kJitter>
  HWY_INLINE VI Find(VI level, VI ix, VI iy, V jitter_x, V jitter_y, VI max_x, VI max_y, VI* px,
                     VI* py) const {
    const DI di;
    const VI shift =
        hn::Max(hn::Sub(level, hn::Set(di, MomentPyramid::kFullLevels - 1)), hn::Zero(di));
    const VI one = hn::Set(di, 1), bit = hn::Shl(one, shift), half = hn::ShiftRight<1>(bit);
    if constexpr (kJitter) {
      const V width = hn::ConvertTo(D(), bit);
      ix = hn::Max(hn::Add(ix, hn::NearestInt(hn::Mul(jitter_x, width))), hn::Zero(di));
      iy = hn::Max(hn::Add(iy, hn::NearestInt(hn::Mul(jitter_y, width))), hn::Zero(di));
    }
    // Rounded to the nearest, but not past the last that the level keeps.
    const VI tx = hn::Min(hn::Shr(hn::Add(ix, half), shift), hn::Shr(max_x, shift));
    const VI ty = hn::Min(hn::Shr(hn::Add(iy, half), shift), hn::Shr(max_y, shift));
    *px = hn::Mul(tx, bit);
    *py = hn::Mul(ty, bit);
    // As MomentPyramid::start(). Both ways are computed, one is taken.
    const VI full = hn::Mul(hn::Min(level, hn::Set(di, MomentPyramid::kFullLevels - 1)), area);
    const VI rest =
        hn::Sub(hn::ShiftLeft<2>(area), hn::Shr(area, hn::Max(hn::Sub(shift, one), hn::Zero(di))));
    const VI start = hn::IfThenElse(hn::Gt(shift, hn::Zero(di)), rest, full);
    return hn::Add(start, hn::Add(hn::Mul(ty, hn::Shr(stride, shift)), tx));
  }

  VI area, stride, last;
};

template <bool kRotate, bool kNormals, bool kThickness>
HWY_INLINE void FindTaps(const AreaFrame& f, const Pyramid& pyramid, Receivers r, Vec3 n,
                         Vec3 noise, int v, Block<kNormals, kThickness>* block) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), round = hn::Set(d, kRound);
  const V per_radius = hn::Set(d, 1 / f.view.radius);
  V gradient = zero;
  if constexpr (kNormals) {
    r.SetNormal(&n);
    // How much n.r' changes per pixel along its steepest direction.
    gradient = hn::Sqrt(hn::MulAdd(r.plane_x, r.plane_x, hn::Mul(r.plane_y, r.plane_y)));
  }
  // One logarithm per pixel: of the radius in pixels.
  const V least = hn::Set(d, 1e-3f);
  const V reach_level = hn::Mul(
      hn::Set(d, 0.5f), hn::Log2(d, hn::Mul(hn::Max(r.reach_x, least), hn::Max(r.reach_y, least))));
  const V last_level = hn::ConvertTo(d, pyramid.last);
  const VI middle = hn::Set(di, f.view.height / 2);
  const VI max_y = hn::Set(di, f.view.height - 1);
  const V xc = hn::Mul(r.reach_x, noise.x), xs = hn::Mul(r.reach_x, noise.y);
  const V yc = hn::Mul(r.reach_y, noise.x), ys = hn::Mul(r.reach_y, noise.y);
  // Digits of the random directions that reflection does not notice.
  auto digits = [&](V u) HWY_ATTR {
    const V v = hn::Mul(u, hn::Set(d, 64.0f));
    return hn::Sub(v, hn::Round(v));
  };
  const V jitter_x = digits(noise.x), jitter_y = digits(noise.y);
  for (int i = 0; i < f.samples; ++i) {
    const V sx = hn::Set(d, f.x[i]), sy = hn::Set(d, f.y[i]);
    const V du = kRotate ? hn::MulAdd(xc, sx, hn::Mul(xs, sy)) : hn::Mul(r.reach_x, sx);
    const V dv = kRotate ? hn::MulSub(ys, sx, hn::Mul(yc, sy)) : hn::Mul(r.reach_y, sy);
    VI ix, iy;
    r.Find(hn::Add(du, round), hn::Add(dv, round), &ix, &iy);
    iy = hn::Add(iy, middle);
    // Near the border the level sinks until its kernel, 2 (2^l - 1) pixels to each side, fits into
    // the image: to the exponent of the room there, less 1, and linearly on to the next.
    const VI room_x = hn::Min(ix, hn::Sub(r.max_x, ix)), room_y = hn::Min(iy, hn::Sub(max_y, iy));
    const VI room = hn::Add(hn::ShiftRight<1>(hn::Min(room_x, room_y)), hn::Set(di, 1));
    const VI room_bits = hn::BitCast(di, hn::ConvertTo(d, room));
    const V fraction = hn::Mul(hn::ConvertTo(d, hn::And(room_bits, hn::Set(di, 0x7FFFFF))),
                               hn::Set(d, 1.0f / (1 << 23)));
    const VI exponent = hn::Sub(hn::ShiftRight<23>(room_bits), hn::Set(di, 128));
    const V highest = hn::Min(last_level, hn::Add(hn::ConvertTo(d, exponent), fraction));
    const V level = hn::Max(hn::Min(hn::Add(reach_level, hn::Set(d, f.level[i])), highest), zero);
    const VI level0 = hn::ConvertTo(di, level);
    const VI level1 = hn::Min(hn::Add(level0, hn::Set(di, 1)), pyramid.last);
    const V blend = hn::Sub(level, hn::ConvertTo(d, level0));
    VI px0, py0, px1, py1;
    hn::Store(pyramid.template Find<kRotate>(level0, ix, iy, jitter_x, jitter_y, r.max_x, max_y,
                                             &px0, &py0),
              di, block->index[v][i][0]);
    hn::Store(pyramid.template Find<kRotate>(level1, ix, iy, jitter_x, jitter_y, r.max_x, max_y,
                                             &px1, &py1),
              di, block->index[v][i][1]);
    hn::Store(blend, d, block->blend[v][i]);
    if constexpr (kNormals) {
      // The plane under both texels: its depth offset at their centres, and its deviation.
      V mean[2], deviation[2];
      auto never = hn::Lt(one, zero);
      const VI levels[2] = {level0, level1}, px[2] = {px0, px1}, py[2] = {py0, py1};
      for (int k = 0; k < 2; ++k) {
        V kx, ky, q, slope;
        r.Offset(px[k], hn::Sub(py[k], middle), &kx, &ky);
        r.Plane(kx, ky, &q, &slope);
        never = hn::Or(never, hn::Ge(slope, zero));
        const V four = PowerOfTwo(hn::Add(levels[k], levels[k]));
        const V width = hn::Sqrt(hn::Mul(hn::Sub(four, one), hn::Set(d, 1.0f / 3)));
        // In perspective the plane's depth is z facing / slope, and bends: its mean lies deeper by
        // the square of its relative deviation.
        const V offset = hn::Div(hn::Mul(r.distance, q), slope);
        const V relative = hn::Div(hn::Mul(gradient, width), hn::Abs(slope));
        const V plane_depth = f.view.camera.orthographic ? r.distance : hn::Add(r.z, offset);
        deviation[k] = hn::Mul(relative, plane_depth);
        mean[k] = hn::MulAdd(hn::Mul(r.perspective, relative), deviation[k], offset);
      }
      // A plane that a ray does not hit in front of the camera bounds nothing.
      auto mix = [&](V a, V b)
                     HWY_ATTR { return hn::Mul(hn::MulAdd(blend, hn::Sub(b, a), a), per_radius); };
      const V far = hn::Set(d, kMaxOffset);
      hn::Store(hn::IfThenElse(never, far, hn::Min(mix(mean[0], mean[1]), far)), d,
                block->plane[v][i]);
      const V slant = hn::Min(mix(deviation[0], deviation[1]), far);
      hn::Store(hn::IfThenElse(never, hn::Set(d, kLeastDeviation), slant), d, block->slant[v][i]);
    }
    if constexpr (kThickness) {
      V kx, ky;
      r.Offset(ix, hn::Sub(iy, middle), &kx, &ky);
      const V depth = hn::Mul(r.DepthOfThickness(kx, ky, f.thickness), per_radius);
      hn::Store(hn::Min(depth, hn::Set(d, kMaxOffset)), d, block->behind[v][i]);
    }
  }
}

template <class Rho, bool kNormals, bool kThickness>
HWY_INLINE V SumTaps(const AreaFrame& f, V z, int v, const Block<kNormals, kThickness>& block) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), per_radius = hn::Set(d, 1 / f.view.radius);
  const V least = hn::Set(d, kLeastDeviation), far = hn::Set(d, kMaxOffset);
  const VI low = hn::Set(di, 255);
  const float* HWY_RESTRICT base = reinterpret_cast<const float*>(f.texels);
  V open = zero, whole = zero;
  for (int i = 0; i < f.samples; ++i) {
    const Rho rho(f, i);
    const V zs = hn::Set(d, f.extent[i]), half = hn::Set(d, f.half[i]);
    V mean0, bits0, mean1, bits1;
    GatherPairs(d, base, block.index[v][i][0], &mean0, &bits0);
    GatherPairs(d, base, block.index[v][i][1], &mean1, &bits1);
    const V share0 = hn::ConvertTo(d, hn::And(hn::BitCast(di, bits0), low));
    const V share1 = hn::ConvertTo(d, hn::And(hn::BitCast(di, bits1), low));
    // Between the levels, each with its share of surface.
    const V t = hn::Load(d, block.blend[v][i]);
    const V b = hn::Mul(t, share1), a = hn::NegMulAdd(t, share0, share0), sum = hn::Add(a, b);
    const V w = hn::IfThenElseZero(hn::Gt(sum, zero), hn::Div(b, sum));
    const V mean = hn::MulAdd(w, hn::Sub(mean1, mean0), mean0);
    const V deviation = hn::MulAdd(w, hn::Sub(bits1, bits0), bits0);
    const V share = hn::Mul(sum, hn::Set(d, 1.0f / 255));

    V mu = hn::Mul(hn::Sub(mean, z), per_radius);
    mu = hn::Max(hn::Min(mu, far), hn::Neg(far));
    const V sigma = hn::Max(hn::Min(hn::Mul(deviation, per_radius), far), least);
    const V all = hn::Add(half, half);
    V bound = all;
    if constexpr (kNormals) {
      const V slant = hn::Max(hn::Load(d, block.slant[kNormals ? v : 0][i]), least);
      bound = Integral(rho, hn::Load(d, block.plane[kNormals ? v : 0][i]), slant, zs, half);
    }
    V line = hn::Min(Integral(rho, mu, sigma, zs, half), bound);
    if constexpr (kThickness) {
      // And what is free again behind the occluder, section 4.3.
      const V back = hn::Min(hn::Add(mu, hn::Load(d, block.behind[kThickness ? v : 0][i])), far);
      line = hn::Add(line, hn::Sub(bound, hn::Min(Integral(rho, back, sigma, zs, half), bound)));
    }
    // Background occludes nothing.
    line = hn::MulAdd(share, hn::Sub(line, bound), bound);
    const V weight = hn::Set(d, f.weight[i]);
    open = hn::MulAdd(weight, line, open);
    whole = hn::MulAdd(weight, bound, whole);
  }
  if constexpr (kNormals) {
    open = hn::IfThenElse(hn::Gt(whole, zero), hn::Div(open, whole), one);
  }
  return open;
}

template <bool kNormals, bool kRotate, bool kThickness, class Rho>
void Pixels(const AreaFrame& f, int row, int begin, int end, float* HWY_RESTRICT out) {
  const RowLoader loader(f.view, row, end);
  const Pyramid pyramid(f);
  const V zero = hn::Zero(D());
  Block<kNormals, kThickness> block;
  auto find = [&](int i, int v) HWY_ATTR {
    Vec3 n = {zero, zero, zero}, noise = n;
    if constexpr (kNormals) n = loader.Normal(i);
    if constexpr (kRotate) noise = loader.Noise<false>(i);
    const Receivers receivers(f.view, f.view.left + i, loader.y, loader.Depth(i));
    FindTaps<kRotate>(f, pyramid, receivers, n, noise, v, &block);
  };
  auto sum = [&](int i, int v) HWY_ATTR {
    const V z = loader.Depth(i);
    loader.Store(SumTaps<Rho>(f, z, v, block), z, i, out + (i - begin));
  };
  ForBlocks(begin, end, find, sum);
}

template <bool kNormals, bool kRotate>
void PixelsOf(const AreaFrame& f, int row, int begin, int end, float* out) {
  auto run = [&]<bool kThickness>() {
    f.quadratic ? Pixels<kNormals, kRotate, kThickness, QuadraticRho>(f, row, begin, end, out)
                : Pixels<kNormals, kRotate, kThickness, ConstantRho>(f, row, begin, end, out);
  };
  f.thickness > 0 ? run.template operator()<true>() : run.template operator()<false>();
}

void AreaRow(const AreaFrame& f, int row, int begin, int end, float* out) {
  const bool rotate = f.view.noise_x != nullptr;
  if (f.view.normal_x) {
    rotate ? PixelsOf<true, true>(f, row, begin, end, out)
           : PixelsOf<true, false>(f, row, begin, end, out);
  } else {
    rotate ? PixelsOf<false, true>(f, row, begin, end, out)
           : PixelsOf<false, false>(f, row, begin, end, out);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::area
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::area {

HWY_EXPORT(AreaRow);

static void run(const AreaFrame& f, int row, int begin, int end, float* out) {
  HWY_DYNAMIC_DISPATCH(AreaRow)(f, row, begin, end, out);
}

}  // namespace obscura::area

namespace obscura {

void area_row(const AreaFrame& frame, int row, int begin, int end, float* out) {
  area::run(frame, row, begin, end, out);
}

}  // namespace obscura
#endif
