#ifndef OBSCURA_SRC_GPU_FRAME_CONSTANTS_H_
#define OBSCURA_SRC_GPU_FRAME_CONSTANTS_H_

namespace obscura::vulkan {

// Push constants of every pass; src/gpu/view.glsl has the same block in GLSL.
struct FrameConstants {
  float scale_x, scale_y, center_u, center_v;
  int width, height, left, top;
  int visible_width, visible_height;
  float near_plane, far_plane;
  int orthographic, frame_index;
  float radius, thickness;
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_GPU_FRAME_CONSTANTS_H_
