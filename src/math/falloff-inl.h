// rho(d) over Highway lanes (math/falloff_leaf.h); included once per SIMD target.
#if defined(OBSCURA_SRC_MATH_FALLOFF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_FALLOFF_INL_H_
#undef OBSCURA_SRC_MATH_FALLOFF_INL_H_
#else
#define OBSCURA_SRC_MATH_FALLOFF_INL_H_
#endif

#include <cstdint>

#include "core/gather-inl.h"
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "math/falloff.h"
#include "math/fast-inl.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {

#include "math/falloff_kinds_leaf.h"

// The falloff's kind, known when a kernel is compiled or only when it runs (math::kAnyFalloff).
template <FalloffKind kKind>
struct KindOfRho {
  static constexpr int kFalloff = static_cast<int>(kKind);
  HWY_INLINE explicit KindOfRho(const math::Rho&) {}
};
template <>
struct KindOfRho<math::kAnyFalloff> {
  const int kFalloff;
  HWY_INLINE explicit KindOfRho(const math::Rho& rho) : kFalloff(static_cast<int>(rho.kind)) {}
};

// What falloff_leaf.h reads of a math::Rho. `kFast`: the exponential of math/fast-inl.h.
template <FalloffKind kKind, bool kFast>
struct RhoLanes : KindOfRho<kKind> {
  using KindOfRho<kKind>::kFalloff;
  const math::Rho& rho;

  HWY_INLINE explicit RhoLanes(const math::Rho& r) : KindOfRho<kKind>(r), rho(r) {}

  LEAF(Real) rho_radius() { return real(rho.radius); }
  LEAF(Real) rho_inverse_radius() { return real(rho.inverse_radius); }
  LEAF(Real) rho_entries_per_length() { return real(rho.entries_per_length); }
  LEAF(Real) rho_last_entry() { return real(static_cast<float>(rho.last_entry)); }
  LEAF(Real) rho_entry(int i) { return real(rho.table[i]); }
  LEAF(Real) rho_between(Int i, Real t) {
    const D d;
    HWY_ALIGN std::int32_t index[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(i, DI(), index);
    const float* HWY_RESTRICT table = rho.table.data();
    const Real a = GatherLanes(d, table, index), b = GatherLanes(d, table + 1, index);
    return leaf_fma(t, b - a, a);
  }
  LEAF(Real) rho_exp_negative(Real t) {
    if constexpr (kFast) return FastExpNegative(D(), t);
    return hn::Exp(D(), hn::Neg(t));
  }
#include "math/falloff_leaf.h"
};

}  // namespace leaf

// rho of the distances x in [0, FLT_MAX]; kKind is as with_falloff_kind() gives it.
template <FalloffKind kKind>
HWY_INLINE leaf::Real EvaluateRho(const math::Rho& rho, leaf::Real x) {
  return leaf::RhoLanes<kKind, false>(rho).rho_of(x);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
