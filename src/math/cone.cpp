#include "obscura/cone.h"

#include "math/leaf_scalar.h"

namespace obscura {
float cone_cosine(float mean_length) { return leaf_scalar::cap_cosine(mean_length); }

float cone_angle(ConeEstimate estimate, float mean_length) {
  return leaf_scalar::cone_half_angle(estimate == ConeEstimate::kPaper, mean_length);
}

float cone_cosine_of_cosine_mean(float mean_length) {
  return leaf_scalar::cap_cosine_of_cosine_mean(mean_length);
}

float mean_length_of_uniform_integral(float length, float ambient_occlusion) {
  return leaf_scalar::mean_direction_length(length, 2 * ambient_occlusion);
}

BentCone bent_cone(ConeEstimate estimate, const std::array<float, 3>& integral,
                   float ambient_occlusion, const std::array<float, 3>& normal) {
  const leaf_scalar::BentCone cone =
      leaf_scalar::bent_cone(estimate == ConeEstimate::kPaper, integral[0], integral[1],
                             integral[2], 2 * ambient_occlusion, normal[0], normal[1], normal[2]);
  return {{cone.x, cone.y, cone.z}, cone.angle};
}

}  // namespace obscura
