// Gathers of floats for Highway kernels; included once per SIMD target.
#if defined(OBSCURA_SRC_CORE_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_CORE_GATHER_INL_H_
#undef OBSCURA_SRC_CORE_GATHER_INL_H_
#else
#define OBSCURA_SRC_CORE_GATHER_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// base[index[lane]] for each lane. AMD's vgatherdps is microcoded, and loads with inserts are 1.5
// times as fast there and no slower elsewhere, so AVX-512 and AVX2 do without it.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> GatherLanes(D d, const float* HWY_RESTRICT base,
                                                  const std::int32_t* HWY_RESTRICT index) {
  namespace hn = hwy::HWY_NAMESPACE;
  (void)d;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  auto quad = [base](const std::int32_t* k) HWY_ATTR {
    __m128 v = _mm_load_ss(base + k[0]);
    v = _mm_insert_ps(v, _mm_load_ss(base + k[1]), 0x10);
    v = _mm_insert_ps(v, _mm_load_ss(base + k[2]), 0x20);
    return _mm_insert_ps(v, _mm_load_ss(base + k[3]), 0x30);
  };
  const __m256 lo = _mm256_set_m128(quad(index + 4), quad(index));
#if HWY_TARGET == HWY_AVX2
  return hn::Vec<D>{lo};
#else
  const __m256 hi = _mm256_set_m128(quad(index + 12), quad(index + 8));
  return hn::Vec<D>{_mm512_insertf32x8(_mm512_castps256_ps512(lo), hi, 1)};
#endif
#else
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  for (size_t i = 0; i < hn::Lanes(d); ++i) lanes[i] = base[index[i]];
  return hn::Load(d, lanes);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
