// rho(d) over Highway lanes (math/falloff.h); included once per SIMD target.
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

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// Entries i and i + 1 of a table, linearly blended by t. `d` is any tag of float lanes.
template <class D, class V, class VI>
HWY_INLINE V TableEntry(D d, const float* HWY_RESTRICT table, VI i, V t) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  HWY_ALIGN std::int32_t index[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(i, di, index);
  const V a = GatherLanes(d, table, index), b = GatherLanes(d, table + 1, index);
  return hn::MulAdd(t, hn::Sub(b, a), a);
}

// rho of the distances x in [0, FLT_MAX], of one kind.
template <FalloffKind kKind, class D, class V>
HWY_INLINE V EvaluateKind(D d, const math::Rho& rho, V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const V one = hn::Set(d, 1.0f);
  if constexpr (kKind == FalloffKind::kConstant) {
    return hn::IfThenElseZero(hn::Le(x, hn::Set(d, rho.radius)), one);
  } else if constexpr (kKind == FalloffKind::kExponential) {
    return hn::Exp(d, hn::Neg(hn::Mul(x, hn::Set(d, rho.inverse_radius))));
  } else if constexpr (kKind == FalloffKind::kQuadratic) {
    const V rest = hn::Max(hn::Zero(d), hn::NegMulAdd(x, hn::Set(d, rho.inverse_radius), one));
    return hn::Mul(rest, rest);
  } else if constexpr (kKind == FalloffKind::kInverseSquare) {
    const V t = hn::Mul(x, hn::Set(d, rho.inverse_radius));
    return hn::Div(one, hn::MulAdd(t, t, one));
  } else if constexpr (kKind == FalloffKind::kTable) {
    const V t = hn::Min(hn::Mul(x, hn::Set(d, rho.entries_per_length)),
                        hn::Set(d, static_cast<float>(rho.last_entry)));
    const auto i = hn::ConvertTo(di, t);
    const V value = TableEntry(d, rho.table.data(), i, hn::Sub(t, hn::ConvertTo(d, i)));
    return hn::IfThenElseZero(hn::Le(x, hn::Set(d, rho.radius)), value);
  } else {
    using math::Rho;
    constexpr int kFractionBits = 23 - Rho::kBitsPerOctave;
    constexpr float kFirst = 1.0f / (1ull << 32) / (1ull << 32);
    constexpr float kLast = 4294967296.0f * 4294967296.0f;
    static_assert(Rho::kMinExponent == -64 && Rho::kMaxExponent == 64);
    const V first = hn::Set(d, kFirst);
    const auto bits = hn::BitCast(di, hn::Min(hn::Max(x, first), hn::Set(d, kLast)));
    const auto i = hn::Sub(hn::ShiftRight<kFractionBits>(bits),
                           hn::Set(di, ((Rho::kMinExponent + 127) << Rho::kBitsPerOctave) - 1));
    const V t = hn::Mul(hn::ConvertTo(d, hn::And(bits, hn::Set(di, (1 << kFractionBits) - 1))),
                        hn::Set(d, 1.0f / (1 << kFractionBits)));
    const V value = TableEntry(d, rho.table.data(), i, t);
    const V a = hn::Set(d, rho.table[0]), b = hn::Set(d, rho.table[1]);
    const V near = hn::MulAdd(hn::Mul(x, hn::Set(d, 1 / kFirst)), hn::Sub(b, a), a);
    return hn::IfThenElse(hn::Lt(x, first), near, value);
  }
}

// The kinds that gather from a table.
template <class D, class V>
HWY_NOINLINE V EvaluateTable(D d, const math::Rho& rho, V x) {
  return rho.kind == FalloffKind::kTable ? EvaluateKind<FalloffKind::kTable>(d, rho, x)
                                         : EvaluateKind<FalloffKind::kFunction>(d, rho, x);
}

// rho of the distances x in [0, FLT_MAX]; kKind is as with_falloff_kind() gives it.
template <FalloffKind kKind, class D, class V>
HWY_INLINE V EvaluateRho(D d, const math::Rho& rho, V x) {
  if constexpr (kKind != math::kAnyFalloff) {
    return EvaluateKind<kKind>(d, rho, x);
  } else {
    if (rho.kind == FalloffKind::kQuadratic) {
      return EvaluateKind<FalloffKind::kQuadratic>(d, rho, x);
    }
    if (rho.kind == FalloffKind::kInverseSquare) {
      return EvaluateKind<FalloffKind::kInverseSquare>(d, rho, x);
    }
    return EvaluateTable(d, rho, x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
