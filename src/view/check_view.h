#ifndef OBSCURA_SRC_VIEW_CHECK_VIEW_H_
#define OBSCURA_SRC_VIEW_CHECK_VIEW_H_

#include "obscura/depth_field.h"

namespace obscura::view {

// Whether depth of this kind can be turned into positions: the camera's scale and centre, and near
// and far plane where the kind needs them.
Status check_view(const Camera& camera, DepthKind kind, float near_plane, float far_plane);

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_CHECK_VIEW_H_
