#ifndef OBSCURA_SRC_VIEW_NORMALS_H_
#define OBSCURA_SRC_VIEW_NORMALS_H_

#include "view/geometry.h"

namespace obscura::view {

// Fills the visible part of geometry->normal_*: the given normals made unit, or, where none are
// given, or one is zero or not finite, the normal of the depth image. The normal of the depth image
// is the cross product of two differences in eye space, turned to the camera. Each is one-sided,
// with the smaller change of depth (forward if equal), so that it stays on the pixel's own side of
// an edge.
void compute_normals(const VectorView<const float>& given, Executor& executor, Geometry* geometry);

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_NORMALS_H_
