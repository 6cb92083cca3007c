#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "volume/occlusion_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/transmittance_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/cache_control.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
constexpr int kCacheLine = 64;

// As many of a row's cells as fill vectors; returns how many that is.
template <int kCell>
int TransmittanceVectors(const float* const* rows, int width, float scale, float alpha,
                         std::uint8_t* HWY_RESTRICT tau) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  using VF = hn::Vec<decltype(d)>;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const VF zero = hn::Zero(d), half = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f);
  const VF by = hn::Set(d, scale), opacity = hn::Set(d, alpha), full = hn::Set(d, 255.0f);
  auto down = [&](int x) HWY_ATTR {
    if constexpr (kCell == 1) return hn::LoadU(d, rows[0] + x);
    return hn::Add(hn::Add(hn::LoadU(d, rows[0] + x), hn::LoadU(d, rows[1] + x)),
                   hn::Add(hn::LoadU(d, rows[2] + x), hn::LoadU(d, rows[3] + x)));
  };
  int x = 0;
  const int floats_of_line = kCacheLine / static_cast<int>(sizeof(float));
  for (; (x + lanes) * kCell <= width; x += lanes) {
    // The rows after these come next.
    for (int r = 0; r < kCell * kCell; ++r) {
      for (int i = 0; i < kCell * lanes; i += floats_of_line) {
        hwy::Prefetch(rows[r] + kCell * (width + x) + i);
      }
    }
    VF sum = down(x * kCell);
    if constexpr (kCell == 2) {
      const VF next = down(x * kCell + lanes);
      sum = hn::Add(hn::ConcatEven(d, next, sum), hn::ConcatOdd(d, next, sum));
    }
    const VF t = hn::Min(hn::Max(hn::Add(hn::Mul(sum, by), half), zero), one);
    const VF open = hn::Sub(one, hn::Mul(hn::Sub(one, t), opacity));
    const auto byte = hn::ConvertTo(di, hn::Add(hn::Mul(open, full), half));
    hn::StoreU(hn::DemoteTo(d8, byte), d8, tau + x);
  }
  return x;
}

void TransmittanceRow(const float* const* rows, int row_count, std::ptrdiff_t stride, int width,
                      int cell, float scale, float alpha, std::uint8_t* HWY_RESTRICT tau) {
  auto byte = [=](float sum) {
    const float t = std::min(std::max(sum * scale + 0.5f, 0.0f), 1.0f);
    return static_cast<std::uint8_t>(255.0f * (1 - (1 - t) * alpha) + 0.5f);
  };
  int x = 0;
  if (stride == 1 && cell == 1 && row_count == 1) {
    x = TransmittanceVectors<1>(rows, width, scale, alpha, tau);
  } else if (stride == 1 && cell == 2 && row_count == 4) {
    x = TransmittanceVectors<2>(rows, width, scale, alpha, tau);
  }
  for (; x < (width + cell - 1) / cell; ++x) {
    float sum = 0;
    for (int i = 0; i < cell; ++i) {
      const std::ptrdiff_t at = std::min(x * cell + i, width - 1) * stride;
      for (int r = 0; r < row_count; ++r) sum += rows[r][at];
    }
    tau[x] = byte(sum);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
HWY_EXPORT(TransmittanceRow);

void transmittance_row(const float* const* rows, int row_count, std::ptrdiff_t stride, int width,
                       int cell, float scale, float alpha, std::uint8_t* tau) {
  HWY_DYNAMIC_DISPATCH(TransmittanceRow)
  (rows, row_count, stride, width, cell, scale, alpha, tau);
}

}  // namespace obscura
#endif  // HWY_ONCE
