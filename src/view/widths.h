#ifndef OBSCURA_SRC_VIEW_WIDTHS_H_
#define OBSCURA_SRC_VIEW_WIDTHS_H_

#include "view/geometry.h"

namespace obscura::view {

// Fills geometry->back_depth with where matter ends that is as thick as it is wide: a texel lies in
// a run of connected texels along its row and in one along its column, and the lesser of their
// lengths, in world units, is the thickness. +inf on the background. Continuous in the depths.
void back_from_widths(Executor& executor, Geometry* geometry);

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_WIDTHS_H_
