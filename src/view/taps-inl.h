// Texels around pixels, for Highway kernels; included once per SIMD target.
#if defined(OBSCURA_SRC_VIEW_TAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_VIEW_TAPS_INL_H_
#undef OBSCURA_SRC_VIEW_TAPS_INL_H_
#else
#define OBSCURA_SRC_VIEW_TAPS_INL_H_
#endif

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "math/leaf-inl.h"
#include "view/tap_frame.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "view/taps_leaf.h"
// After taps_leaf.h.
#include "view/receiver_leaf.h"
}  // namespace leaf

namespace taps {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
constexpr int kMaxLanes = HWY_MAX_BYTES / sizeof(float);

// Kernels work on blocks of a few vectors of pixels. They first compute the indices of all taps,
// then the sums, so that no load has to wait for an index that was stored just before.
constexpr int kVectors = 4;

// Rounds to the nearest integer, ties to even, by adding 1.5 * 2^23 and taking the bits: the
// integer plus kRoundBias, for |v| < 2^22. Rounding to even treats mirror images alike.
constexpr float kRound = 12582912.0f;
constexpr std::int32_t kRoundBias = 0x4B400000;

// Tap indices count from the image's middle row: 65535 rows of 65536 floats just fit 32 bits.
HWY_INLINE const float* Base(const view::TapFrame& f) {
  return f.depth + (f.height / 2) * f.stride;
}

struct Vec3 {
  V x, y, z;
};

HWY_INLINE leaf::TapView ViewOf(const view::TapFrame& f) {
  const D d;
  const Camera& c = f.camera;
  return {hn::Set(d, c.scale_x),
          hn::Set(d, c.scale_y),
          hn::Set(d, c.center_u),
          hn::Set(d, c.center_v),
          hn::Set(d, f.radius / c.scale_x),
          hn::Set(d, f.radius / c.scale_y),
          c.orthographic};
}

// What one vector of pixels has in common for all its taps: view/receiver_leaf.h and indices.
struct Receivers : leaf::TapReceiver {
  // The first pixel is (x, y) of the whole image; z are the depths.
  HWY_INLINE Receivers(const view::TapFrame& f, int x, int y, V depth)
      : TapReceiver(leaf::make_tap_receiver(ViewOf(f), hn::ConvertTo(D(), hn::Iota(DI(), x)),
                                            hn::Set(D(), static_cast<float>(y)), depth)) {
    const DI di;
    column = hn::Iota(di, x);
    const VI bias = hn::Set(di, kRoundBias);
    biased_x = hn::Sub(column, bias);
    row = hn::Set(di, y - f.height / 2);
    biased_y = hn::Sub(row, bias);
    max_x = hn::Set(di, f.width - 1);
    min_y = hn::Set(di, -(f.height / 2));
    max_y = hn::Set(di, f.height - 1 - f.height / 2);
    stride = hn::Set(di, static_cast<std::int32_t>(f.stride));
  }

  HWY_INLINE void SetNormal(const Vec3& n) { leaf::set_tap_normal(n.x, n.y, n.z, *this); }

  // The texel nearest to (du, dv) pixels from the receiver, y down, given with kRound added; or the
  // border's texel where that is outside the image.
  HWY_INLINE void Find(V du, V dv, VI* ix, VI* iy) const {
    const DI di;
    *ix = hn::Min(hn::Max(hn::Add(biased_x, hn::BitCast(di, du)), hn::Zero(di)), max_x);
    *iy = hn::Min(hn::Max(hn::Add(biased_y, hn::BitCast(di, dv)), min_y), max_y);
  }
  HWY_INLINE VI Index(VI ix, VI iy) const { return hn::Add(hn::Mul(iy, stride), ix); }

  // Pixels from the receiver to a texel.
  HWY_INLINE void Offset(VI ix, VI iy, V* kx, V* ky) const {
    const D d;
    *kx = hn::ConvertTo(d, hn::Sub(ix, column));
    *ky = hn::ConvertTo(d, hn::Sub(iy, row));
  }

  VI column, row, biased_x, biased_y, max_x, min_y, max_y, stride;
};

// Loads for pixels [begin, end) of a visible row, in vectors that start at visible column i. Rows
// are padded, so whole vectors may be read; lanes beyond the end are made harmless.
struct RowLoader {
  HWY_INLINE RowLoader(const view::TapFrame& frame, int visible_row, int end_column)
      : f(frame),
        y(frame.top + visible_row),
        end(end_column),
        at(y * frame.stride + frame.left),
        noise_at((visible_row % kNoise) * kNoise) {}

  HWY_INLINE V Depth(int i) const {
    const D d;
    const V z = hn::LoadU(d, f.depth + at + i);
    const int lanes = static_cast<int>(hn::Lanes(d));
    return end - i < lanes ? hn::IfThenElse(hn::FirstN(d, end - i), z, hn::Set(d, 1.0f)) : z;
  }
  HWY_INLINE Vec3 Normal(int i) const {
    const D d;
    return {hn::LoadU(d, f.normal_x + at + i), hn::LoadU(d, f.normal_y + at + i),
            hn::LoadU(d, f.normal_z + at + i)};
  }
  // Random directions of the plane or, with kSpace, of space.
  template <bool kSpace>
  HWY_INLINE Vec3 Noise(int i) const {
    const D d;
    const std::ptrdiff_t k = noise_at + i % kNoise;
    return {hn::Load(d, f.noise_x + k), hn::Load(d, f.noise_y + k),
            kSpace ? hn::Load(d, f.noise_z + k) : hn::Zero(d)};
  }
  // Stores results, as many as there are pixels; 1 on the background.
  HWY_INLINE void Store(V result, V z, int i, float* HWY_RESTRICT out) const {
    const D d;
    const V one = hn::Set(d, 1.0f), inf = hn::Set(d, std::numeric_limits<float>::infinity());
    const V clamped = hn::Min(hn::Max(result, hn::Zero(d)), one);
    const V v = hn::IfThenElse(hn::Lt(z, inf), clamped, one);
    if (end - i >= static_cast<int>(hn::Lanes(d))) {
      hn::StoreU(v, d, out);
    } else {
      HWY_ALIGN float last[kMaxLanes];
      hn::Store(v, d, last);
      std::copy_n(last, end - i, out);
    }
  }

  static constexpr int kNoise = 64;
  const view::TapFrame& f;
  const int y, end;
  const std::ptrdiff_t at, noise_at;
};

// Calls find(i, v) for each vector of a block of pixels, then sum(i, v) for each, block by block;
// i is the visible column of the vector, v its number in the block.
template <class Find, class Sum>
HWY_INLINE void ForBlocks(int begin, int end, Find find, Sum sum) {
  const int lanes = static_cast<int>(hn::Lanes(D()));
  for (int first = begin; first < end; first += kVectors * lanes) {
    const int vectors = std::min(kVectors, (end - first + lanes - 1) / lanes);
    for (int v = 0; v < vectors; ++v) find(first + v * lanes, v);
    for (int v = 0; v < vectors; ++v) sum(first + v * lanes, v);
  }
}

}  // namespace taps
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
