#ifndef OBSCURA_SCENE_TRUTH_COMPARE_H_
#define OBSCURA_SCENE_TRUTH_COMPARE_H_

#include <cstdint>

#include "obscura/status.h"
#include "obscura/views.h"

namespace obscura::tools {

// How an image differs from a reference, over the pixels where both have a value.
struct Comparison {
  std::int64_t pixels = 0;
  std::int64_t infinite = 0;  // pixels that are infinite in one image only: not among `pixels`
  std::int64_t nan = 0;       // pixels that are NaN in either image: not among `pixels`
  std::int64_t nan_image = 0, nan_reference = 0;  // in the image, in the reference
  double e_a = 0;                                 // mean |difference|, per cent of full scale
  double within_5 = 0;                            // per cent of pixels with |difference| < 0.05
  double bias = 0;         // mean difference (image minus reference), per cent
  double rmse = 0;         // root mean square difference, per cent
  double maximum = 0;      // largest |difference|, per cent
  double correlation = 0;  // Pearson's; 1 where both images are constant and equal
};

// Compares `image` with `reference`. Where the reference is N times smaller, the image is read at
// every N-th pixel from floor(N/2). Pixels that are not finite in `mask` (a depth image of the size
// of `image`, when given) are left out; those that are NaN in either image too, and counted. Equal
// infinities differ by 0. Where no pixel is left, an error says why; the counts are set all the
// same.
Status compare(const ImageView<const float>& image, const ImageView<const float>& reference,
               const ImageView<const float>& mask, Comparison* result);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_TRUTH_COMPARE_H_
