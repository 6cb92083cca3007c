#ifndef OBSCURA_SRC_LIGHTING_PRECONVOLVED_IMPL_H_
#define OBSCURA_SRC_LIGHTING_PRECONVOLVED_IMPL_H_

#include <vector>

#include "core/aligned_image.h"
#include "lighting/cube_grid.h"
#include "lighting/preconvolve_kernel.h"
#include "obscura/lighting.h"

namespace obscura {

class PreconvolvedEnvironment::Impl {
 public:
  lighting::CubeGrid grid{0};
  AlignedImage<float> table;  // one row: vertices of a CubeGrid, kVertexFloats each
  Sun sun;
};

}  // namespace obscura

#endif  // OBSCURA_SRC_LIGHTING_PRECONVOLVED_IMPL_H_
