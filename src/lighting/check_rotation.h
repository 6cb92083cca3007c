#ifndef OBSCURA_SRC_LIGHTING_CHECK_ROTATION_H_
#define OBSCURA_SRC_LIGHTING_CHECK_ROTATION_H_

#include <array>
#include <cmath>

#include "core/text.h"
#include "obscura/status.h"

namespace obscura::lighting {

// Whether rows are orthonormal, to three digits.
inline Status check_rotation(const std::array<float, 9>& m) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      float dot = 0;
      for (int k = 0; k < 3; ++k) dot += m[3 * i + k] * m[3 * j + k];
      if (!(std::abs(dot - (i == j ? 1.0f : 0.0f)) < 1e-3f)) {
        return invalid_argument(text("world_from_eye is not orthonormal: rows ", i, " and ", j,
                                     " have the product ", dot));
      }
    }
  }
  return {};
}

}  // namespace obscura::lighting

#endif  // OBSCURA_SRC_LIGHTING_CHECK_ROTATION_H_
