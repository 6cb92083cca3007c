#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_H_

#include <vector>

#include "obscura/cone.h"
#include "obscura/outputs.h"
#include "screen/far_field/plane.h"
#include "view/geometry.h"

namespace obscura::far_field {

// Channels of sums over all slices. In planes a vector's parts go along u, v and the view ray; in
// totals they are eye space's x, y, z.
enum Channel {
  kObscurance,
  kUniformVector,                       // 3: integral of (1 - V) w
  kObscuredSolid = kUniformVector + 3,  // integral of 1 - V
  kCosineVector,                        // 3: integral of (1 - V) w (n.w)
  kChannelCount = kCosineVector + 3
};
static_assert(kChannelCount == kMaxChannels);

// Sums of both planes in the visible image.
struct Totals {
  AlignedImage<float> channel[kChannelCount];
};

// What is wanted of them.
struct WantedSums {
  bool uniform = false, cosine = false;

  std::vector<Channel> channels() const;
};

// `planes` are as it is and transposed.
void collect(const Plane planes[2], const WantedSums& wanted, Executor& executor, Totals* totals);

// Mean over the neighbours within two pixels whose visibility is within 7 % of the pixel's own and
// which see the same surface. Its weights 1 2 3 2 1 give each pixel of a 3x3 pattern the same.
void blur_selectively(const view::Geometry& geometry, const WantedSums& wanted, Executor& executor,
                      Totals* totals, Totals* spare);

// From totals to what the caller asked for.
void finish(const view::Geometry& geometry, const Totals& totals, ConeEstimate cone,
            Executor& executor, const Outputs& outputs);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_H_
