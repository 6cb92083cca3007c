#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_PLAN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_PLAN_H_

#include <memory>

#include "obscura/area.h"
#include "screen/method.h"

namespace obscura {

struct AreaFrame;

// Area sampling of volumetric obscurance; settings and paper: obscura/area.h. The blur is not part
// of it (see screen/blurred.h). Writes 1 to background pixels.
//
// With normals the tangent plane is a second occluder with the mean and deviation that a plane
// would have under the sample's kernel; a sample sees the smaller of the two integrals, over the
// plane's own. A plane thus gives 1 though its depths have a deviation.
Status make_area(const AreaSettings& settings, int width, int height,
                 std::unique_ptr<Method>* method);

// What all frames have in common: the pattern in the units that kernels want, on any device.
AreaFrame area_frame(const AreaSettings& settings);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_PLAN_H_
