// Transpositions between rows and skewed vectors; included once per SIMD target.
#if defined(OBSCURA_SRC_VOLUME_TRANSPOSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_VOLUME_TRANSPOSE_INL_H_
#undef OBSCURA_SRC_VOLUME_TRANSPOSE_INL_H_
#else
#define OBSCURA_SRC_VOLUME_TRANSPOSE_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

constexpr int Log2(int n) { return n == 1 ? 0 : 1 + Log2(n / 2); }

// Interleaving the first half of a sequence of kCount vectors with the second, kTimes over, turns
// the index of each element by kTimes bits: log2(rows) times is a transposition of rows.
template <int kCount, int kTimes, class D>
HWY_INLINE void PerfectShuffle(D d, hwy::HWY_NAMESPACE::Vec<D>* v) {
  namespace hn = hwy::HWY_NAMESPACE;
  hn::Vec<D> w[kCount];
  for (int s = 0; s < kTimes; ++s) {
    for (int i = 0; i < kCount / 2; ++i) {
      w[2 * i] = hn::InterleaveLower(d, v[i], v[i + kCount / 2]);
      w[2 * i + 1] = hn::InterleaveUpper(d, v[i], v[i + kCount / 2]);
    }
    for (int i = 0; i < kCount; ++i) v[i] = w[i];
  }
}

// Writes column i = 0 ... 3 of kRows rows to to[i * kRows...]; row j begins at from + j * pitch.
template <int kRows>
HWY_INLINE void SkewFloats(const float* HWY_RESTRICT from, std::ptrdiff_t pitch,
                           float* HWY_RESTRICT to) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Full128<float> d;
  hn::Vec<hn::Full128<float>> v[kRows];
  for (int j = 0; j < kRows; ++j) v[j] = hn::LoadU(d, from + j * pitch);
  PerfectShuffle<kRows, Log2(kRows)>(d, v);
  for (int j = 0; j < kRows; ++j) hn::Store(v[j], d, to + 4 * j);
}

// The reverse.
template <int kRows>
HWY_INLINE void UnskewFloats(const float* HWY_RESTRICT from, float* HWY_RESTRICT to,
                             std::ptrdiff_t pitch) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Full128<float> d;
  hn::Vec<hn::Full128<float>> v[kRows];
  for (int j = 0; j < kRows; ++j) v[j] = hn::Load(d, from + 4 * j);
  PerfectShuffle<kRows, 2>(d, v);
  for (int j = 0; j < kRows; ++j) hn::StoreU(v[j], d, to + j * pitch);
}

// Writes column i = 0 ... 15 of kRows rows of bytes to to[i * kRows...].
template <int kRows>
HWY_INLINE void SkewBytes(const std::uint8_t* HWY_RESTRICT from, std::ptrdiff_t pitch,
                          std::uint8_t* HWY_RESTRICT to) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Full128<std::uint8_t> d;
  hn::Vec<hn::Full128<std::uint8_t>> v[kRows];
  for (int j = 0; j < kRows; ++j) v[j] = hn::LoadU(d, from + j * pitch);
  PerfectShuffle<kRows, Log2(kRows)>(d, v);
  for (int j = 0; j < kRows; ++j) hn::Store(v[j], d, to + 16 * j);
}

// The reverse.
template <int kRows>
HWY_INLINE void UnskewBytes(const std::uint8_t* HWY_RESTRICT from, std::uint8_t* HWY_RESTRICT to,
                            std::ptrdiff_t pitch) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Full128<std::uint8_t> d;
  hn::Vec<hn::Full128<std::uint8_t>> v[kRows];
  for (int j = 0; j < kRows; ++j) v[j] = hn::Load(d, from + 16 * j);
  PerfectShuffle<kRows, 4>(d, v);
  for (int j = 0; j < kRows; ++j) hn::StoreU(v[j], d, to + j * pitch);
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
