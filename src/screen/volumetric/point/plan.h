#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_PLAN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_PLAN_H_

#include <span>

#include "obscura/patterns.h"
#include "obscura/point.h"
#include "screen/volumetric/point/kernel.h"
#include "screen/volumetric/point/screen_pattern_kernel.h"
#include "screen/volumetric/volumetric.h"

// Point sampling of volumetric obscurance; settings and papers: obscura/point.h.
//
// Taps are nearest texels; beyond the image's border the border's own texel stands in, as in line
// sampling. With normals, a sample of the ball is compared with its texel's surface by height above
// the tangent plane and not by depth: that moves the sample to the texel's own ray along the plane,
// so that a plane occludes none of its samples at any tilt.
namespace obscura {

// Of the two, the one that `settings.pattern` names.
struct PointPlan {
  Spheres<PointFrame> ball;
  Spheres<ScreenPatternFrame> screen;
};

// Checks the settings and prepares what does not change from frame to frame, on any device.
Status make_plan(const PointSettings& settings, PointPlan* plan);

// A plan's ball, with any pattern of 1 to 64 samples: `settings.samples` does not count.
PointFrame point_frame(const PointSettings& settings, std::span<const BallSample> pattern);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_PLAN_H_
