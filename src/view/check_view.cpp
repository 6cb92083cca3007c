#include "view/check_view.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace obscura::view {

Status check_view(const Camera& c, DepthKind kind, float near_plane, float far_plane) {
  if (!(c.scale_x > 0 && c.scale_y > 0 && std::isfinite(c.scale_x) && std::isfinite(c.scale_y) &&
        std::isfinite(c.center_u) && std::isfinite(c.center_v))) {
    return invalid_input(text("camera scale is ", c.scale_x, " x ", c.scale_y, " and its center (",
                              c.center_u, ", ", c.center_v,
                              "); scales must be in (0, inf), the center finite"));
  }
  const bool ndc = kind == DepthKind::kNdc || kind == DepthKind::kNdcReversed;
  if (ndc && !(near_plane > 0 && std::isfinite(near_plane))) {
    return invalid_argument(
        text("near_plane is ", near_plane, "; NDC depth needs it in (0, far_plane)"));
  }
  if (std::isnan(far_plane) || !(far_plane > std::max(near_plane, 0.0f))) {
    return invalid_argument(text("far_plane is ", far_plane, "; it must be in (near_plane, inf]"));
  }
  if (ndc && c.orthographic && std::isinf(far_plane)) {
    return invalid_argument("far_plane is inf; an orthographic NDC depth needs a finite one");
  }
  return {};
}

}  // namespace obscura::view
