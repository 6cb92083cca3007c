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

// The pairs base[2 index[lane]], base[2 index[lane] + 1], each pair by one load.
template <class D, class V>
HWY_INLINE void GatherPairs(D d, const float* HWY_RESTRICT base,
                            const std::int32_t* HWY_RESTRICT index, V* first, V* second) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  auto pairs = [base](const std::int32_t* k) HWY_ATTR {
    auto at = [base](std::int32_t i) HWY_ATTR {
      return reinterpret_cast<const double*>(base + 2 * static_cast<std::ptrdiff_t>(i));
    };
    const __m128d lo = _mm_loadh_pd(_mm_load_sd(at(k[0])), at(k[1]));
    const __m128d hi = _mm_loadh_pd(_mm_load_sd(at(k[2])), at(k[3]));
    return _mm256_castpd_ps(_mm256_set_m128d(hi, lo));
  };
#if HWY_TARGET == HWY_AVX2
  // Lanes 0 1 4 5 and 2 3 6 7, so that the shuffles within halves give them in order.
  const __m256 p = pairs(index), q = pairs(index + 4);
  const __m256 a = _mm256_permute2f128_ps(p, q, 0x20), b = _mm256_permute2f128_ps(p, q, 0x31);
  *first = V{_mm256_shuffle_ps(a, b, 0x88)};
  *second = V{_mm256_shuffle_ps(a, b, 0xDD)};
#else
  const __m512 p = _mm512_insertf32x8(_mm512_castps256_ps512(pairs(index)), pairs(index + 4), 1);
  const __m512 q =
      _mm512_insertf32x8(_mm512_castps256_ps512(pairs(index + 8)), pairs(index + 12), 1);
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  *first = V{_mm512_permutex2var_ps(p, even, q)};
  *second = V{_mm512_permutex2var_ps(p, odd, q)};
#endif
  (void)d;
#else
  HWY_ALIGN float lanes[2][HWY_MAX_BYTES / sizeof(float)];
  for (size_t i = 0; i < hn::Lanes(d); ++i) {
    const float* pair = base + 2 * static_cast<std::ptrdiff_t>(index[i]);
    lanes[0][i] = pair[0];
    lanes[1][i] = pair[1];
  }
  *first = hn::Load(d, lanes[0]);
  *second = hn::Load(d, lanes[1]);
#endif
}

// base[4 index[lane] + k] as lane `lane` of out[k], k < 4: each lane's four floats, which lie in 16
// aligned bytes, by one load.
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE void GatherQuads(D d, const float* HWY_RESTRICT base,
                            const std::int32_t* HWY_RESTRICT index, V out[4]) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  auto load = [base, index](int lane) HWY_ATTR {
    return _mm_load_ps(base + 4 * static_cast<std::ptrdiff_t>(index[lane]));
  };
  // The lanes k, k + 4, ..., and then a transposition within each 16 bytes.
  auto every_fourth = [load](int k) HWY_ATTR {
    const __m256 lo = _mm256_insertf128_ps(_mm256_castps128_ps256(load(k)), load(k + 4), 1);
#if HWY_TARGET == HWY_AVX2
    return V{lo};
#else
    const __m512 first = _mm512_insertf32x4(_mm512_castps256_ps512(lo), load(k + 8), 2);
    return V{_mm512_insertf32x4(first, load(k + 12), 3)};
#endif
  };
  const V q0 = every_fourth(0), q1 = every_fourth(1), q2 = every_fourth(2), q3 = every_fourth(3);
  const hn::RepartitionToWide<D> dw;
  auto wide = [dw](V v) HWY_ATTR { return hn::BitCast(dw, v); };
  const auto a = wide(hn::InterleaveLower(d, q0, q1)), b = wide(hn::InterleaveLower(d, q2, q3));
  const auto u = wide(hn::InterleaveUpper(d, q0, q1)), v = wide(hn::InterleaveUpper(d, q2, q3));
  out[0] = hn::BitCast(d, hn::InterleaveLower(dw, a, b));
  out[1] = hn::BitCast(d, hn::InterleaveUpper(dw, a, b));
  out[2] = hn::BitCast(d, hn::InterleaveLower(dw, u, v));
  out[3] = hn::BitCast(d, hn::InterleaveUpper(dw, u, v));
#else
  HWY_ALIGN float lanes[4][HWY_MAX_BYTES / sizeof(float)];
  for (size_t i = 0; i < hn::Lanes(d); ++i) {
    const float* quad = base + 4 * static_cast<std::ptrdiff_t>(index[i]);
    for (int k = 0; k < 4; ++k) lanes[k][i] = quad[k];
  }
  for (int k = 0; k < 4; ++k) out[k] = hn::Load(d, lanes[k]);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
