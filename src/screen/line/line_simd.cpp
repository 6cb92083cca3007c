#include <algorithm>
#include <limits>

#include "screen/line/line_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/line/line_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
constexpr int kMaxLanes = HWY_MAX_BYTES / sizeof(float);

// A tap can lie this many pixels away, more than any image is wide; it keeps coordinates finite.
constexpr float kMaxReach = 131072.0f;
// Normals that turn away from the camera more than this (times the ray's length) are bent back to
// it: a visible surface cannot face away, but an interpolated normal can.
constexpr float kEdgeOn = -1e-4f;
constexpr float kMaxThickness = 1e30f;  // in the lines' unit

// Integral of rho along a sample's line from the sphere's middle to depth offset z, |z| <= zs.
struct ConstantRho {
  static constexpr bool kUnit = false;  // lengths in world units
  ConstantRho(const LineFrame&, int) {}
  HWY_INLINE V operator()(V z) const { return z; }
};
struct QuadraticRho {
  static constexpr bool kUnit = true;  // lengths in radii
  QuadraticRho(const LineFrame& f, int i) : lateral(std::max(f.lateral[i], 1e-6f)) {}
  // As math::quadratic_line; asinh by the logarithm of |z|, for it is odd.
  HWY_INLINE V operator()(V z) const {
    const D d;
    const V l = hn::Set(d, lateral), square = hn::Mul(l, l), one = hn::Set(d, 1.0f);
    const V a = hn::Abs(z), a2 = hn::Mul(a, a);
    const V s = hn::Sqrt(hn::Add(square, a2));
    const V asinh = hn::Log(d, hn::Div(hn::Add(a, s), l));
    const V polynomial = hn::MulAdd(a2, hn::Set(d, 1.0f / 3), hn::Sub(hn::Add(one, square), s));
    return hn::CopySign(hn::NegMulAdd(square, asinh, hn::Mul(a, polynomial)), z);
  }
  float lateral;
};

// What is the same for all pixels of a row.
struct Row {
  Row(const LineFrame& f, int y)
      : middle(f.depth + (f.height / 2) * f.stride),
        y_from_middle(y - f.height / 2),
        ray_y((f.center_v - (y + 0.5f)) * f.scale_y) {}
  // Taps are indexed from the image's middle row: 65535 rows of 65536 floats just fit 32 bits.
  const float* middle;
  int y_from_middle;
  float ray_y;
};

// Pixels go through the kernel in blocks of a few vectors: first all their taps' indices, then all
// their sums. No load then waits for the index that was stored just before it.
constexpr int kVectors = 4;
template <bool kNormals, bool kThickness>
struct Block {
  HWY_ALIGN std::int32_t index[kVectors][kMaxLineSamples][kMaxLanes];
  // Per tap, in the lines' unit: where the tangent plane bounds the line, and how much deeper than
  // its front the occluder's back lies.
  HWY_ALIGN float plane[kNormals ? kVectors : 1][kMaxLineSamples][kMaxLanes];
  HWY_ALIGN float behind[kThickness ? kVectors : 1][kMaxLineSamples][kMaxLanes];
};

// Rounds to the nearest integer, ties to even, by adding 1.5 * 2^23 and taking the bits: the
// integer plus kRoundBias, for |v| < 2^22.
constexpr float kRound = 12582912.0f;
constexpr std::int32_t kRoundBias = 0x4B400000;

