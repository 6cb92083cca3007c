#ifndef OBSCURA_CONE_H_
#define OBSCURA_CONE_H_

#include <array>

#include "obscura/settings.h"

// Bent normals and cones (Klehm, Ritschel, Eisemann, Seidel 2011). Three quantities are told apart;
// V is the visibility of a direction, H the hemisphere above the receiver:
//   mean unoccluded direction  N_ss = (integral over H of V w) / (integral over H of V),
//                              (Klehm et al. 2011, section 3.1);
//                              length 1/2 where all is open, rising to 1 as the opening narrows
//   uniform integral           N = 1/pi integral over H of V w, equation 2; length 1 where all is
//                              open; N = 2 AO N_ss with AO = 1/(2 pi) integral over H of V
//   cosine-weighted integral   1/pi integral over H of V w (n.w); length 2/3 where all is open;
//                              divided by the cosine-weighted visibility it is a mean, of length
//                              2/3 where all is open and rising to 1
// None of the conversions below knows the horizon: they are exact for an opening that is a
// spherical cap wholly above it.
namespace obscura {

enum class ConeEstimate {
  kExact,  // acos(max(0, 2 |N_ss| - 1)): the half-angle itself where the opening is a cap
  kPaper,  // (1 - max(0, 2 |N_ss| - 1)) pi/2, Klehm et al. 2011, section 3.2:
           // narrower (45 degrees for a cap of 60)
};
template <>
struct EnumNames<ConeEstimate> {
  static constexpr const char* names[] = {"exact", "paper"};
};

// cos(alpha) of the cap whose mean unoccluded direction has this length; 0, an open hemisphere,
// where the length is below 1/2 or NaN, and 1 where it is above 1.
float cone_cosine(float mean_length);

// Half-angle in radians, in [0, pi/2], of the bent cone from |N_ss|. Its error is below 1e-6.
float cone_angle(ConeEstimate estimate, float mean_length);

// cos(alpha) of the cap whose cosine-weighted mean direction has this length m: the inverse of
// m = 2/3 (1 + c + c^2) / (1 + c). 0 where m is below 2/3, 1 where it is above 1.
float cone_cosine_of_cosine_mean(float mean_length);

// The factor from N_ss to N, equation 2; `ambient_occlusion` is the uniform visibility in [0, 1].
inline float uniform_integral_factor(float ambient_occlusion) { return 2 * ambient_occlusion; }

// The length of N_ss where N has this length; 1, as of the narrowest opening, where nothing is
// visible.
float mean_length_of_uniform_integral(float length, float ambient_occlusion);

// Bent normal, a unit vector, and the half-angle of its cone.
struct BentCone {
  std::array<float, 3> direction;
  float angle;
};

// From N, the uniform visibility and the unit normal. A closed point, no direction of which is open
// (|N| or twice the visibility at most 1e-3), gets its normal and the angle 0: a cone with nothing
// open. Every method says the same of a closed point, on the CPU and on Vulkan.
BentCone bent_cone(ConeEstimate estimate, const std::array<float, 3>& integral,
                   float ambient_occlusion, const std::array<float, 3>& normal);

}  // namespace obscura

#endif  // OBSCURA_CONE_H_
