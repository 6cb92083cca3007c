#ifndef OBSCURA_SRC_MATH_SPREAD_BITS_H_
#define OBSCURA_SRC_MATH_SPREAD_BITS_H_

#include <array>
#include <bit>
#include <cstdint>

namespace obscura {

// kSpreadBits[n]: n of 32 bits, as evenly spread as can be: bit j is set where j, its five binary
// digits in reverse, is less than n.
inline constexpr std::array<std::uint32_t, 33> kSpreadBits = [] {
  std::array<std::uint32_t, 33> bits{};
  for (unsigned n = 0; n <= 32; ++n) {
    for (unsigned j = 0; j < 32; ++j) {
      const unsigned reversed =
          (j & 1) << 4 | (j & 2) << 2 | (j & 4) | (j & 8) >> 2 | (j & 16) >> 4;
      if (reversed < n) bits[n] |= 1u << j;
    }
  }
  return bits;
}();

}  // namespace obscura

#endif  // OBSCURA_SRC_MATH_SPREAD_BITS_H_
