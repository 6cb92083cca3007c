#include "screen/volumetric/point/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/volumetric/point/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "view/taps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "screen/volumetric/point/point_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE
namespace point::HWY_NAMESPACE {

namespace leaf = obscura::HWY_NAMESPACE::leaf;
using namespace obscura::HWY_NAMESPACE::taps;
using obscura::HWY_NAMESPACE::GatherLanes;

HWY_INLINE V Dot(const Vec3& a, const Vec3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
// v - k n
HWY_INLINE Vec3 Minus(const Vec3& v, V k, const Vec3& n) {
  return {hn::NegMulAdd(k, n.x, v.x), hn::NegMulAdd(k, n.y, v.y), hn::NegMulAdd(k, n.z, v.z)};
}

// What is known of each tap before its depth is. A sample is occupied where
//   (t slope - level) slope < 0,
// t being the texel's depth minus the receiver's. With normals the bracket is the difference of the
// heights above the tangent plane of surface and sample; without, slope is -1 and `level` the
// sample's depth offset, negated.
template <bool kPlane, bool kVaries, bool kThickness>
struct Block {
  HWY_ALIGN std::int32_t index[kVectors][kMaxBallSamples][kMaxLanes];
  HWY_ALIGN float level[kVaries ? kVectors : 1][kMaxBallSamples][kMaxLanes];
  HWY_ALIGN float slope[kPlane ? kVectors : 1][kMaxBallSamples][kMaxLanes];
  HWY_ALIGN float behind[kThickness ? kVectors : 1][kMaxBallSamples][kMaxLanes];
};

template <bool kRotate, bool kPlane, bool kVaries, bool kThickness>
HWY_INLINE void FindTaps(const PointFrame& f, Receivers r, Vec3 n, Vec3 noise, int v,
                         Block<kPlane, kVaries, kThickness>* block) {
  const D d;
  const V zero = hn::Zero(d), round = hn::Set(d, kRound), radius = hn::Set(d, f.view.radius);
  if constexpr (kPlane) {
    r.SetNormal(n);
    n = {r.nx, r.ny, r.nz};
  }
  for (int i = 0; i < f.samples; ++i) {
    Vec3 s = {hn::Set(d, f.x[i]), hn::Set(d, f.y[i]), hn::Set(d, f.z[i])};
    if constexpr (kRotate) {
      // Reflected in a random plane through the receiver (Loos and Sloan 2010, section 4.5).
      const V along = Dot(s, noise);
      s = Minus(s, hn::Add(along, along), noise);
    }
    V height = zero;
    if constexpr (kPlane) {
      // And to the front of the tangent plane (Loos and Sloan 2010, section 4.4).
      height = Dot(s, n);
      const V below = hn::Min(height, zero);
      s = Minus(s, hn::Add(below, below), n);
      height = hn::Abs(height);
    }
    const V du = hn::MulAdd(r.reach_x, s.x, round), dv = hn::NegMulAdd(r.reach_y, s.y, round);
    VI ix, iy;
    r.Find(du, dv, &ix, &iy);
    hn::Store(r.Index(ix, iy), DI(), block->index[v][i]);
    if constexpr (kPlane || kThickness) {
      V kx, ky;
      r.Offset(ix, iy, &kx, &ky);
      if constexpr (kPlane) {
        const leaf::TexelPlane plane = leaf::plane_at(r, kx, ky);
        hn::Store(leaf::level_above_plane(r, height, radius, plane.q), d, block->level[v][i]);
        hn::Store(plane.slope, d, block->slope[v][i]);
      }
      if constexpr (kThickness) {
        hn::Store(leaf::thickness_at(r, kx, ky, hn::Set(d, f.thickness)), d, block->behind[v][i]);
      }
    }
    if constexpr (kVaries && !kPlane) hn::Store(hn::Mul(s.z, radius), d, block->level[v][i]);
  }
}

template <bool kPlane, bool kVaries, bool kThickness>
HWY_INLINE V SumTaps(const PointFrame& f, V z, int v,
                     const Block<kPlane, kVaries, kThickness>& block) {
  const D d;
  const V zero = hn::Zero(d);
  const float* HWY_RESTRICT base = Base(f.view);
  V occupied = zero;
  for (int i = 0; i < f.samples; ++i) {
    const V offset = hn::Sub(GatherLanes(d, base, block.index[v][i]), z);
    V level;
    if constexpr (kVaries) {
      level = hn::Load(d, block.level[v][i]);
    } else {
      level = hn::Set(d, f.z[i] * f.view.radius);
    }
    auto in_front = [&](V at) HWY_ATTR {
      if constexpr (kPlane) {
        const V slope = hn::Load(d, block.slope[v][i]);
        return leaf::in_front_by_plane(at, slope, level);
      } else {
        return leaf::in_front_by_depth(at, level);
      }
    };
    auto inside = in_front(offset);
    if constexpr (kThickness) {
      const V back = hn::Add(offset, hn::Load(d, block.behind[v][i]));
      inside = hn::AndNot(in_front(back), inside);
    }
    occupied = hn::Add(occupied, hn::IfThenElseZero(inside, hn::Set(d, f.weight[i])));
  }
  return hn::Sub(hn::Set(d, 1.0f), occupied);
}

template <bool kPlane, bool kRotate, bool kThickness>
void Pixels(const PointFrame& f, int row, int begin, int end, float* HWY_RESTRICT out) {
  const RowLoader loader(f.view, row, end);
  const V zero = hn::Zero(D());
  Block<kPlane, kPlane || kRotate, kThickness> block;
  auto find = [&](int i, int v) HWY_ATTR {
    Vec3 n = {zero, zero, zero}, noise = n;
    if constexpr (kPlane) n = loader.Normal(i);
    if constexpr (kRotate) noise = loader.Noise<true>(i);
    const Receivers receivers(f.view, f.view.left + i, loader.y, loader.Depth(i));
    FindTaps<kRotate>(f, receivers, n, noise, v, &block);
  };
  auto sum = [&](int i, int v) HWY_ATTR {
    const V z = loader.Depth(i);
    loader.Store(SumTaps(f, z, v, block), z, i, out + (i - begin));
  };
  ForBlocks(begin, end, find, sum);
}

void BallRow(const PointFrame& f, int row, int begin, int end, float* out) {
  auto thickness = [&]<bool kPlane, bool kRotate>() {
    f.thickness > 0 ? Pixels<kPlane, kRotate, true>(f, row, begin, end, out)
                    : Pixels<kPlane, kRotate, false>(f, row, begin, end, out);
  };
  auto rotate = [&]<bool kPlane>() {
    f.view.noise_x ? thickness.template operator()<kPlane, true>()
                   : thickness.template operator()<kPlane, false>();
  };
  f.view.normal_x ? rotate.template operator()<true>() : rotate.template operator()<false>();
}

}  // namespace point::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::point {

HWY_EXPORT(BallRow);

static void ball(const PointFrame& f, int row, int begin, int end, float* out) {
  HWY_DYNAMIC_DISPATCH(BallRow)(f, row, begin, end, out);
}

}  // namespace obscura::point

namespace obscura {

void point_ball_row(const PointFrame& frame, int row, int begin, int end, float* out) {
  point::ball(frame, row, begin, end, out);
}

}  // namespace obscura
#endif
