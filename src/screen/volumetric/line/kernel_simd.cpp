#include "screen/volumetric/line/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/volumetric/line/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "screen/volumetric/volumetric-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "screen/volumetric/line/line_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace line::HWY_NAMESPACE {

namespace leaf = obscura::HWY_NAMESPACE::leaf;
using namespace leaf;
using namespace obscura::HWY_NAMESPACE::volumetric;
using obscura::HWY_NAMESPACE::GatherLanes;

// The shader's specialization constant is the class's parameter.
template <class Rho, bool kThickness>
struct OpenLine {
  const Rho& rho;
  LEAF(Real) rho_integral(Real z, Real) { return rho(z); }
#include "screen/volumetric/line/open_line_leaf.h"
};

template <bool kNormals, bool kThickness>
struct Block {
  HWY_ALIGN std::int32_t index[kVectors][kMaxDiskSamples][kMaxLanes];
  // Per tap, in the lines' unit: where the tangent plane bounds the line, and how much deeper than
  // its front the occluder's back lies.
  HWY_ALIGN float plane[kNormals ? kVectors : 1][kMaxDiskSamples][kMaxLanes];
  HWY_ALIGN float behind[kThickness ? kVectors : 1][kMaxDiskSamples][kMaxLanes];
  // Depth of the spheres' centres.
  HWY_ALIGN float center[kVectors][kMaxLanes];
};

// Finds the taps of one vector of pixels.
template <bool kRotate, class Rho, bool kNormals, bool kThickness>
HWY_INLINE void FindTaps(const LineFrame& f, Receivers r, Vec3 n, Vec3 noise, int v,
                         Block<kNormals, kThickness>* block) {
  const D d;
  const V zero = hn::Zero(d), round = hn::Set(d, kRound);
  const V per_unit = hn::Set(d, Rho::kQuadratic ? f.per_unit : 1.0f);
  const V plane_scale = hn::Mul(r.distance, per_unit);
  // The sphere's centre: in pixels from the receiver, and how much nearer, in the lines' unit.
  V center_x = zero, center_y = zero, nearer = zero, center_z = r.z;
  if constexpr (kNormals) {
    r.SetNormal(n);
    if (f.tangent) {
      const V half = hn::Set(d, 0.5f);
      center_x = hn::Mul(hn::Mul(half, r.reach_x), r.nx);
      center_y = hn::Neg(hn::Mul(hn::Mul(half, r.reach_y), r.ny));
      const V lift = hn::Mul(hn::Set(d, 0.5f * f.view.radius), r.nz);
      center_z = hn::Sub(r.z, lift);
      nearer = hn::Mul(lift, per_unit);
    }
  }
  hn::Store(center_z, d, block->center[v]);

  const V xc = hn::Mul(r.reach_x, noise.x), xs = hn::Mul(r.reach_x, noise.y);
  const V yc = hn::Mul(r.reach_y, noise.x), ys = hn::Mul(r.reach_y, noise.y);
  for (int i = 0; i < f.samples; ++i) {
    const V sx = hn::Set(d, f.x[i]), sy = hn::Set(d, f.y[i]);
    // Reflected about a random direction (Loos and Sloan 2010, section 4.5). The integer is rounded
    // to once, at the end.
    V du, dv;
    if constexpr (kRotate || kNormals) {
      du = kRotate ? hn::MulAdd(xc, sx, hn::MulAdd(xs, sy, center_x))
                   : hn::MulAdd(r.reach_x, sx, center_x);
      dv = kRotate ? hn::MulAdd(ys, sx, hn::NegMulAdd(yc, sy, center_y))
                   : hn::MulAdd(r.reach_y, sy, center_y);
      du = hn::Add(du, round);
      dv = hn::Add(dv, round);
    } else {
      du = hn::MulAdd(r.reach_x, sx, round);
      dv = hn::MulAdd(r.reach_y, sy, round);
    }
    VI ix, iy;
    r.Find(du, dv, &ix, &iy);
    hn::Store(r.Index(ix, iy), DI(), block->index[v][i]);
    if constexpr (kNormals || kThickness) {
      V kx, ky;
      r.Offset(ix, iy, &kx, &ky);
      if constexpr (kNormals) {
        const leaf::TexelPlane plane = leaf::plane_at(r, kx, ky);
        const V zs = hn::Set(d, f.extent[i]);
        hn::Store(leaf::plane_bound(hn::Mul(plane_scale, plane.q), plane.slope, nearer, zs), d,
                  block->plane[v][i]);
      }
      if constexpr (kThickness) {
        const V depth = hn::Mul(leaf::thickness_at(r, kx, ky, hn::Set(d, f.thickness)), per_unit);
        hn::Store(hn::Min(depth, hn::Set(d, kMaxThickness)), d, block->behind[v][i]);
      }
    }
  }
}

