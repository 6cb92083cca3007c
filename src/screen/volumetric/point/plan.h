#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_PLAN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_PLAN_H_

#include <memory>
#include <span>

#include "obscura/patterns.h"
#include "obscura/point.h"
#include "screen/method.h"

namespace obscura {

struct PointFrame;

// Point sampling of volumetric obscurance, PointPattern::kBall; settings and papers:
// obscura/point.h. The blur is not part of it (see screen/blurred.h). Writes 1 to background
// pixels.
//
// Taps are nearest texels; beyond the image's border the border's own texel stands in, as in
// line.h. With normals, a sample is compared with its texel's surface by height above the tangent
// plane and not by depth: that moves the sample to the texel's own ray along the plane, so that a
// plane occludes none of its samples at any tilt.
Status make_point(const PointSettings& settings, std::unique_ptr<Method>* method);

// The same with another pattern, of 1 to 64 samples; `settings.samples` does not count.
Status make_point_with(const PointSettings& settings, std::span<const BallSample> pattern,
                       std::unique_ptr<Method>* method);

// What all frames have in common: the pattern in the units that kernels want, on any device.
PointFrame point_frame(const PointSettings& settings, std::span<const BallSample> pattern);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_PLAN_H_
