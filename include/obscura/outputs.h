#ifndef OBSCURA_OUTPUTS_H_
#define OBSCURA_OUTPUTS_H_

#include "obscura/views.h"

namespace obscura {

// Where results go: caller-owned images of the visible size, each optional; an empty view is not
// computed. A method that cannot give one that is asked for refuses (StatusCode::kUnsupported).
// Background pixels get visibility 1, direction (0, 0, 1) and an open cone.
struct Outputs {
  // In [0, 1]; 1 is open. Cosine-weighted unless the method's page says otherwise.
  ImageView<float> visibility{};
  // Mean unoccluded direction over the hemisphere, uniform weights (Klehm et al. 2011,
  // section 3.1), as a unit vector in eye space.
  VectorView<float> bent_normal{};
  // Half-angle in radians, [0, pi/2], of the cone around bent_normal. A closed point, no direction
  // of which is open, has its normal as bent_normal and the angle 0 (obscura/cone.h).
  ImageView<float> cone_angle{};
  // Uniform integral N (bent normals and cones, equation 2): length 1 and along the normal where
  // all is open; carries ambient occlusion.
  VectorView<float> uniform_integral{};
  // Cosine-weighted integral of V w (n.w) / pi: along the normal with length 2/3 where all is open.
  VectorView<float> cosine_integral{};
  // The unit normals that a method works with, eye space: those given, or reconstructed from depth.
  // Any Estimator gives them.
  VectorView<float> normal{};
  // Ray-traced reference and hemisphere: the light that a white diffuse surface reflects, 1/pi
  // integral of V L (n.w) with L from the `radiance` of the settings. 0 on the background.
  VectorView<float> radiance{};
  // Reference tracers: estimated standard error of visibility.
  ImageView<float> standard_error{};
};

}  // namespace obscura

#endif  // OBSCURA_OUTPUTS_H_
