#include <limits>

#include "filters/interleaved/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filters/interleaved/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "filters/edge_leaf.h"
#include "math/cone_leaf.h"
}  // namespace leaf

namespace {

namespace hn = hwy::HWY_NAMESPACE;
using interleaved::BlurRow;
using interleaved::Finish;
using interleaved::kChannels;
using interleaved::Results;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr float kInf = std::numeric_limits<float>::infinity();

struct Vector {
  V x, y, z;
};

HWY_INLINE M IsSurface(V s) {
  const D d;
  return hn::And(hn::Gt(s, hn::Zero(d)), hn::Lt(s, hn::Set(d, kInf)));
}

// As the one-channel blur of filters/, with normals: taps count by how near their surface lies to
// the continuation of the receiver's, and by how alike the normals are.
template <int kCount>
void BlurPixels(const BlurRow& row, int width) {
  const D d;
  const V inf = hn::Set(d, kInf);
  const int lanes = static_cast<int>(hn::Lanes(d));
  const bool before_inside = row.first_tap < 0;
  const bool after_inside = row.last_tap > 0;
  for (int x = 0; x < width; x += lanes) {
    const float* surface = row.surface + x;
    const V s0 = hn::LoadU(d, surface);
    auto difference = [&](bool inside, std::ptrdiff_t step, float sign) HWY_ATTR {
      if (!inside) return inf;
      const V s = hn::LoadU(d, surface + step);
      return hn::IfThenElse(IsSurface(s), hn::Mul(hn::Sub(s, s0), hn::Set(d, sign)), inf);
    };
    const V after = difference(after_inside, row.surface_step, 1.0f);
    const V before = difference(before_inside, -row.surface_step, -1.0f);
    const V slope = leaf::surface_slope(after, before);
    const V inverse_edge =
        leaf::inverse_of_edge(hn::Set(d, 1 / row.edge), hn::Max(s0, hn::Set(d, 1e-30f)),
                              hn::Set(d, row.edges_per_depth), row.orthographic);
    const V per_edge = leaf::edges_per_unit(s0, inverse_edge, row.orthographic);
    const V nx = hn::LoadU(d, row.normal[0] + x), ny = hn::LoadU(d, row.normal[1] + x);
    const V nz = hn::LoadU(d, row.normal[2] + x);

    V sum[kCount], weight_sum = hn::Set(d, row.weights[0]);
    for (int c = 0; c < kCount; ++c) sum[c] = hn::Mul(weight_sum, hn::LoadU(d, row.values[c] + x));
    for (int k = row.first_tap; k <= row.last_tap; ++k) {
      if (k == 0) continue;
      const V s = hn::LoadU(d, surface + k * row.surface_step);
      const V gap = leaf::gap_to_surface(s, s0, slope, hn::Set(d, static_cast<float>(k)), per_edge);
      const std::ptrdiff_t at = x + k * row.normal_step;
      const V alike = hn::MulAdd(nx, hn::LoadU(d, row.normal[0] + at),
                                 hn::MulAdd(ny, hn::LoadU(d, row.normal[1] + at),
                                            hn::Mul(nz, hn::LoadU(d, row.normal[2] + at))));
      const V w = hn::IfThenElseZero(
          IsSurface(s),
          hn::Mul(leaf::weight_of_tap(gap, alike), hn::Set(d, row.weights[k < 0 ? -k : k])));
      weight_sum = hn::Add(weight_sum, w);
      for (int c = 0; c < kCount; ++c) {
        sum[c] = hn::MulAdd(w, hn::LoadU(d, row.values[c] + x + k * row.value_step), sum[c]);
      }
    }
    const V scale = FastReciprocal(d, weight_sum);
    for (int c = 0; c < kCount; ++c) hn::StoreU(hn::Mul(sum[c], scale), d, row.out[c] + x);
  }
}

void Blur(const BlurRow& row, int width) {
  row.channels == 1 ? BlurPixels<1>(row, width) : BlurPixels<kChannels>(row, width);
}

HWY_INLINE Vector Rebuild(const float* const sums[kChannels], V open, const Vector& n,
                          float of_normal, int x) {
  const D d;
  const V along = hn::Mul(open, hn::Set(d, of_normal));
  return {hn::MulAdd(along, n.x, hn::LoadU(d, sums[1] + x)),
          hn::MulAdd(along, n.y, hn::LoadU(d, sums[2] + x)),
          hn::MulAdd(along, n.z, hn::LoadU(d, sums[3] + x))};
}

HWY_INLINE void StoreVector(const Vector& v, float* const to[3], int x) {
  const D d;
  if (!to[0]) return;
  hn::StoreU(v.x, d, to[0] + x);
  hn::StoreU(v.y, d, to[1] + x);
  hn::StoreU(v.z, d, to[2] + x);
}

HWY_INLINE void StoreVisibility(V v, float* to, int x) {
  const D d;
  if (to) hn::StoreU(hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f)), d, to + x);
}

