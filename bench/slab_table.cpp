#include "bench/slab_table.h"

#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/slab_table.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/slice-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace leaf = obscura::HWY_NAMESPACE::leaf;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

void ByQuadrature(const math::Rho& rho, const SliceSet& set, float* HWY_RESTRICT out) {
  const D d;
  leaf::SliceIntegral<FalloffKind::kExponential, false, SliceSums::kVisibility> slices(rho);
  for (int s = 0; s < set.count; s += static_cast<int>(hn::Lanes(d))) {
    const leaf::Slice slice = leaf::make_slice(hn::LoadU(d, &set.nz[s]), hn::LoadU(d, &set.nt[s]),
                                               hn::LoadU(d, &set.camera[s]), hn::Set(d, 1.0f));
    leaf::Horizon h = slices.start_horizon(slice, true);
    for (int i = 0; i < set.points; ++i) {
      const V x = hn::LoadU(d, &set.x[i * set.count + s]);
      const V y = hn::LoadU(d, &set.y[i * set.count + s]);
      slices.add_point(slice, x, y, hn::Ge(x, hn::Zero(d)), false, hn::Set(d, 1.0f), h);
    }
    hn::StoreU(h.sum, d, out + s);
  }
}

// Lc and Ls at the angles `low` and `high`, for the line at distance b with direction c.
struct Cell {
  V place_c, place_b;  // in [0, size - 1]
};
HWY_INLINE void LookUp(const SlabTable& t, const Cell& cell, V angle, V* lc, V* ls) {
  const D d;
  const hn::RebindToSigned<D> di;
  const V last = hn::Set(d, static_cast<float>(t.size - 2));
  const V place = hn::Mul(angle, hn::Set(d, (t.size - 1) * std::numbers::inv_pi_v<float>));
  const V ia = hn::Floor(hn::Min(place, last)), ic = hn::Floor(hn::Min(cell.place_c, last)),
          ib = hn::Floor(hn::Min(cell.place_b, last));
  const V ta = hn::Sub(place, ia), tc = hn::Sub(cell.place_c, ic), tb = hn::Sub(cell.place_b, ib);
  const V size = hn::Set(d, static_cast<float>(t.size));
  const auto corner = hn::ConvertTo(di, hn::MulAdd(hn::MulAdd(ib, size, ic), size, ia));
  auto pair = [&](int offset, V* c, V* s) HWY_ATTR {
    HWY_ALIGN std::int32_t index[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(hn::Add(corner, hn::Set(di, offset)), di, index);
    obscura::HWY_NAMESPACE::GatherPairs(d, t.pairs.data(), index, c, s);
  };
  auto blend = [&](V weight, V a, V b) HWY_ATTR { return hn::MulAdd(weight, hn::Sub(b, a), a); };
  auto along_a = [&](int offset, V* c, V* s) HWY_ATTR {
    V c0, s0, c1, s1;
    pair(offset, &c0, &s0);
    pair(offset + 1, &c1, &s1);
    *c = blend(ta, c0, c1);
    *s = blend(ta, s0, s1);
  };
  auto along_c = [&](int offset, V* c, V* s) HWY_ATTR {
    V c0, s0, c1, s1;
    along_a(offset, &c0, &s0);
    along_a(offset + t.size, &c1, &s1);
    *c = blend(tc, c0, c1);
    *s = blend(tc, s0, s1);
  };
  V c0, s0, c1, s1;
  along_c(0, &c0, &s0);
  along_c(t.size * t.size, &c1, &s1);
  *lc = blend(tb, c0, c1);
  *ls = blend(tb, s0, s1);
}

// What a slice starts with does not know rho.
const math::Rho kNoRho;

void ByTable(const SlabTable& t, const SliceSet& set, float* HWY_RESTRICT out) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-30f);
  leaf::SliceIntegral<FalloffKind::kExponential, false, SliceSums::kVisibility> slices(kNoRho);
  for (int s = 0; s < set.count; s += static_cast<int>(hn::Lanes(d))) {
    const leaf::Slice slice = leaf::make_slice(hn::LoadU(d, &set.nz[s]), hn::LoadU(d, &set.nt[s]),
                                               hn::LoadU(d, &set.camera[s]), one);
    leaf::Horizon h = slices.start_horizon(slice, true);
    for (int i = 0; i < set.points; ++i) {
      const V x = hn::LoadU(d, &set.x[i * set.count + s]);
      const V y = hn::LoadU(d, &set.y[i * set.count + s]);
      const V inverse = leaf::leaf_inverse_sqrt(hn::Max(hn::MulAdd(x, x, hn::Mul(y, y)), tiny));
      const V cosine = hn::Min(hn::Mul(y, inverse), one);
      const M visible = hn::And(hn::Ge(x, zero), hn::Gt(cosine, h.cosine));
      if (!hn::AllFalse(d, visible)) {
        const M clipped = hn::Xor(hn::Lt(slice.nz, zero), hn::Le(cosine, slice.edge_cosine));
        const V angle = hn::IfThenElse(clipped, slice.edge_angle, leaf::fast_acos(cosine));
        const V ex = x, ey = hn::Sub(y, slice.camera);
        const V scale = leaf::leaf_inverse_sqrt(hn::Max(hn::MulAdd(ex, ex, hn::Mul(ey, ey)), tiny));
        const V b = hn::Mul(hn::Abs(hn::MulSub(x, ey, hn::Mul(y, ex))), scale);
        const V c = leaf::fast_acos(hn::Clamp(hn::Mul(ey, scale), hn::Set(d, -1.0f), one));
        const V share = hn::Mul(b, leaf::leaf_reciprocal(hn::Add(b, hn::Set(d, t.radius))));
        const V last = hn::Set(d, static_cast<float>(t.size - 1));
        const Cell cell{hn::Mul(c, hn::Mul(last, hn::Set(d, std::numbers::inv_pi_v<float>))),
                        hn::Mul(hn::Sqrt(share), last)};
        V low_c, low_s, high_c, high_s;
        LookUp(t, cell, angle, &low_c, &low_s);
        LookUp(t, cell, h.edge.angle, &high_c, &high_s);
        const V piece =
            hn::MulAdd(slice.nz, hn::Sub(high_c, low_c), hn::Mul(slice.nt, hn::Sub(high_s, low_s)));
        h.sum = hn::Add(h.sum, hn::IfThenElseZero(visible, hn::Max(piece, zero)));
        h.cosine = hn::IfThenElse(visible, cosine, h.cosine);
        h.edge.angle = hn::IfThenElse(visible, angle, h.edge.angle);
      }
    }
    hn::StoreU(h.sum, d, out + s);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::bench {

HWY_EXPORT(ByQuadrature);
HWY_EXPORT(ByTable);

SlabTable::SlabTable(const math::Rho& rho, int n) : size(n), radius(rho.radius) {
  constexpr int kSteps = 64;
  constexpr double kPi = std::numbers::pi;
  pairs.resize(2 * static_cast<std::size_t>(n) * n * n);
  auto out = pairs.begin();
  for (int ib = 0; ib < n; ++ib) {
    const double share = static_cast<double>(ib) * ib / (n - 1) / (n - 1);
    const double b = share < 1 ? radius * share / (1 - share) : 1e30;
    for (int ic = 0; ic < n; ++ic) {
      const double c = kPi * ic / (n - 1);
      double lc = 0, ls = 0;
      for (int ia = 0; ia < n; ++ia) {
        *out++ = static_cast<float>(lc);
        *out++ = static_cast<float>(ls);
        for (int k = 0; k < kSteps; ++k) {
          const double t = kPi * (ia + (k + 0.5) / kSteps) / (n - 1);
          const double distance = std::min(b / std::abs(std::sin(t - c)), 1e30);
          const double weight = math::evaluate(rho, static_cast<float>(distance)) * kPi / (n - 1) /
                                kSteps * std::sin(t);
          lc += weight * std::cos(t);
          ls += weight * std::sin(t);
        }
      }
    }
  }
}

void evaluate_slices(const math::Rho& rho, const SlabTable* table, const SliceSet& set,
                     float* out) {
  if (table) return HWY_DYNAMIC_DISPATCH(ByTable)(*table, set, out);
  HWY_DYNAMIC_DISPATCH(ByQuadrature)(rho, set, out);
}

}  // namespace obscura::bench
#endif
