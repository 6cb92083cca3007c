#ifndef OBSCURA_IO_PICTURES_HILL_SHADE_H_
#define OBSCURA_IO_PICTURES_HILL_SHADE_H_

#include "io/images/image.h"
#include "obscura/views.h"

namespace obscura::tools {

// Relief as ambient light shows it: the light on each cell's slope, stretched so that half a
// percent of the cells is black and half a percent white. Cells without data are blue.
Image hill_shade(const ImageView<const float>& light);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_PICTURES_HILL_SHADE_H_
