#ifndef OBSCURA_SRC_MATH_SLICE_SUMS_H_
#define OBSCURA_SRC_MATH_SLICE_SUMS_H_

namespace obscura {

// What is summed along a slice beside its obscurance, the integral of (1 - V) (n.w): for the same
// pieces, with the same mean rho, integrals of directions w over the obscured part.
enum class SliceSums {
  kVisibility,  // nothing more
  kUniform,     // of w, whose dot product with n is the obscurance, and of 1 (the solid angle)
  kCosine,      // of w (n.w)
};

}  // namespace obscura

#endif  // OBSCURA_SRC_MATH_SLICE_SUMS_H_
