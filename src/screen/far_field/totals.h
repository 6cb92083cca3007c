#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_H_

#include <cstdint>
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

// `planes` are as it is and transposed; member: &Plane::sums or &Plane::far_sums.
void collect(const Plane planes[2], SumImages Plane::*member, const WantedSums& wanted,
             Executor& executor, Totals* totals);

// Groups of 3x3 pixels (Timonen 2013, section 10). Which of a pixel's 3x3 neighbours see the same
// surface, and their mean depth (on the lattice, where planes are linear) and normal, from which
// the group's far field is seen.
struct Groups {
  AlignedImage<float> depth, normal[3];
  AlignedImage<std::uint16_t> accepted;  // bit 3 (dy + 1) + dx + 1
};
void average_groups(const view::Geometry& geometry, Executor& executor, Groups* groups);

// Adds to each pixel the far field of its accepted neighbours, each of which has a ninth of the
// directions: nine times their mean.
void gather(const Groups& groups, const Totals& far, const WantedSums& wanted, Executor& executor,
            Totals* totals);

// Mean over the neighbours within two pixels whose visibility is within 7 % of the pixel's own and
// which see the same surface. Its weights 1 2 3 2 1 give each pixel of a 3x3 pattern the same.
void blur_selectively(const Groups& groups, const WantedSums& wanted, Executor& executor,
                      Totals* totals, Totals* spare);

// From totals to what the caller asked for.
void finish(const view::Geometry& geometry, const Totals& totals, ConeEstimate cone,
            Executor& executor, const Outputs& outputs);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_H_
