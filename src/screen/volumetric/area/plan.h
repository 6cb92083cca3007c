#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_PLAN_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_PLAN_H_

#include "obscura/area.h"
#include "screen/volumetric/area/kernel.h"
#include "screen/volumetric/volumetric.h"

// Area sampling of volumetric obscurance; settings and paper: obscura/area.h.
//
// With normals the tangent plane is a second occluder with the mean and deviation that a plane
// would have under the sample's kernel; a sample sees the smaller of the two integrals, over the
// plane's own. A plane thus gives 1 though its depths have a deviation.
namespace obscura {

using AreaPlan = Spheres<AreaFrame>;

// What is within a few radii of a surface never lies apart from it (math/apart_leaf.h): with radii
// up to the depth of the scene nothing of it does, and nothing ten times as deep is part of it.
float area_slack(const AreaSettings& settings);

// Checks the settings and prepares what does not change from frame to frame, on any device.
Status make_plan(const AreaSettings& settings, AreaPlan* plan);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_AREA_PLAN_H_
