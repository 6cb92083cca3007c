#include "screen/volumetric/point/screen_pattern_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/volumetric/point/screen_pattern_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "view/taps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "screen/volumetric/point/screen_pattern_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace screen_pattern::HWY_NAMESPACE {

using namespace obscura::HWY_NAMESPACE::taps;
namespace om = obscura::HWY_NAMESPACE;

template <bool kPlane, bool kDirections>
void Pixels(const ScreenPatternFrame& f, int row, int width,
            float* const out[interleaved::kChannels]) {
  const D d;
  const RowLoader loader(f.view, row, width);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), round = hn::Set(d, kRound);
  const V per_radius = hn::Set(d, 1 / f.view.radius);
  const float* HWY_RESTRICT base = Base(f.view);
  for (int i = 0; i < width; i += static_cast<int>(hn::Lanes(d))) {
    const V loaded = loader.Depth(i);
    const V z = hn::IfThenElse(hn::Lt(loaded, hn::Inf(d)), loaded, one);
    Receivers r(f.view, f.view.left + i, loader.y, z);
    Vec3 n = {zero, zero, one};
    if constexpr (kPlane) {
      n = loader.Normal(i);
      r.SetNormal(n);
    }
    Vec3 noise = {one, zero, zero};
    if (f.view.noise_x) noise = loader.Noise<false>(i);
    V occupied = zero;
    Vec3 lost = {zero, zero, zero};
    for (int k = 0; k < f.samples; ++k) {
      const V x = hn::Set(d, f.x[k]), y = hn::Set(d, f.y[k]);
      const V sx = hn::MulAdd(noise.x, x, hn::Mul(noise.y, y));
      const V sy = hn::MulSub(noise.y, x, hn::Mul(noise.x, y));
      VI ix, iy;
      r.Find(hn::MulAdd(r.reach_x, sx, round), hn::NegMulAdd(r.reach_y, sy, round), &ix, &iy);
      HWY_ALIGN std::int32_t index[kMaxLanes];
      hn::Store(r.Index(ix, iy), DI(), index);
      V kx, ky;
      r.Offset(ix, iy, &kx, &ky);
      // The background is far enough not to lie in any sphere.
      const V depth = om::GatherLanes(d, base, index);
      const V offset =
          hn::Sub(hn::IfThenElse(hn::Lt(depth, hn::Inf(d)), depth, hn::Set(d, 1e18f)), z);
      const om::leaf::ScreenPoint point = om::leaf::screen_point(
          r, kx, ky, offset, per_radius, hn::Set(d, kAngleGrain * f.view.radius),
          hn::Set(d, f.weight[k]), f.quadratic, kPlane);
      occupied = hn::Add(occupied, point.share);
      if constexpr (kDirections) {
        const V each = hn::Mul(point.share, point.inverse);
        lost.x = hn::MulAdd(each, point.x, lost.x);
        lost.y = hn::MulAdd(each, point.y, lost.y);
        lost.z = hn::MulAdd(each, point.z, lost.z);
      }
    }
    hn::StoreU(hn::Sub(one, occupied), d, out[0] + i);
    if constexpr (kDirections) {
      // mean V w - open n/2 = n/2 - lost - (1 - occupied) n/2
      const V half = hn::Mul(occupied, hn::Set(d, 0.5f));
      hn::StoreU(hn::MulSub(half, n.x, lost.x), d, out[1] + i);
      hn::StoreU(hn::MulSub(half, n.y, lost.y), d, out[2] + i);
      hn::StoreU(hn::MulSub(half, n.z, lost.z), d, out[3] + i);
    }
  }
}

void Row(const ScreenPatternFrame& f, int row, int width,
         float* const out[interleaved::kChannels]) {
  if (out[1]) return Pixels<true, true>(f, row, width, out);
  f.view.normal_x ? Pixels<true, false>(f, row, width, out)
                  : Pixels<false, false>(f, row, width, out);
}

}  // namespace screen_pattern::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::screen_pattern {

HWY_EXPORT(Row);

static void run(const ScreenPatternFrame& f, int row, int width,
                float* const out[interleaved::kChannels]) {
  HWY_DYNAMIC_DISPATCH(Row)(f, row, width, out);
}

}  // namespace obscura::screen_pattern

namespace obscura {

void screen_pattern_row(const ScreenPatternFrame& frame, int row, int width,
                        float* const out[interleaved::kChannels]) {
  screen_pattern::run(frame, row, width, out);
}

}  // namespace obscura
#endif
