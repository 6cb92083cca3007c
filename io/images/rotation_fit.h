#ifndef OBSCURA_IO_IMAGES_ROTATION_FIT_H_
#define OBSCURA_IO_IMAGES_ROTATION_FIT_H_

#include <optional>

namespace obscura::tools {

struct RotationFit {
  double matrix[3][3];  // orthogonal
  bool mirrored;        // its determinant is -1
  double degrees;       // of the rotation, the mirror's z turned back first
};

// The orthogonal matrix R with the largest trace of R^T m: the least-squares solution of a = R b
// for unit vectors a, b where m is the mean of a b^T (Kabsch 1976, Horn 1988). Nothing where the
// vectors do not span space, so that R is not determined.
std::optional<RotationFit> fit_rotation(const double m[3][3]);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_ROTATION_FIT_H_
