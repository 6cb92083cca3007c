// The obscurance of azimuthal slices over Highway lanes; included once per SIMD target.
#if defined(OBSCURA_SRC_MATH_SLICE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_MATH_SLICE_INL_H_
#undef OBSCURA_SRC_MATH_SLICE_INL_H_
#else
#define OBSCURA_SRC_MATH_SLICE_INL_H_
#endif

#include "hwy/highway.h"
#include "math/falloff-inl.h"
#include "math/leaf-inl.h"
#include "math/slice_sums.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {

#include "math/slice_leaf.h"
// After slice_leaf.h.
#include "math/sectors_leaf.h"
static_assert(kSumVisibility == static_cast<int>(SliceSums::kVisibility) &&
              kSumUniform == static_cast<int>(SliceSums::kUniform) &&
              kSumCosine == static_cast<int>(SliceSums::kCosine));

// The shader's specialization constants are the class's parameters.
template <FalloffKind kKind, bool kChord, SliceSums kSliceSums>
struct SliceIntegral : RhoLanes<kKind, true> {
  using RhoLanes<kKind, true>::rho_of;
  static constexpr int kSums = static_cast<int>(kSliceSums);

  HWY_INLINE explicit SliceIntegral(const math::Rho& rho) : RhoLanes<kKind, true>(rho) {}
#include "math/horizon_leaf.h"
// After horizon_leaf.h.
#include "math/matter_leaf.h"
};

}  // namespace leaf
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