// Finds the taps of one vector of pixels, the first of which is pixel (x, row).
template <bool kRotate, class Rho, bool kNormals, bool kThickness>
HWY_INLINE void FindTaps(const LineFrame& f, const Row& row, int x, int at, V z, V nx, V ny, V nz,
                         V cosine, V sine, Block<kNormals, kThickness>* block) {
  const D d;
  const DI di;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V perspective = hn::Set(d, f.orthographic ? 0.0f : 1.0f);
  const V distance = f.orthographic ? one : z;
  const V max_reach = hn::Set(d, kMaxReach);
  const V reach_x = hn::Min(hn::Div(hn::Set(d, f.radius / f.scale_x), distance), max_reach);
  const V reach_y = hn::Min(hn::Div(hn::Set(d, f.radius / f.scale_y), distance), max_reach);
  const V xc = hn::Mul(reach_x, cosine), xs = hn::Mul(reach_x, sine);
  const V yc = hn::Mul(reach_y, cosine), ys = hn::Mul(reach_y, sine);

  const VI vx = hn::Iota(di, x), vy = hn::Set(di, row.y_from_middle);
  const VI bias = hn::Set(di, kRoundBias);
  const VI biased_x = hn::Sub(vx, bias), biased_y = hn::Sub(vy, bias);
  const VI max_x = hn::Set(di, f.width - 1);
  const VI min_y = hn::Set(di, -(f.height / 2)), max_y = hn::Set(di, f.height - 1 - f.height / 2);
  const VI stride = hn::Set(di, static_cast<std::int32_t>(f.stride));
  const V round = hn::Set(d, kRound);

  // The receiver's ray (a, b, -1), or (0, 0, -1) where rays are parallel.
  const V scale_x = hn::Set(d, f.scale_x), scale_y = hn::Set(d, f.scale_y);
  const V a = hn::Mul(
      perspective, hn::Mul(scale_x, hn::Sub(hn::ConvertTo(d, vx), hn::Set(d, f.center_u - 0.5f))));
  const V b = hn::Mul(perspective, hn::Set(d, row.ray_y));
  const V ray_x = hn::Mul(perspective, scale_x), ray_y = hn::Mul(perspective, scale_y);
  V facing = zero;  // n.r < 0
  if constexpr (kNormals) {
    const V limit = hn::Set(d, kEdgeOn);
    facing = hn::MulAdd(nx, a, hn::MulSub(ny, b, nz));
    const V excess = hn::Max(hn::Sub(facing, limit), zero);
    const V bend = hn::Div(excess, hn::MulAdd(a, a, hn::MulAdd(b, b, one)));
    nx = hn::NegMulAdd(bend, a, nx);
    ny = hn::NegMulAdd(bend, b, ny);
    facing = hn::Min(facing, limit);
  }
  const V plane_x = hn::Mul(nx, scale_x), plane_y = hn::Mul(ny, scale_y);
  const V to_unit = Rho::kUnit ? hn::Set(d, 1 / f.radius) : one;
  const V plane_scale = hn::Mul(distance, to_unit);

  for (int i = 0; i < f.samples; ++i) {
    const V sx = hn::Set(d, f.x[i]), sy = hn::Set(d, f.y[i]);
    // Reflected about a random direction (section 4.5).
    const V du = kRotate ? hn::Add(hn::MulAdd(xc, sx, hn::Mul(xs, sy)), round)
                         : hn::MulAdd(reach_x, sx, round);
    const V dv = kRotate ? hn::Add(hn::MulSub(ys, sx, hn::Mul(yc, sy)), round)
                         : hn::MulAdd(reach_y, sy, round);
    // The nearest texel; rounding to even treats mirror images alike. Outside, the edge's.
    const VI ix = hn::Min(hn::Max(hn::Add(biased_x, hn::BitCast(di, du)), hn::Zero(di)), max_x);
    const VI iy = hn::Min(hn::Max(hn::Add(biased_y, hn::BitCast(di, dv)), min_y), max_y);
    hn::Store(hn::Add(hn::Mul(iy, stride), ix), di, block->index[at][i]);
    if constexpr (kNormals || kThickness) {
      const V kx = hn::ConvertTo(d, hn::Sub(ix, vx)), ky = hn::ConvertTo(d, hn::Sub(iy, vy));
      if constexpr (kNormals) {
        // Depth offset of the tangent plane on the fetched texel's ray r' = (a', b', -1), from
        // q = n.(r - r'): t - z = z q / (n.r - q), or q / n.r if orthographic. A plane that the
        // ray does not hit in front of the camera bounds nothing.
        const V q = hn::MulSub(plane_y, ky, hn::Mul(plane_x, kx));
        const V divisor = hn::NegMulAdd(perspective, q, facing);
        const V offset = hn::Div(hn::Mul(plane_scale, q), divisor);
        const V zs = hn::Set(d, f.extent[i]);
        const V bounded = hn::Max(hn::Min(offset, zs), hn::Neg(zs));
        hn::Store(hn::IfThenElse(hn::Lt(divisor, zero), bounded, zs), d, block->plane[at][i]);
      }
      if constexpr (kThickness) {
        // Thickness counts along the fetched texel's ray.
        const V ta = hn::MulAdd(kx, ray_x, a), tb = hn::NegMulAdd(ky, ray_y, b);
        const V length = hn::Sqrt(hn::MulAdd(ta, ta, hn::MulAdd(tb, tb, one)));
        const V depth = hn::Mul(hn::Div(hn::Set(d, f.thickness), length), to_unit);
        hn::Store(hn::Min(depth, hn::Set(d, kMaxThickness)), d, block->behind[at][i]);
      }
    }
  }
}

