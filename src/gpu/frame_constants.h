#ifndef OBSCURA_SRC_GPU_FRAME_CONSTANTS_H_
#define OBSCURA_SRC_GPU_FRAME_CONSTANTS_H_

// What all passes know of the frame: the first words of their push constants, in C++ and GLSL.
// radius and thickness are the pass's own.
#define OBSCURA_FRAME_CONSTANTS               \
  float scale_x, scale_y, center_u, center_v; \
  int width, height, left, top;               \
  int visible_width, visible_height;          \
  float near_plane, far_plane;                \
  int orthographic, frame_index;              \
  float radius, thickness;

#ifdef __cplusplus
namespace obscura::gpu {

struct FrameConstants {
  OBSCURA_FRAME_CONSTANTS
};

}  // namespace obscura::gpu
#endif

#endif  // OBSCURA_SRC_GPU_FRAME_CONSTANTS_H_
