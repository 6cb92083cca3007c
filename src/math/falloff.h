#ifndef OBSCURA_SRC_MATH_FALLOFF_H_
#define OBSCURA_SRC_MATH_FALLOFF_H_

#include <cstdint>
#include <vector>

#include "obscura/falloff.h"

namespace obscura::math {

#include "math/falloff_kinds_leaf.h"

// rho(d) made ready for kernels: no callable, no division, every kind one short branch-free
// expression (math/falloff_leaf.h).
//
// d is a distance in [0, FLT_MAX]. A ray that meets nothing has no distance: rho is 0 for it, which
// the caller knows and rho, being 1 everywhere for an infinite radius, does not.
//
// A function becomes a table that is linear between kPerOctave knots in each octave of d, from
// 2^kMinExponent to 2^kMaxExponent, so that no length of reference needs to be known: beside a knot
// interval of d / kPerOctave its error is at most (d / kPerOctave)^2 / 8 times the function's
// second derivative there (exp(-d/R): 1.7e-5; a jump is smeared over one interval). Nearer than the
// first knot it is linear from rho(0), farther than the last it is constant.
struct Rho {
  static constexpr int kBitsPerOctave = kKnotBits, kPerOctave = 1 << kBitsPerOctave;
  static constexpr int kMinExponent = kFirstOctave, kMaxExponent = kLastOctave;
  static constexpr int kFunctionKnots = (kMaxExponent - kMinExponent) * kPerOctave + 1;

  FalloffKind kind = FalloffKind::kExponential;
  float radius = 1;
  float inverse_radius = 1;  // 0 if the radius is infinite
  // kTable: the user's values and the last one again, so that entry i + 1 always exists.
  // kFunction: rho(0), then the knots, then the last again.
  std::vector<float> table{};
  float entries_per_length = 0;  // kTable: (entries - 1) / radius
  int last_entry = 0;            // kTable: index of the entry at d = radius
};

// Validates a falloff and prepares it; refuses a function with values outside [0, 1].
Status make_rho(const Falloff& falloff, Rho* rho);

// rho(d) for one distance.
float evaluate(const Rho& rho, float d);

// The kind of a kernel that asks rho for its kind as it runs.
inline constexpr FalloffKind kAnyFalloff{-1};

// Calls f.template operator()<kind>() with the kind as a constant where speed shows it, else with
// kAnyFalloff: kernels take long to compile.
template <class F>
decltype(auto) with_falloff_kind(FalloffKind kind, F&& f) {
  switch (kind) {
    case FalloffKind::kConstant:
      return f.template operator()<FalloffKind::kConstant>();
    case FalloffKind::kExponential:
      return f.template operator()<FalloffKind::kExponential>();
    default:
      return f.template operator()<kAnyFalloff>();
  }
}

}  // namespace obscura::math

#endif  // OBSCURA_SRC_MATH_FALLOFF_H_
