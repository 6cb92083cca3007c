#include "io/images/depth_input.h"

namespace obscura::tools {

DepthField DepthInput::field() const {
  auto view = [&](const std::vector<float>& v) {
    return v.empty() ? ImageView<const float>() : ImageView<const float>(v.data(), width, height);
  };
  DepthField f;
  f.depth = view(depth);
  f.depth_kind = depth_kind;
  f.near_plane = near_plane;
  f.far_plane = far_plane;
  f.camera = camera;
  f.guard_band = guard_band;
  f.normals = {view(normal_x), view(normal_y), view(normal_z)};
  f.back_depth = view(back_depth);
  layer_views_.clear();
  for (const Layer& l : layers) layer_views_.push_back({view(l.front), view(l.back)});
  f.layers = layer_views_;
  return f;
}

}  // namespace obscura::tools
