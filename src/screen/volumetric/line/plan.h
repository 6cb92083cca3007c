#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_PLAN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_PLAN_H_

#include <memory>
#include <span>

#include "obscura/line.h"
#include "obscura/patterns.h"
#include "screen/method.h"

namespace obscura {

struct LineFrame;

// Line sampling of volumetric obscurance; settings and paper: obscura/line.h. The blur is not part
// of it (see screen/blurred.h). Writes 1 to background pixels.
//
// Taps are nearest texels. Beyond the image's border the border's own texel stands in, with its own
// ray: what lies outside is unknown, and is taken to go on at the depth of the border, as seen
// along the border's rays. So a plane gives 1 there too, and an occluder that touches the border
// keeps its weight.
Status make_line(const LineSettings& settings, std::unique_ptr<Method>* method);

// The same with another pattern, of 1 to 32 samples inside the unit disk; `settings.samples` does
// not count.
Status make_line_with(const LineSettings& settings, std::span<const DiskSample> pattern,
                      std::unique_ptr<Method>* method);

// What all frames have in common: the pattern in the units that kernels want, on any device.
LineFrame line_frame(const LineSettings& settings, std::span<const DiskSample> pattern);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_LINE_PLAN_H_
