#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_H_

#include "obscura/falloff.h"
#include "obscura/occluder.h"

namespace obscura {

// What point, line and area sampling of volumetric obscurance have in common: a finite sphere, rho
// constant or quadratic, occluders solid or of one thickness.
Status check_volumetric(const Falloff& falloff, const Occluder& occluder);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_H_
