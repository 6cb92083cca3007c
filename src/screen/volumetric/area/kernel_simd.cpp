#include "screen/volumetric/area/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/volumetric/area/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "screen/volumetric/volumetric-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "screen/volumetric/area/area_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace area::HWY_NAMESPACE {

namespace leaf = obscura::HWY_NAMESPACE::leaf;
using namespace leaf;
using namespace obscura::HWY_NAMESPACE::volumetric;
using obscura::HWY_NAMESPACE::GatherQuads;

// The shader's specialization constants are the class's parameters.
HWY_INLINE V LateralOf(const ConstantRho&) { return hn::Zero(D()); }
HWY_INLINE V LateralOf(const QuadraticRho& rho) { return rho.lateral; }
template <class Rho, bool kNormals, bool kThickness>
struct Sample {
  static constexpr bool kQuadratic = Rho::kQuadratic;
  const Rho& rho;

  LEAF(Real) rho_integral(Real z, Real) { return rho(z); }
#include "screen/volumetric/area/sample_leaf.h"
};

template <bool kNormals, bool kThickness>
struct Block {
  // Each sample's texel, and how far its second level counts.
  HWY_ALIGN std::int32_t index[kVectors][kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float blend[kVectors][kMaxAreaSamples][kMaxLanes];
  // In radii: the tangent plane's mean and deviation under the kernel, and the thickness in depth.
  HWY_ALIGN float plane[kNormals ? kVectors : 1][kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float slant[kNormals ? kVectors : 1][kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float behind[kThickness ? kVectors : 1][kMaxAreaSamples][kMaxLanes];
};

// table[level] of each lane: within a register where it holds the whole table.
template <class VT, class T>
HWY_INLINE VT LookUp(const T* HWY_RESTRICT table, VI level) {
  const hn::DFromV<VT> d;
#if HWY_TARGET == HWY_AVX3
  static_assert(MomentPyramid::kMaxLevels < kMaxLanes);
  return hn::TableLookupLanes(hn::LoadU(d, table), hn::IndicesFromVec(d, level));
#else
  HWY_ALIGN std::int32_t lanes[kMaxLanes];
  HWY_ALIGN T values[kMaxLanes];
  hn::Store(level, DI(), lanes);
  for (size_t i = 0; i < hn::Lanes(d); ++i) values[i] = table[lanes[i]];
  return hn::Load(d, values);
#endif
}

// The pyramid as the kernel addresses it.
struct Pyramid {
  HWY_INLINE explicit Pyramid(const AreaFrame& f)
      : start(f.start), last(hn::Set(DI(), f.columns - 1)) {}

  // The texel of `level` nearest to pixel (ix, iy), and the pixel at its centre. With jitter in
  // [-1/2, 1/2) of a texel, any of the four around, each as often as bilinear interpolation would
  // weigh it. All four lie in the image, for the level's kernel does.
  template <bool kJitter>
  HWY_INLINE VI Find(VI level, VI ix, VI iy, V jitter_x, V jitter_y, VI* px, VI* py) const {
    const D d;
    const DI di;
    const VI shift =
        hn::Max(hn::Sub(level, hn::Set(di, MomentPyramid::kFullLevels - 1)), hn::Zero(di));
    const VI bit = hn::Shl(hn::Set(di, 1), shift);
    VI half = hn::ShiftRight<1>(bit);
    if constexpr (kJitter) {
      const V width = hn::ConvertTo(d, bit), round = hn::Set(d, kRound);
      half = hn::Sub(half, hn::Set(di, kRoundBias));
      ix = hn::Add(ix, hn::BitCast(di, hn::MulAdd(jitter_x, width, round)));
      iy = hn::Add(iy, hn::BitCast(di, hn::MulAdd(jitter_y, width, round)));
    }
    const VI tx = hn::Shr(hn::Add(ix, half), shift), ty = hn::Shr(hn::Add(iy, half), shift);
    *px = hn::Shl(tx, shift);
    *py = hn::Shl(ty, shift);
    // MomentPyramid::row_stride.
    const VI stride = hn::Add(hn::Shr(last, shift), hn::Set(di, 2));
    return hn::Add(hn::Add(LookUp<VI>(start, level), tx), hn::Mul(ty, stride));
  }

  const std::int32_t* start;
  VI last;  // column
};

// Which levels of the pyramid a vector's samples see.
struct Levels {
  HWY_INLINE Levels(const AreaFrame& f, const Receivers& r)
      : middle(hn::Set(DI(), f.view.height / 2)),
        max_y(hn::Set(DI(), f.view.height - 1)),
        last(hn::Set(D(), static_cast<float>(f.levels) - 1.5f)) {
    const D d;
    // One logarithm per pixel: of the radius in pixels.
    const V least = hn::Set(d, 1e-3f);
    const V area = hn::Mul(hn::Max(r.reach_x, least), hn::Max(r.reach_y, least));
    reach = hn::MulSub(hn::Set(d, 0.5f), hn::Log2(d, area), hn::Set(d, 0.5f));
  }

  // The finer of the two levels that a sample of level `sample` of the sphere's sees at pixel
  // (ix, iy), `horizon` pixels from that of the tangent plane, and how far the coarser counts.
  HWY_INLINE VI Find(const Receivers& r, VI ix, VI iy, float sample, V horizon, V* blend) const {
    const D d;
    const V half = hn::Set(d, 0.5f), round = hn::Set(d, kRound);
    const VI room_x = hn::Min(ix, hn::Sub(r.max_x, ix)), room_y = hn::Min(iy, hn::Sub(max_y, iy));
    const V room = hn::ConvertTo(d, hn::Min(room_x, room_y));
    const V level = leaf::level_of_sample(reach, hn::Set(d, sample), room, horizon, last);
    const V rounded = hn::Add(level, round);
    *blend = hn::Add(hn::Sub(level, hn::Sub(rounded, round)), half);
    return hn::Sub(hn::BitCast(DI(), rounded), hn::Set(DI(), kRoundBias));
  }

  VI middle, max_y;
  V last, reach;
};

// The tangent plane under a sample's kernel: its mean depth offset and its deviation, in radii.
struct PlaneUnderKernel {
  HWY_INLINE PlaneUnderKernel(const AreaFrame& frame, const Receivers& r)
      : f(frame),
        per_radius(hn::Set(D(), 1 / f.view.radius)),
        // How much n.r' changes per pixel along its steepest direction.
        gradient(hn::Sqrt(hn::MulAdd(r.plane_x, r.plane_x, hn::Mul(r.plane_y, r.plane_y)))),
        per_slope(leaf::horizon_per_slope(gradient, r.perspective)) {}

  // How far a kernel may reach around the texel (kx, ky) pixels from the receiver.
  HWY_INLINE V Horizon(const Receivers& r, V kx, V ky) const {
    return hn::Mul(leaf::plane_at(r, kx, ky).slope, per_slope);
  }

  // Under the kernel between levels `level` and level + 1, (kx, ky) pixels from the receiver.
  HWY_INLINE leaf::PlaneMoments Moments(const Receivers& r, VI level, V blend, V kx, V ky) const {
    const leaf::TexelPlane p = leaf::plane_at(r, kx, ky);
    return leaf::plane_moments(p.q, p.slope, gradient, r.distance, r.perspective,
                               LookUp<V>(f.width, level), LookUp<V>(f.width + 1, level), blend,
                               per_radius);
  }

  const AreaFrame& f;
  V per_radius, gradient, per_slope;
};

template <bool kRotate, bool kNormals, bool kThickness>
HWY_INLINE void FindTaps(const AreaFrame& f, Receivers r, Vec3 n, Vec3 noise, int v,
                         Block<kNormals, kThickness>* block) {
  const D d;
  const V zero = hn::Zero(d), round = hn::Set(d, kRound);
  const Pyramid pyramid(f);
  if constexpr (kNormals) r.SetNormal(n);
  const PlaneUnderKernel plane(f, r);
  const Levels levels(f, r);
  const V xc = hn::Mul(r.reach_x, noise.x), xs = hn::Mul(r.reach_x, noise.y);
  const V yc = hn::Mul(r.reach_y, noise.x), ys = hn::Mul(r.reach_y, noise.y);
  // Digits of the random directions that reflection does not notice.
  auto digits = [&](V u) HWY_ATTR {
    const V w = hn::Mul(u, hn::Set(d, 64.0f));
    return hn::Sub(w, hn::Round(w));
  };
  const V jitter_x = kRotate ? digits(noise.x) : zero, jitter_y = kRotate ? digits(noise.y) : zero;
  for (int i = 0; i < f.samples; ++i) {
    const V sx = hn::Set(d, f.x[i]), sy = hn::Set(d, f.y[i]);
    const V du = kRotate ? hn::MulAdd(xc, sx, hn::Mul(xs, sy)) : hn::Mul(r.reach_x, sx);
    const V dv = kRotate ? hn::MulSub(ys, sx, hn::Mul(yc, sy)) : hn::Mul(r.reach_y, sy);
    VI ix, iy;
    r.Find(hn::Add(du, round), hn::Add(dv, round), &ix, &iy);
    iy = hn::Add(iy, levels.middle);
    V blend, kx, ky, horizon = hn::Inf(d);
    VI px, py;
    if constexpr (kNormals) {
      r.Offset(ix, hn::Sub(iy, levels.middle), &kx, &ky);
      horizon = plane.Horizon(r, kx, ky);
    }
    const VI level = levels.Find(r, ix, iy, f.level[i], horizon, &blend);
    const VI index = pyramid.template Find<kRotate>(level, ix, iy, jitter_x, jitter_y, &px, &py);
    hn::Store(index, DI(), block->index[v][i]);
    hn::Store(blend, d, block->blend[v][i]);
    if constexpr (kNormals) {
      r.Offset(px, hn::Sub(py, levels.middle), &kx, &ky);
      const leaf::PlaneMoments moments = plane.Moments(r, level, blend, kx, ky);
      hn::Store(moments.mean, d, block->plane[v][i]);
      hn::Store(moments.deviation, d, block->slant[v][i]);
    }
    if constexpr (kThickness) {
      r.Offset(ix, hn::Sub(iy, levels.middle), &kx, &ky);
      const V depth =
          hn::Mul(leaf::thickness_at(r, kx, ky, hn::Set(d, f.thickness)), plane.per_radius);
      hn::Store(hn::Min(depth, hn::Set(d, kMaxOffset)), d, block->behind[v][i]);
    }
  }
}

// What the pyramid says under each sample of a vector of pixels: mean depth offset and deviation,
// in radii, and the share of surface.
struct Moments {
  HWY_ALIGN float mu[kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float sigma[kMaxAreaSamples][kMaxLanes];
  HWY_ALIGN float share[kMaxAreaSamples][kMaxLanes];
};

template <class Block>
HWY_INLINE void Fetch(const AreaFrame& f, V z, int v, const Block& block, Moments* moments) {
  const D d;
  const DI di;
  const V per_radius = hn::Set(d, 1 / f.view.radius);
  const float* HWY_RESTRICT base = reinterpret_cast<const float*>(f.texels);
  for (int i = 0; i < f.samples; ++i) {
    V texel[4];  // the means, then the deviations of two levels
    GatherQuads(d, base, block.index[v][i], texel);
    const V blend = hn::Load(d, block.blend[v][i]);
    auto mix = [&](V a, V b) HWY_ATTR { return hn::MulAdd(blend, hn::Sub(b, a), a); };
    auto share_of = [&](V bits) HWY_ATTR {
      return hn::ConvertTo(d, hn::And(hn::BitCast(di, bits), hn::Set(di, 255)));
    };
    const V mu = hn::Mul(hn::Sub(mix(texel[0], texel[1]), z), per_radius);
    const V sigma = hn::Mul(mix(texel[2], texel[3]), per_radius);
    const V share = mix(share_of(texel[2]), share_of(texel[3]));
    hn::Store(leaf::bounded_mean(mu), d, moments->mu[i]);
    hn::Store(leaf::bounded_deviation(sigma), d, moments->sigma[i]);
    hn::Store(hn::Mul(share, hn::Set(d, 1.0f / 255)), d, moments->share[i]);
  }
}

// Fetches all before it adds up: a sample is a long chain of instructions that wait for each other,
// and in shorter loops those of more samples overlap.
template <class Rho, bool kNormals, bool kThickness>
HWY_INLINE V SumTaps(const AreaFrame& f, V z, int v, const Block<kNormals, kThickness>& block) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  Moments moments;
  Fetch(f, z, v, block, &moments);
  V open = zero, whole = zero;
  for (int i = 0; i < f.samples; ++i) {
    const Rho rho(f, i);
    const V zs = hn::Set(d, f.extent[i]), half = hn::Set(d, f.half[i]);
    const V mu = hn::Load(d, moments.mu[i]), sigma = hn::Load(d, moments.sigma[i]);
    leaf::PlaneMoments plane{zero, zero};
    if constexpr (kNormals) {
      plane = {hn::Load(d, block.plane[v][i]), hn::Load(d, block.slant[v][i])};
    }
    V behind = zero;
    if constexpr (kThickness) behind = hn::Load(d, block.behind[v][i]);
    const leaf::SampleLine line = Sample<Rho, kNormals, kThickness>{rho}.sample_line(
        mu, sigma, hn::Load(d, moments.share[i]), plane, behind, zs, half, LateralOf(rho));
    const V weight = hn::Set(d, f.weight[i]);
    open = hn::MulAdd(weight, line.open, open);
    if constexpr (kNormals) whole = hn::MulAdd(weight, line.bound, whole);
  }
  if constexpr (kNormals) {
    open = hn::IfThenElse(hn::Gt(whole, zero), hn::Div(open, whole), one);
  }
  return open;
}

template <bool kNormals, bool kRotate, bool kThickness, class Rho>
struct Kernel {
  HWY_INLINE explicit Kernel(const AreaFrame& frame) : f(frame) {}
  HWY_INLINE void Find(const Receivers& r, const Vec3& n, const Vec3& noise, int v) {
    FindTaps<kRotate>(f, r, n, noise, v, &block);
  }
  HWY_INLINE V Sum(V z, int v) const { return SumTaps<Rho>(f, z, v, block); }

  const AreaFrame& f;
  Block<kNormals, kThickness> block;
};

void AreaRow(const AreaFrame& f, int row, int begin, int end, float* out) {
  Row<Kernel>(f, row, begin, end, out);
}

}  // namespace area::HWY_NAMESPACE
}  // namespace obscura
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
