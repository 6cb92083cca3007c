#include "gpu/frame.h"

#include "core/text.h"

namespace obscura::gpu {

Status check_back_depth(const Occluder& occluder, const FrameShape& shape) {
  if (occluder.kind != OccluderKind::kBackDepth || shape.back_depth) return {};
  return invalid_argument("the occluder is back-depth, but the shape has no image of it");
}

Status check(const Demands& demands, const FrameShape& shape) {
  if (!demands.directions && shape.directions != Directions::kNone) {
    return unsupported(text(demands.method, " gives no directions"));
  }
  if (demands.normals && shape.normal_use == NormalUse::kNone) {
    return unsupported(text(demands.method, " needs normals; normal_use is none"));
  }
  return {};
}

Status check(const FrameShape& s) {
  if (s.width < 1 || s.height < 1 || s.width > 16384 || s.height > 16384) {
    return invalid_argument(
        text("shape is ", s.width, "x", s.height, "; each side must be in [1, 16384]"));
  }
  const GuardBand& g = s.guard_band;
  if (g.left < 0 || g.right < 0 || g.top < 0 || g.bottom < 0 || g.left + g.right >= s.width ||
      g.top + g.bottom >= s.height) {
    return invalid_argument(text("guard_band leaves nothing visible of ", s.width, "x", s.height));
  }
  if (s.frames < 1 || s.frames > 8) {
    return invalid_argument(text("frames is ", s.frames, "; it must be in [1, 8]"));
  }
  return {};
}

FrameConstants frame_constants(const FrameShape& shape, const Camera& camera,
                               const FrameView& view) {
  const Extent visible = shape.visible();
  return {.scale_x = camera.scale_x,
          .scale_y = camera.scale_y,
          .center_u = camera.center_u,
          .center_v = camera.center_v,
          .width = shape.width,
          .height = shape.height,
          .left = shape.guard_band.left,
          .top = shape.guard_band.top,
          .visible_width = visible.width,
          .visible_height = visible.height,
          .near_plane = view.near_plane,
          .far_plane = view.far_plane,
          .orthographic = camera.orthographic,
          .frame_index = static_cast<int>(view.frame_index & 0xFFFF),
          .radius = 0,
          .thickness = 0};
}

}  // namespace obscura::gpu
