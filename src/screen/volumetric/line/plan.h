#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_PLAN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_PLAN_H_

#include <span>

#include "obscura/line.h"
#include "obscura/patterns.h"
#include "screen/volumetric/line/kernel.h"
#include "screen/volumetric/volumetric.h"

// Line sampling of volumetric obscurance; settings and paper: obscura/line.h.
//
// Taps are nearest texels. Beyond the image's border the border's own texel stands in, with its own
// ray: what lies outside is unknown, and is taken to go on at the depth of the border, as seen
// along the border's rays. So a plane gives 1 there too, and an occluder that touches the border
// keeps its weight.
namespace obscura {

using LinePlan = Spheres<LineFrame>;

// Checks the settings and prepares what does not change from frame to frame, on any device.
Status make_plan(const LineSettings& settings, LinePlan* plan);

// A plan's sphere, with any pattern of 1 to 32 samples inside the unit disk: `settings.samples` and
// `settings.center` do not count.
LineFrame line_frame(const LineSettings& settings, std::span<const DiskSample> pattern);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_PLAN_H_