// V = sum k_i L_i, with k_i L_i in [0, w_i / sum w], over the taps found.
template <class Rho, bool kNormals, bool kThickness>
HWY_INLINE V SumTaps(const LineFrame& f, int v, const Block<kNormals, kThickness>& block) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), per_unit = hn::Set(d, f.per_unit);
  const V center = hn::Load(d, block.center[v]);
  const float* HWY_RESTRICT base = Base(f.view);
  V open = kNormals ? zero : hn::Set(d, 0.5f), whole = zero;
  for (int i = 0; i < f.samples; ++i) {
    const Rho rho(f, i);
    const V zs = hn::Set(d, f.extent[i]);
    const V weight = hn::Set(d, f.weight[i]);
    const V tap = GatherLanes(d, base, block.index[v][i]);
    const V zu = kNormals ? hn::Load(d, block.plane[kNormals ? v : 0][i]) : zs;
    V offset = hn::Sub(tap, center);
    if (Rho::kQuadratic) offset = hn::Mul(offset, per_unit);
    const V behind = kThickness ? hn::Load(d, block.behind[kThickness ? v : 0][i]) : zero;
    // The half from -zs to 0 is in `half`, or, without normals, in the 0.5 above.
    const V line = OpenLine<Rho, kThickness>{rho}.open_line(offset, behind, zu, zs, zero);
    if constexpr (kNormals) {
      const V half = hn::Set(d, f.half[i]);
      open = hn::MulAdd(weight, hn::Add(line, half), open);
      whole = hn::MulAdd(weight, hn::Add(rho(zu), half), whole);
    } else {
      open = hn::MulAdd(weight, line, open);
    }
  }
  if constexpr (kNormals) {
    // Divided by the same samples' own extent in front of the plane, a plane gives exactly 1. If
    // they have none, nothing is known to occlude.
    open = hn::IfThenElse(hn::Gt(whole, zero), hn::Div(open, whole), one);
  }
  return open;
}

template <bool kNormals, bool kRotate, bool kThickness, class Rho>
struct Kernel {
  HWY_INLINE explicit Kernel(const LineFrame& frame) : f(frame) {}
  HWY_INLINE void Find(const Receivers& r, const Vec3& n, const Vec3& noise, int v) {
    FindTaps<kRotate, Rho>(f, r, n, noise, v, &block);
  }
  HWY_INLINE V Sum(V, int v) const { return SumTaps<Rho>(f, v, block); }

  const LineFrame& f;
  Block<kNormals, kThickness> block;
};

void LineRow(const LineFrame& f, int row, int begin, int end, float* out) {
  Row<Kernel>(f, row, begin, end, out);
}

}  // namespace line::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::line {
HWY_EXPORT(LineRow);

static void run(const LineFrame& frame, int row, int begin, int end, float* out) {
  HWY_DYNAMIC_DISPATCH(LineRow)(frame, row, begin, end, out);
}
}  // namespace obscura::line

namespace obscura {

void line_row(const LineFrame& frame, int row, int begin, int end, float* out) {
  line::run(frame, row, begin, end, out);
}

}  // namespace obscura
#endif