void FinishUniform(const Finish& finish, const float* const sums[kChannels],
                   const float* const normal[3], int width, const Results& out) {
  const D d;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const V visible = hn::LoadU(d, sums[0] + x);
    StoreVisibility(visible, out.visibility, x);
    if (!sums[1]) continue;
    const Vector n{hn::LoadU(d, normal[0] + x), hn::LoadU(d, normal[1] + x),
                   hn::LoadU(d, normal[2] + x)};
    V open = visible;
    if (finish.cosine_open) {
      const V along = hn::MulAdd(
          n.x, hn::LoadU(d, sums[1] + x),
          hn::MulAdd(n.y, hn::LoadU(d, sums[2] + x), hn::Mul(n.z, hn::LoadU(d, sums[3] + x))));
      open = leaf::uniform_open(visible, along);
    }
    const Vector s = Rebuild(sums, open, n, 0.5f, x);
    // 1/pi integral of V w = 2 mean V w.
    const V two = hn::Set(d, 2.0f);
    const Vector integral{hn::Mul(two, s.x), hn::Mul(two, s.y), hn::Mul(two, s.z)};
    const leaf::BentCone cone = leaf::bent_cone(finish.paper_cone, integral.x, integral.y,
                                                integral.z, hn::Mul(two, open), n.x, n.y, n.z);
    StoreVector({cone.x, cone.y, cone.z}, out.direction, x);
    if (out.angle) hn::StoreU(cone.angle, d, out.angle + x);
    StoreVector(integral, out.integral, x);
  }
}

void FinishCosine(const float* const sums[kChannels], const float* const normal[3], int width,
                  const Results& out) {
  const D d;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const V open = hn::LoadU(d, sums[0] + x);
    StoreVisibility(open, out.visibility, x);
    if (!sums[1]) continue;
    const Vector n{hn::LoadU(d, normal[0] + x), hn::LoadU(d, normal[1] + x),
                   hn::LoadU(d, normal[2] + x)};
    StoreVector(Rebuild(sums, open, n, 2.0f / 3, x), out.integral, x);
  }
}

void FinishAny(const Finish& finish, const float* const sums[kChannels],
               const float* const normal[3], int width, const Results& out) {
  finish.cosine ? FinishCosine(sums, normal, width, out)
                : FinishUniform(finish, sums, normal, width, out);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
namespace {
HWY_EXPORT(Blur);
HWY_EXPORT(FinishAny);
}  // namespace

namespace interleaved {

void blur_row(const BlurRow& row, int width) { HWY_DYNAMIC_DISPATCH(Blur)(row, width); }
void finish_row(const Finish& finish, const float* const sums[kChannels],
                const float* const normal[3], int width, const Results& results) {
  HWY_DYNAMIC_DISPATCH(FinishAny)(finish, sums, normal, width, results);
}

}  // namespace interleaved
}  // namespace obscura
#endif
