#ifndef OBSCURA_SRC_LIGHTING_LIGHT_KERNEL_H_
#define OBSCURA_SRC_LIGHTING_LIGHT_KERNEL_H_

#include <array>

#include "obscura/lighting.h"

namespace obscura::lighting {

struct EyeSun {
  float direction[3] = {};  // in eye space
  float rgb[3] = {};        // irradiance / pi
  float radius = 0;         // above 0
};
EyeSun make_eye_sun(const std::array<float, 9>& world_from_eye, const Sun& sun);

struct LightFrame {
  LightingTechnique technique = LightingTechnique::kBentCone;
  bool geometric_term = false;
  bool paper_normalisation = false;
  bool uniform_weights = false;
  const float* table = nullptr;  // vertices of a CubeGrid, kVertexFloats each
  int cells = 0;
  float world_from_eye[9] = {};
  bool sun_shines = false;
  EyeSun sun;
};

// One row. Each input holds `width` numbers and is padded, so that whole vectors may be read and
// written past the end; `bent`, `angle` and `albedo` are null where they are not used.
struct LightRow {
  const float* visibility = nullptr;
  const float* normal[3] = {};
  const float* bent[3] = {};
  const float* angle = nullptr;
  const float* albedo[3] = {};
  float* out[3] = {};
};
void light_row(const LightFrame& frame, const LightRow& row, int width);

// See cones_from_cosine_integral; `integral` may be `direction`.
void cosine_cone_row(const float* visibility, const float* const integral[3], int width,
                     float* const direction[3], float* angle);

}  // namespace obscura::lighting

#endif  // OBSCURA_SRC_LIGHTING_LIGHT_KERNEL_H_