// V = sum k_i L_i, with k_i L_i in [0, w_i / sum w], over the taps found.
template <class Rho, bool kNormals, bool kThickness>
HWY_INLINE V SumTaps(const LineFrame& f, const Row& row, V z, int at,
                     const Block<kNormals, kThickness>& block) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V per_radius = hn::Set(d, 1 / f.radius);
  V open = kNormals ? zero : hn::Set(d, 0.5f), whole = zero;
  for (int i = 0; i < f.samples; ++i) {
    const Rho rho(f, i);
    const V zs = hn::Set(d, f.extent[i]), minus_zs = hn::Neg(zs);
    const V weight = hn::Set(d, f.weight[i]);
    const V tap = GatherLanes(d, row.middle, block.index[at][i]);
    const V zu = kNormals ? hn::Load(d, block.plane[kNormals ? at : 0][i]) : zs;
    V offset = hn::Sub(tap, z);
    if (Rho::kUnit) offset = hn::Mul(offset, per_radius);
    // L = max(min(zs, d, zp) + zs, 0), section 4.1; the half from -zs to 0 is in `half`, or,
    // without normals, in the 0.5 above.
    V line = rho(hn::Max(hn::Min(offset, zu), minus_zs));
    if constexpr (kThickness) {
      // And what is free again behind the occluder, section 4.3.
      const V back = hn::Add(offset, hn::Load(d, block.behind[kThickness ? at : 0][i]));
      line = hn::Add(line, hn::Sub(rho(zu), rho(hn::Max(hn::Min(back, zu), minus_zs))));
    }
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
  const V result = hn::Min(hn::Max(open, zero), one);
  return hn::IfThenElse(hn::Lt(z, hn::Set(d, std::numeric_limits<float>::infinity())), result, one);
}

template <bool kNormals, bool kRotate, bool kThickness, class Rho>
void Pixels(const LineFrame& f, int visible_row, int begin, int end, float* HWY_RESTRICT out) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int y = f.top + visible_row;
  const Row row(f, y);
  const std::ptrdiff_t row_at = y * f.stride;
  const std::ptrdiff_t noise_at = (visible_row % kNoiseSize) * kNoiseSize;
  Block<kNormals, kThickness> block;
  // Rows are padded, so whole vectors may be read; lanes beyond the end are made harmless.
  auto depths = [&](int i) HWY_ATTR {
    const V z = hn::LoadU(d, f.depth + row_at + f.left + i);
    return end - i < lanes ? hn::IfThenElse(hn::FirstN(d, end - i), z, hn::Set(d, 1.0f)) : z;
  };
  for (int first = begin; first < end; first += kVectors * lanes) {
    const int vectors = std::min(kVectors, (end - first + lanes - 1) / lanes);
    for (int v = 0; v < vectors; ++v) {
      const int i = first + v * lanes, x = f.left + i;
      V nx = hn::Zero(d), ny = nx, nz = nx, cosine = nx, sine = nx;
      if constexpr (kNormals) {
        nx = hn::LoadU(d, f.normal_x + row_at + x);
        ny = hn::LoadU(d, f.normal_y + row_at + x);
        nz = hn::LoadU(d, f.normal_z + row_at + x);
      }
      if constexpr (kRotate) {
        cosine = hn::Load(d, f.noise_cos + noise_at + i % kNoiseSize);
        sine = hn::Load(d, f.noise_sin + noise_at + i % kNoiseSize);
      }
      FindTaps<kRotate, Rho>(f, row, x, v, depths(i), nx, ny, nz, cosine, sine, &block);
    }
    for (int v = 0; v < vectors; ++v) {
      const int i = first + v * lanes;
      const V result = SumTaps<Rho>(f, row, depths(i), v, block);
      if (end - i >= lanes) {
        hn::StoreU(result, d, out + (i - begin));
      } else {
        HWY_ALIGN float last[kMaxLanes];
        hn::Store(result, d, last);
        std::copy_n(last, end - i, out + (i - begin));
      }
    }
  }
}

template <bool kNormals, bool kRotate>
void PixelsOf(const LineFrame& f, int row, int begin, int end, float* out) {
  auto run = [&]<bool kThickness>() {
    f.quadratic ? Pixels<kNormals, kRotate, kThickness, QuadraticRho>(f, row, begin, end, out)
                : Pixels<kNormals, kRotate, kThickness, ConstantRho>(f, row, begin, end, out);
  };
  f.thickness > 0 ? run.template operator()<true>() : run.template operator()<false>();
}

void LineRow(const LineFrame& f, int row, int begin, int end, float* out) {
  const bool rotate = f.noise_cos != nullptr;
  if (f.normal_x) {
    rotate ? PixelsOf<true, true>(f, row, begin, end, out)
           : PixelsOf<true, false>(f, row, begin, end, out);
  } else {
    rotate ? PixelsOf<false, true>(f, row, begin, end, out)
           : PixelsOf<false, false>(f, row, begin, end, out);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {

HWY_EXPORT(LineRow);

void line_row(const LineFrame& frame, int row, int begin, int end, float* out) {
  HWY_DYNAMIC_DISPATCH(LineRow)(frame, row, begin, end, out);
}

}  // namespace obscura
#endif
